"""Planar maps: at every point the one paint that compositing gives, and exact means."""

import numpy as np
import pytest

from degenerate import circle, drawing, heap, points_near, polygon
from planar import cell_at, colour_paths, colours_at, paints_at
from vexture.base.errors import LimitError, SourceError
from vexture.base.layout import PAINT_ONE
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.drawing.group import Blend, Group
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact_colours
from vexture.tree.planar.build import build_map
from vexture.tree.planar.map import PlanarMap

CLEAR = 3e-5  # unit-square units; beyond them rounding moves no outline


def check_points(of: Drawing, planar: PlanarMap, points) -> int:
    """Each point that is clear of outlines has one paint, of the right colour; return how many were."""
    wanted, distance = colours_at(of, points)
    checked = 0
    for point, colour, off in zip(points, wanted, distance, strict=True):
        quad, k, _ = cell_at(planar, point)
        if off < CLEAR or planar.is_mean[quad, k]:
            continue
        paints = paints_at(planar, point)
        assert list(paints.values()) == [1], point
        np.testing.assert_allclose(planar.paints[next(iter(paints))] / PAINT_ONE, colour, atol=2e-5)
        checked += 1
    return checked


@pytest.mark.parametrize("seed", range(24))
def test_every_point_has_the_paint_that_compositing_gives(seed: int) -> None:
    rng = np.random.default_rng(seed)
    paths = drawing(seed).paths + drawing(seed + 100).paths
    if seed % 2:
        paths += heap(seed, [1, 2, 1], 1e-9, FillRule(seed // 2 % 2)).paths
    of = colour_paths(Drawing(paths), rng)
    assert check_points(of, build_map(of, tolerance=1e-6 * (seed % 3)), points_near(of, rng, 40)) > 5


@pytest.mark.parametrize("blend", list(Blend))
def test_groups_blend(blend: Blend) -> None:
    square = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    below, above = Paint((0.8, 0.3, 0.1), 0.7), Paint((0.2, 0.6, 0.9), 0.8)
    of = Drawing((Path((square,), paint=below), Path((square,), paint=above, group=0)), groups=(Group(-1, 0.9, blend),))
    colour = build_map(of).mean[0, 0]
    np.testing.assert_allclose(colour, render_exact_colours(of, 1)[0, 0], atol=1e-6)


def rings(count: int, opacity: float) -> Drawing:
    radii = np.linspace(0.45, 0.05, count)
    return Drawing(
        tuple(
            Path((circle((0.5, 0.5), r),), paint=Paint((k % 7 / 7, k % 5 / 5, 0), opacity)) for k, r in enumerate(radii)
        )
    )


def test_limits_name_themselves() -> None:
    of = rings(30, 0.5)
    with pytest.raises(LimitError, match="quads at least; the limit is 3"):
        build_map(of, most_quads=3)
    assert build_map(of, most_texels=100) is None
    with pytest.raises(SourceError, match="leaves the unit square"):
        build_map(beyond())


def beyond() -> Drawing:
    """A drawing with a curve that leaves the unit square between its ends."""
    arch = np.array([[(0.2, 0.9), (0.2, 1.4), (0.8, 1.4), (0.8, 0.9)], polygon([(0.8, 0.9), (0.2, 0.9)])[1]])
    return Drawing((Path((arch,)),))
