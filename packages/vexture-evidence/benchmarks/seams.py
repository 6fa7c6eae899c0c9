"""Steps of an outline where it crosses from one cell into the next, under large magnification.

An outline is stored piece by piece, each on its own cell's lattice. It may be displaced as a whole, by less than a
lattice unit, and at these magnifications that is several pixels; what would show is a *step*: a displacement on one
side of a cell border that is not the displacement on the other side.

It is measured in a window of `SIDE` x `SIDE` pixels around a point where the outline crosses a border, from the
difference between picture and truth, whose integral across the outline is the displacement in pixels. Averages of it
along the outline, with smooth weights, are taken over the `REACH` pixels before the border, behind it, and around it
(`NOTCH` pixels either way). The step is the larger of: before against behind, around against the mean of both.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

import corpora
from report import cell, table
from targets import Target
from vexture.base.layout import LATTICE
from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact
from vexture.tree.build import build_tree
from vexture.tree.tree import Tree
from vexture_evidence.measures.programs import packed_program, packed_texture
from views import PictureView

SIDE: Final = 64
REACH: Final = 20.0
NOTCH: Final = 3.0
PIXELS: Final = 1000.0
"""A magnification of 1 shows the unit square this wide."""

CASES: Final = ((1_000.0, None), (10_000.0, 1e-7))
"""Magnifications and the precision that the texture is made with."""

CROSSINGS: Final = 40
"""Of each drawing, drawn at random."""

STRAIGHT: Final = 1.0
"""Pixels; where the outline bends or branches in a window by more, it has a corner there and is left out."""

LIMITS: Final = (0.05, 0.01)
"""Pixels. The aim is none: a fifth of the limit is what the measure itself is good to."""


class Crossing(NamedTuple):
    """A point of the unit square where the outline crosses a cell's border, and the outline's direction there."""

    point: NDArray[np.float64]
    tangent: NDArray[np.float64]


def leaf_of_curves(tree: Tree) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lower left corner, (curves, 2), and side, (curves,), of the leaf that holds each curve."""
    corner, side = np.zeros((len(tree.count), 2)), np.ones(len(tree.count))
    curve_corner, curve_side = np.zeros((len(tree.curves), 2)), np.zeros(len(tree.curves))
    for quad in range(len(tree.count)):
        below, curve = int(tree.first_quad[quad]), int(tree.first_curve[quad])
        for k in range(4):
            place, half = corner[quad] + 0.5 * side[quad] * np.array([k & 1, k >> 1]), 0.5 * side[quad]
            if tree.is_quad[quad, k]:
                corner[below], side[below] = place, half
                below += 1
            else:
                count = int(tree.count[quad, k])
                curve_corner[curve : curve + count], curve_side[curve : curve + count] = place, half
                curve += count
    return curve_corner, curve_side


def crossings(tree: Tree) -> Iterator[Crossing]:
    """Every end of a curve that lies on its leaf's border, but for those on the border of the unit square."""
    corners, sides = leaf_of_curves(tree)
    for curve, corner, side in zip(tree.curves / LATTICE, corners, sides, strict=True):
        for end, control in ((0, 1), (3, 2)):
            point = corner + side * curve[end]
            way = curve[control] - curve[end]
            length = math.hypot(*way)
            on_border = bool(((curve[end] == 0.0) | (curve[end] == 1.0)).any())
            if on_border and length > 0.0 and point.min() > 0.0 and point.max() < 1.0:
                yield Crossing(point, way / length)


def smooth(along: NDArray[np.float64], low: float, high: float) -> NDArray[np.float64]:
    """Weights that rise from 0 at both ends of a stretch, of integral 1."""
    inside = (along > low) & (along < high)
    wave = 1.0 - np.cos(2.0 * np.pi * (along - low) / (high - low))
    return np.where(inside, wave / (high - low), 0.0)


def displacements(difference: NDArray[np.floating[Any]], direction: tuple[float, float]) -> tuple[float, float, float]:
    """Displacements, in pixels, of an outline through the middle of a window: before it, behind it, around it.

    Parameters
    ----------
    difference : (side, side) array
        Picture minus truth.
    direction : tuple of float
        Of the outline in the picture, x to the right and y down, of length 1.
    """
    middle = difference.shape[0] / 2.0
    down, right = (axis + 0.5 - middle for axis in np.indices(difference.shape))
    along = right * direction[0] + down * direction[1]
    before, behind, around = (
        float((difference * smooth(along, *stretch)).sum())
        for stretch in ((-REACH, 0.0), (0.0, REACH), (-NOTCH, NOTCH))
    )
    return before, behind, around


def step_of(difference: NDArray[np.floating[Any]], direction: tuple[float, float]) -> float:
    """Step, in pixels, of an outline through the middle of a window; parameters as of `displacements`."""
    before, behind, around = displacements(difference, direction)
    return max(abs(behind - before), abs(around - 0.5 * (before + behind)))


def window_at(point: NDArray[np.float64], magnification: float) -> PictureView:
    """Window of pixels around a point."""
    pixel = 1.0 / (magnification * PIXELS)
    half = 0.5 * SIDE * pixel
    to_unit = np.array([[pixel, 0.0, point[0] - half], [0.0, -pixel, point[1] + half], [0.0, 0.0, 1.0]])
    return PictureView((SIDE, SIDE), to_unit)


def is_straight(truth: NDArray[np.float32], crossing: Crossing) -> bool:
    """Whether truth is a half-plane, displaced or not: across the outline it sums to the same all along."""
    right, down = crossing.tangent[0], -crossing.tangent[1]
    middle = SIDE / 2.0
    rows, columns = (axis + 0.5 - middle for axis in np.indices(truth.shape))
    along, across = columns * right + rows * down, rows * right - columns * down
    near = np.abs(across) < REACH
    sums = [float((truth * near * smooth(along, low, low + NOTCH)).sum()) for low in np.arange(-REACH, REACH, NOTCH)]
    return float(np.ptp(sums)) < STRAIGHT and min(sums) > 1.0 and max(sums) < 2.0 * REACH - 1.0


def drawing_steps(
    drawing: Drawing, magnification: float, precision: float | None, count: int, seed: int
) -> list[float]:
    """Steps at some crossings of one drawing, of both programs the larger."""
    tree = build_tree(drawing, precision=precision)
    texture = packed_texture(drawing, precision=precision)
    programs = [packed_program(texture, is_flat) for is_flat in (True, False)]
    found = list(crossings(tree))
    chosen = np.random.default_rng(seed).permutation(len(found))[:count]
    steps = []
    for crossing in (found[k] for k in chosen):
        view = window_at(crossing.point, magnification)
        truth = render_exact(drawing, *view)
        if is_straight(truth, crossing):
            direction = (float(crossing.tangent[0]), float(-crossing.tangent[1]))
            steps.append(max(step_of(program.image(*view) - truth, direction) for program in programs))
    return steps


def seam_facts(seed: int, quick: bool) -> list[dict[str, Any]]:
    """Steps of glyphs and round shapes in every case."""
    text, count = ("ag", CROSSINGS // 4) if quick else ("agR&8@", CROSSINGS)
    fonts = (("DejaVu Sans", corpora.dejavu_sans()), ("STIX", corpora.stix()))
    drawings = [
        replace(glyph, name=f"{name} {glyph.name}") for name, font in fonts for glyph in corpora.glyphs(font, text)
    ]
    drawings += corpora.round_shapes()
    facts = []
    for magnification, precision in CASES:
        steps = [drawing_steps(drawing, magnification, precision, count, seed) for drawing in drawings]
        facts.append(
            {
                "magnification": magnification,
                "precision": precision,
                "crossings": sum(map(len, steps)),
                "largest": {
                    drawing.name: max(found, default=0.0) for drawing, found in zip(drawings, steps, strict=True)
                },
                "steps": steps,
            }
        )
    return facts


def seam_table(facts: Sequence[dict[str, Any]]) -> str:
    """Table of the steps."""
    rows = []
    for case in facts:
        steps = np.concatenate([np.array(found) for found in case["steps"]])
        rows.append(
            [
                f"{case['magnification']:,.0f}x",
                cell(case["precision"]) if case["precision"] is None else f"{case['precision']:g}",
                str(case["crossings"]),
                cell(float(np.median(steps)), 4),
                cell(float(np.quantile(steps, 0.99)), 4),
                cell(float(steps.max()), 4),
                str(int((steps > LIMITS[0]).sum())),
            ]
        )
    head = ("seams", "precision", "crossings", "median step", "99%", "largest", f"above {LIMITS[0]:g} px")
    return table(head, rows)


def seam_targets(facts: Sequence[dict[str, Any]]) -> list[Target]:
    """Targets for the steps."""
    return [
        Target(f"largest step at {case['magnification']:,.0f}x, px", max(case["largest"].values()), *LIMITS)
        for case in facts
    ]
