"""Borders of planar maps: those that coincide, and those that meet."""

import numpy as np
import pytest

from degenerate import polygon
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.tree.planar.build import build_map

RED, BLUE = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0))


def test_abutting_polygons_let_nothing_through() -> None:
    rng = np.random.default_rng(1)
    x = np.sort(rng.random(6))
    strips = [polygon([(a, 0), (b, 0), (b, 1), (a, 1)]) for a, b in zip([0, *x], [*x, 1], strict=True)]
    planar = build_map(Drawing(tuple(Path((strip,), paint=Paint((rng.random(), 0, 0))) for strip in strips)))
    assert (planar.mean[..., 3] == 1.0).all()
    assert len(planar.curves) <= 2 * len(x)  # one border between two strips, cut once


@pytest.mark.parametrize("apart", [0.0, 1e-12, 1e-9])
def test_copies_cost_what_one_costs(apart: float) -> None:
    rng = np.random.default_rng(3)
    corners = rng.random((7, 2))
    paths = [Path((polygon(corners + apart * k * (corners < 0.5)),), paint=RED) for k in range(60)]
    one, many = build_map(Drawing((paths[0],))), build_map(Drawing(tuple(paths)))
    assert (len(many.count), len(many.curves)) == (len(one.count), len(one.curves))
