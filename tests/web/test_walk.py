"""The package's walk over a packed texture, in JavaScript, against the Python one that it mirrors."""

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import ROOT
from numpy.typing import NDArray

import vexture
from packed_walk import leaf_at, leaves
from vexture.texture.decode import decode

SHAPES = ROOT / "examples" / "shapes"
FIXTURES = ROOT / "web" / "test" / "fixtures"
SCRIPT = Path(__file__).with_name("walk_points.mjs")


def _points() -> NDArray[np.float64]:
    """Points at random, on the lines of the cells, on the border and beyond it."""
    random = np.random.default_rng(4)
    lines = random.integers(0, 257, (300, 2)) / 256
    mixed = np.stack([random.random(300), random.integers(0, 65, 300) / 64], axis=1)
    return np.concatenate([random.random((3000, 2)), lines, mixed, mixed[:, ::-1], random.random((50, 2)) * 3 - 1])


def _by_node(texture: Path, points: NDArray[np.float64], folder: Path) -> list[dict[str, Any]]:
    """What the JavaScript finds."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node (on Debian: apt-get install nodejs)")
    listed = folder / "points.json"
    listed.write_text(json.dumps(points.tolist()), encoding="utf-8")
    outcome = subprocess.run([node, SCRIPT, texture, listed], capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    found: list[dict[str, Any]] = json.loads(outcome.stdout)
    return found


def _saved(name: str, folder: Path) -> Path:
    """A texture of an example."""
    if name.endswith(".ktx2"):
        return FIXTURES / name
    return vexture.convert(SHAPES / f"{name}.svg").save(folder / f"{name}.ktx2")


@pytest.mark.parametrize("name", ["drawings.ktx2", "font", "ocean", "crossings", "loop"])
def test_the_same_points_are_inside(name: str, tmp_path: Path) -> None:
    path = _saved(name, tmp_path)
    texture, points = vexture.load(path), _points()
    for place, found in enumerate(_by_node(path, points, tmp_path)):
        inside = texture.contains(points, place)
        assert 0 < inside.sum() < len(points)
        differing = np.flatnonzero(inside != found["inside"])
        assert points[differing].tolist() == []


@pytest.mark.parametrize("name", ["drawings.ktx2", "font"])
def test_the_same_cells_curves_and_counts(name: str, tmp_path: Path) -> None:
    path = _saved(name, tmp_path)
    texture, points = vexture.load(path), _points()
    within = ((points >= 0.0) & (points < 1.0)).all(axis=1)
    described = texture.info()["roots"]
    for place, found in enumerate(_by_node(path, points, tmp_path)):
        for cell in (cell for cell, here in zip(found["cells"], within, strict=True) if not here):
            assert cell is None
        cells = [cell for cell, here in zip(found["cells"], within, strict=True) if here]
        tree = leaves(decode(texture, place))
        for index, cell in zip(leaf_at(tree, points[within]), cells, strict=True):
            leaf = tree[index]
            assert (cell["x"], cell["y"], cell["size"], cell["depth"]) == (leaf.x, leaf.y, leaf.side, leaf.depth)
            assert (cell["winding"], cell["isQuad"]) == (leaf.winding, False)
            assert cell["coverage"] == pytest.approx(leaf.coverage, abs=1e-12)
            expected = leaf.curves * leaf.side + (leaf.x, leaf.y)
            np.testing.assert_allclose(np.reshape(cell["curves"], (-1, 4, 2)), expected, rtol=0, atol=1e-15)
        assert found["counts"] == {key: described[place][key] for key in ("quads", "curves", "depth")}


@pytest.mark.parametrize("name", ["drawings.ktx2", "font", "holes"])
def test_bounds_hold_all_that_is_inside(name: str, tmp_path: Path) -> None:
    path = _saved(name, tmp_path)
    texture, points = vexture.load(path), _points()
    for place, found in enumerate(_by_node(path, points, tmp_path)):
        inside = points[texture.contains(points, place)]
        x0, y0, x1, y1 = found["bounds"]
        assert (inside >= (x0, y0)).all()
        assert (inside <= (x1, y1)).all()
        assert np.abs(np.concatenate([inside.min(axis=0), inside.max(axis=0)]) - (x0, y0, x1, y1)).max() < 0.03
