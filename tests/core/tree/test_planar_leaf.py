"""Leaves of planar maps whose borders all meet in a point."""

import numpy as np
import pytest
from test_planar import check_points

from degenerate import points_near, polygon
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.tree.planar.build import build_map


@pytest.mark.parametrize("wedges", [5, 12, 15, 24])
def test_borders_that_meet_in_a_point(wedges: int) -> None:
    angles = np.linspace(0.1, 0.1 + 2 * np.pi, wedges + 1)
    rim = np.array([0.53, 0.51]) + 0.4 * np.column_stack([np.cos(angles), np.sin(angles)])
    pieces = [polygon([(0.53, 0.51), rim[k], rim[k + 1]]) for k in range(wedges)]
    of = Drawing(tuple(Path((piece,), paint=Paint((k % 3 / 2, k % 4 / 3, 0))) for k, piece in enumerate(pieces)))
    planar = build_map(of)
    assert check_points(of, planar, points_near(of, np.random.default_rng(2), 60)) > 20
    assert len(planar.count) < 60 * wedges
