"""The package's walk over a packed texture, in JavaScript, against the Python one that it mirrors."""

from pathlib import Path

import numpy as np
import pytest
from walk_node import found_at, points

import vexture
from chromium import ROOT
from packed_walk import leaf_at, leaves
from vexture.texture.decode import decode

SHAPES = ROOT / "examples" / "shapes"
FIXTURES = ROOT / "web" / "test" / "fixtures"


def _saved(name: str, folder: Path) -> Path:
    """A texture of an example."""
    if name.endswith(".ktx2"):
        return FIXTURES / name
    return vexture.convert(SHAPES / f"{name}.svg").save(folder / f"{name}.ktx2")


@pytest.mark.parametrize("name", ["drawings.ktx2", "font", "ocean", "crossings", "loop"])
def test_the_same_points_are_inside(name: str, tmp_path: Path) -> None:
    path = _saved(name, tmp_path)
    texture, at = vexture.load(path), points()
    for place, found in enumerate(found_at(path, at, tmp_path)):
        inside = texture.contains(at, place)
        assert 0 < inside.sum() < len(at)
        differing = np.flatnonzero(inside != found["inside"])
        assert at[differing].tolist() == []


@pytest.mark.parametrize("name", ["drawings.ktx2", "font"])
def test_the_same_cells_curves_and_counts(name: str, tmp_path: Path) -> None:
    path = _saved(name, tmp_path)
    texture, at = vexture.load(path), points()
    within = ((at >= 0.0) & (at < 1.0)).all(axis=1)
    described = texture.info()["roots"]
    for place, found in enumerate(found_at(path, at, tmp_path)):
        for cell in (cell for cell, here in zip(found["cells"], within, strict=True) if not here):
            assert cell is None
        cells = [cell for cell, here in zip(found["cells"], within, strict=True) if here]
        tree = leaves(decode(texture, place))
        for index, cell in zip(leaf_at(tree, at[within]), cells, strict=True):
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
    texture, at = vexture.load(path), points()
    for place, found in enumerate(found_at(path, at, tmp_path)):
        inside = at[texture.contains(at, place)]
        x0, y0, x1, y1 = found["bounds"]
        assert (inside >= (x0, y0)).all()
        assert (inside <= (x1, y1)).all()
        assert np.abs(np.concatenate([inside.min(axis=0), inside.max(axis=0)]) - (x0, y0, x1, y1)).max() < 0.03
