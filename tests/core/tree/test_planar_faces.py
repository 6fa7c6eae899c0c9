"""Faces of planar maps: which are one, and what is below them."""

import numpy as np
from test_planar import check_points, rings

from degenerate import circle, path_windings, polygon
from gradient_drawings import (
    UPWARDS,
    painted_path,
)
from planar import paints_at
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Group
from vexture.drawing.paint import Paint
from vexture.tree.planar.build import build_map

HALF_GREY = Paint((0.5, 0.5, 0.5), 0.5)


def test_faces_of_equal_programs_are_one_face() -> None:
    halves = [polygon([(x, 0.2), (x + 0.3, 0.2), (x + 0.3, 0.8), (x, 0.8)]) for x in (0.2, 0.5)]
    planar = build_map(Drawing((UPWARDS, *(painted_path(half, HALF_GREY) for half in halves))))
    whole = build_map(
        Drawing((UPWARDS, painted_path(polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]), HALF_GREY)))
    )
    assert len(planar.programs) == 2
    assert len(planar.curves) == len(whole.curves)


CLEAR = 3e-5  # unit-square units; beyond them rounding moves no outline
RED, BLUE = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0))


def test_what_opaque_paths_hide_costs_nothing() -> None:
    lid = Path((polygon([(0, 0), (1, 0), (1, 1), (0, 1)]),), paint=RED)
    planar = build_map(Drawing((*rings(40, 1.0).paths, lid)))
    assert len(planar.count) <= 5  # along the lid's sides, cells begin with all that is in them
    assert (len(planar.curves), len(planar.paints)) == (0, 2)


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
