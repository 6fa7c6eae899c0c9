"""Runs of models on large meshes, as D-Flow FM and SFINCS write them, made small and read as extents."""

import numpy as np
import pytest
import xarray

import model_runs
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


def changed(path, change, place):
    """A file after a function of its dataset, in which times and fill values are as they are written."""
    with xarray.open_dataset(path, decode_cf=False) as dataset:
        change(dataset.load()).to_netcdf(place)
    return place


def outline(step):
    return [contour for path in step.drawing.paths for contour in path.contours]


def same(one, other):
    """Whether two extents have the same outlines and depths, bit for bit."""
    for a, b in zip(one.steps, other.steps, strict=True):
        np.testing.assert_array_equal(a.depth, b.depth)
        for x, y in zip(outline(a), outline(b), strict=True):
            np.testing.assert_array_equal(x, y)
    np.testing.assert_array_equal(one.bed, other.bed)
    return one.frame == other.frame


def test_levels_above_beds_on_faces_and_on_nodes_are_depths(mesh, run, tmp_path):
    levels = read(model_runs.write_run(tmp_path / "levels.nc", mesh, STEPS, depth=False))
    for step, other in zip(levels.steps, read(run).steps, strict=True):
        np.testing.assert_allclose(step.depth, other.depth, atol=1e-6)
        assert len(outline(step)) == len(outline(other)) > 0


def test_of_two_levels_the_one_with_the_usual_name_is_read(mesh, run, tmp_path):
    path = model_runs.write_run(tmp_path / "levels.nc", mesh, STEPS, depth=False)
    before = changed(path, lambda data: data.assign(mesh2d_s0=data["mesh2d_s1"] - 1.0), tmp_path / "both.nc")
    assert same(read(before), read(path))


def test_other_variables_on_the_mesh_are_no_depths_beside_a_level_and_a_bed(mesh, tmp_path):
    path = model_runs.write_run(tmp_path / "levels.nc", mesh, STEPS, depth=False)
    stress = changed(path, lambda data: data.assign(mesh2d_taus=data["mesh2d_s1"] * 0 + 7.0), tmp_path / "stress.nc")
    assert same(read(stress), read(path))


def test_a_largest_depth_is_not_read_in_place_of_levels_at_all_times(mesh, tmp_path):
    path = model_runs.write_run(tmp_path / "levels.nc", mesh, STEPS, depth=False)
    most = changed(path, lambda data: data.assign(hmax=data["mesh2d_s1"].max("time")), tmp_path / "most.nc")
    assert same(read(most), read(path))
    assert len(read(most, variable="hmax").steps) == 1


@pytest.mark.parametrize("where", [0, 1], ids=["from 0", "from 1, unsaid"])
def test_tables_of_nodes_may_be_turned_and_count_from_0_or_1(run, tmp_path, where):
    def turn(data):
        nodes = data["mesh2d_face_nodes"].transpose()
        nodes = nodes.copy(data=np.where(nodes > 0, nodes - (1 - where), nodes))
        del nodes.attrs["start_index"]
        return data.drop_vars("mesh2d_face_nodes").assign(mesh2d_face_nodes=nodes)

    assert same(read(changed(run, turn, tmp_path / "turned.nc")), read(run))


def test_faces_far_from_the_bounds_do_not_matter(mesh, run, tmp_path):
    side = (len(mesh.nodes) ** 0.5 - 1) * model_runs.EDGE
    west, south = model_runs.CORNER
    bounds = (west + 0.3 * side, south + 0.3 * side, west + 0.6 * side, south + 0.6 * side)
    middles = np.where((mesh.faces >= 0)[..., None], mesh.nodes[mesh.faces], np.nan)
    near = np.abs(np.nanmean(middles, axis=1) - (west + 0.45 * side, south + 0.45 * side)).max(axis=1) < 0.4 * side
    assert 0.5 < near.mean() < 0.8
    whole = read(run, bounds=bounds)
    part = read(model_runs.write_run(tmp_path / "part.nc", mesh.part(near), STEPS), frame=whole.frame)
    x0, y0, x1, y1 = whole.frame.box
    view = [[(x1 - x0) / 64, 0.0, x0], [0.0, (y0 - y1) / 64, y1]]
    shares = []
    for one, other in zip(whole.steps, part.steps, strict=True):
        drawings = one.drawing, other.drawing
        a, b = (render_exact(drawing, (64, 64), view) for drawing in drawings)
        shares.append(a.mean())
        np.testing.assert_allclose(a, b, atol=1e-3)
        np.testing.assert_array_equal(np.isnan(one.depth), np.isnan(other.depth))
    assert any(0.05 < share < 0.95 for share in shares)
