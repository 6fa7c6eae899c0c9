"""Planar maps: at every point the one paint that compositing gives, and exact means."""

import numpy as np
import pytest

from degenerate import circle, drawing, heap, path_windings, points_near, polygon
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
RED, BLUE = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0))


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


@pytest.mark.parametrize("seed", range(8))
def test_means_are_exact(seed: int) -> None:
    of = colour_paths(Drawing(drawing(seed).paths + drawing(seed + 100).paths), np.random.default_rng(seed))
    means = build_map(of).mean[0].reshape(2, 2, 4)[::-1]
    np.testing.assert_allclose(means, render_exact_colours(of, 2), atol=2e-4)


@pytest.mark.parametrize("blend", list(Blend))
def test_groups_blend(blend: Blend) -> None:
    square = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    below, above = Paint((0.8, 0.3, 0.1), 0.7), Paint((0.2, 0.6, 0.9), 0.8)
    of = Drawing((Path((square,), paint=below), Path((square,), paint=above, group=0)), groups=(Group(-1, 0.9, blend),))
    colour = build_map(of).mean[0, 0]
    np.testing.assert_allclose(colour, render_exact_colours(of, 1)[0, 0], atol=1e-6)


def test_abutting_polygons_let_nothing_through() -> None:
    rng = np.random.default_rng(1)
    x = np.sort(rng.random(6))
    strips = [polygon([(a, 0), (b, 0), (b, 1), (a, 1)]) for a, b in zip([0, *x], [*x, 1], strict=True)]
    planar = build_map(Drawing(tuple(Path((strip,), paint=Paint((rng.random(), 0, 0))) for strip in strips)))
    assert (planar.mean[..., 3] == 1.0).all()
    assert len(planar.curves) <= 2 * len(x)  # one border between two strips, cut once


def rings(count: int, opacity: float) -> Drawing:
    radii = np.linspace(0.45, 0.05, count)
    return Drawing(
        tuple(
            Path((circle((0.5, 0.5), r),), paint=Paint((k % 7 / 7, k % 5 / 5, 0), opacity)) for k, r in enumerate(radii)
        )
    )


def test_what_opaque_paths_hide_costs_nothing() -> None:
    lid = Path((polygon([(0, 0), (1, 0), (1, 1), (0, 1)]),), paint=RED)
    planar = build_map(Drawing((*rings(40, 1.0).paths, lid)))
    assert len(planar.count) <= 5  # along the lid's sides, cells begin with all that is in them
    assert (len(planar.curves), len(planar.paints)) == (0, 2)


@pytest.mark.parametrize("apart", [0.0, 1e-12, 1e-9])
def test_copies_cost_what_one_costs(apart: float) -> None:
    rng = np.random.default_rng(3)
    corners = rng.random((7, 2))
    paths = [Path((polygon(corners + apart * k * (corners < 0.5)),), paint=RED) for k in range(60)]
    one, many = build_map(Drawing((paths[0],))), build_map(Drawing(tuple(paths)))
    assert (len(many.count), len(many.curves)) == (len(one.count), len(one.curves))


def test_more_faces_than_the_table_holds_at_first() -> None:
    rng = np.random.default_rng(5)
    discs = [circle(0.1 + 0.8 * rng.random(2), 0.08) for _ in range(150)]
    of = Drawing(tuple(Path((disc,), paint=Paint(tuple(rng.random(3).tolist()), 0.5)) for disc in discs))
    planar = build_map(of)
    assert len(planar.paints) > 1100
    assert check_points(of, planar, rng.random((200, 2))) > 150


def test_paints_know_which_paths_are_inside() -> None:
    rng = np.random.default_rng(5)
    discs = [circle(0.1 + 0.8 * rng.random(2), 0.08) for _ in range(150)]
    paints = [Paint(tuple(rng.random(3).tolist()), 1.0 if k % 9 == 8 else 0.5) for k in range(len(discs))]
    groups = [0 if 30 <= k < 50 else -1 for k in range(len(discs))]  # what is opaque in a group hides nothing below it
    paths = [Path((disc,), paint=paint, group=g) for disc, paint, g in zip(discs, paints, groups, strict=True)]
    of = Drawing(tuple(paths), groups=(Group(opacity=0.7),))
    planar, points = build_map(of), rng.random((200, 2))
    windings, distance = path_windings(of, points)
    for point, inside, off in zip(points, np.transpose(windings), distance, strict=True):
        if off > CLEAR:
            wanted = np.flatnonzero(inside)
            lids = [k for k in wanted if paints[k].is_opaque and groups[k] < 0]
            (paint,) = paints_at(planar, point)
            assert planar.stacks[paint].tolist() == wanted[wanted >= max(lids, default=0)].tolist()


@pytest.mark.parametrize("wedges", [5, 12, 15, 24])
def test_borders_that_meet_in_a_point(wedges: int) -> None:
    angles = np.linspace(0.1, 0.1 + 2 * np.pi, wedges + 1)
    rim = np.array([0.53, 0.51]) + 0.4 * np.column_stack([np.cos(angles), np.sin(angles)])
    pieces = [polygon([(0.53, 0.51), rim[k], rim[k + 1]]) for k in range(wedges)]
    of = Drawing(tuple(Path((piece,), paint=Paint((k % 3 / 2, k % 4 / 3, 0))) for k, piece in enumerate(pieces)))
    planar = build_map(of)
    assert check_points(of, planar, points_near(of, np.random.default_rng(2), 60)) > 20
    assert len(planar.count) < 60 * wedges


def test_a_cell_that_is_too_full_has_its_mean() -> None:
    rng = np.random.default_rng(7)
    lines = [polygon([(0.01, y), (0.99, 1 - y), (0.99, 1.004 - y)]) for y in rng.uniform(0.1, 0.9, 90)]
    of = Drawing(tuple(Path((line,), paint=Paint((k % 2, 0, 1 - k % 2), 0.5)) for k, line in enumerate(lines)))
    planar = build_map(of, max_depth=3)
    assert planar.unresolved > 0
    wanted = render_exact_colours(of, 8)
    for x in range(8):
        for y in range(8):
            quad, k, _ = cell_at(planar, ((x + 0.5) / 8, (y + 0.5) / 8))
            if planar.is_mean[quad, k]:
                np.testing.assert_allclose(planar.mean[quad, k], wanted[7 - y, x], atol=0.01)


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
