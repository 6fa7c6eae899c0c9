"""Runs of D-Flow FM in partitions are read as one mesh."""

import numpy as np
import pytest

import model_runs
from vexture.base.errors import SourceError
from vexture.renderers.exact import render_exact
from vexture_geo.depth.depths import read_depths

FACES, STEPS = 900, 3


@pytest.fixture(scope="module")
def mesh():
    return model_runs.estuary(FACES, seed=3)


@pytest.fixture(scope="module")
def run(mesh, tmp_path_factory):
    return model_runs.write_run(tmp_path_factory.mktemp("run") / "run_map.nc", mesh, STEPS)


def read(path, **options):
    return read_depths(path, path.name, **options)


@pytest.fixture(scope="module")
def partitions(mesh, tmp_path_factory):
    return model_runs.write_partitions(tmp_path_factory.mktemp("parts"), mesh, STEPS, 3)


def test_partitions_are_one_run(run, partitions):
    """Whichever of them is given, all are read, and each face counts once."""
    whole = read(run)
    for path in partitions[::2]:
        merged = read(path)
        assert merged.frame == whole.frame
        for one, other in zip(merged.steps, whole.steps, strict=True):
            np.testing.assert_allclose(one.depth, other.depth, atol=1e-6)
            off = np.abs(render_exact(one.drawing, (64, 64)) - render_exact(other.drawing, (64, 64)))
            assert off.max() < 1e-3
            assert len(one.drawing.paths) == len(other.drawing.paths)
        np.testing.assert_allclose(merged.bed, whole.bed, atol=1e-6)


def test_a_missing_partition_is_named(partitions, tmp_path):
    for path in partitions[:2]:
        (tmp_path / path.name).write_bytes(path.read_bytes())
    with pytest.raises(SourceError, match=r"run_0002_map\.nc is missing beside it; copy it there"):
        read(tmp_path / "run_0000_map.nc")


def test_partitions_of_different_runs_are_refused(partitions, mesh, tmp_path):
    for path in partitions[:2]:
        (tmp_path / path.name).write_bytes(path.read_bytes())
    (tmp_path / "other").mkdir()
    other = model_runs.write_partitions(tmp_path / "other", mesh, STEPS + 1, 3)[2]
    (tmp_path / other.name).write_bytes(other.read_bytes())
    with pytest.raises(SourceError, match="different times"):
        read(tmp_path / "run_0000_map.nc")


def test_a_file_that_is_only_named_so_is_told(run, tmp_path):
    alone = tmp_path / "run_0000_map.nc"
    alone.write_bytes(run.read_bytes())
    assert len(read(alone).steps) == STEPS
    (tmp_path / "run_0001_map.nc").write_bytes(run.read_bytes())
    with pytest.raises(SourceError, match="flowelem_domain"):
        read(alone)
