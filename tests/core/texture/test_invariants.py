"""What every texture promises, asserted on decoded textures of real trees: random, drawn, letters and icons."""

import runpy
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import decode_by_format as by_format
import degenerate
from both_encodings import decode, encode
from vexture import read_svg
from vexture.base.errors import LimitError, SourceError, VextureError
from vexture.base.layout import LATTICE
from vexture.bezier.convert import line_cubics
from vexture.conversion.pipeline import run_encoding
from vexture.drawing.drawing import Drawing, FillRule
from vexture.drawing.drawing import Path as Outline
from vexture.renderers.exact import render_exact
from vexture.thesis.accuracy import accuracy_of, cell_tolerance
from vexture.thesis.build import DEFAULT_DEPTH
from vexture.thesis.encode import quantisation_step
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellTree

ROOT = Path(__file__).parents[3]
SHAPES = sorted((ROOT / "examples" / "shapes").glob("*.svg"))
LETTERS = "agR&8@%ß"
ICONS = range(6)
corpora = SimpleNamespace(**runpy.run_path(str(ROOT / "packages" / "vexture-evidence" / "benchmarks" / "corpora.py")))

SAGITTA = 1e-4  # of the brute force's chords, unit-square units
CHORDS = 128
JOINING = 6.0 / LATTICE  # cell sides: rounding to the builder's lattice, and what it takes for one point
AREA_ROUNDING = 1e-4  # of the drawing: the builder's lattice, and scanlines in crowded cells
TIGHT = 1e-4


class Converted(NamedTuple):
    """A drawing, what it became, and the accuracy that was asked for."""

    drawing: Drawing
    tree: CellTree
    texture: ThesisTexture
    walk: by_format.Walk
    max_depth: int
    tolerance: object

    @property
    def quantum(self):
        """Largest step of a point, in cell sides: ends move by up to one step of the edge index."""
        return 4.0 / self.texture.maximum

    def unresolved(self, leaf):
        return leaf.depth == self.max_depth and self.tree.unresolved > 0

    def distance(self, leaf):
        """How far the leaf's outline may be from the drawing's, in unit-square units."""
        cubics = np.concatenate([contour for path in self.drawing.paths for contour in path.contours])
        step = quantisation_step(self.texture.bits)
        promised = cell_tolerance(accuracy_of(self.tolerance, cubics, step), leaf.side)
        if self.unresolved(leaf):
            promised = max(promised, self.tree.deviation)
        return promised + leaf.side * (self.quantum + JOINING + by_format.CHORD_SAGITTA) + SAGITTA


def converted(drawing, bits, max_depth=DEFAULT_DEPTH, tolerance="auto"):
    conversion = run_encoding(drawing, "thesis", bits=bits, max_depth=max_depth, tolerance=tolerance)
    texture = conversion.texture
    return Converted(drawing, conversion.tree, texture, by_format.walk(texture), max_depth, tolerance)


# --- the invariants ---------------------------------------------------------------------------------------------------


def rows_are_met_once_and_in_order(shape, rng):
    assert shape.walk.quads == list(range(len(shape.texture.quads)))
    assert shape.walk.curves == list(range(2, len(shape.texture.curves)))
    assert sum(leaf.side**2 for leaf in shape.walk.leaves) == 1.0
    assert max(leaf.depth for leaf in shape.walk.leaves) <= shape.max_depth


def curves_stay_in_their_cells(shape, rng):
    for leaf in shape.walk.leaves:
        if not leaf.is_constant:
            line = by_format.line(shape.texture, leaf)
            assert max(-line.min(), line.max() - 1.0) <= shape.distance(leaf) / leaf.side, leaf


def outlines_are_listed_where_they_are(shape, rng):
    """Where a point of the outline has inside on one side and outside on the other, the leaf there passes by it."""
    cubics = np.concatenate([contour for path in shape.drawing.paths for contour in path.contours])
    chosen, t = cubics[rng.integers(0, len(cubics), 150)], rng.random((150, 1))
    s = 1.0 - t
    on = s**3 * chosen[:, 0] + 3 * s * s * t * chosen[:, 1] + 3 * s * t * t * chosen[:, 2] + t**3 * chosen[:, 3]
    along = s * s * (chosen[:, 1] - chosen[:, 0]) + t * t * (chosen[:, 3] - chosen[:, 2])
    along += 2 * s * t * (chosen[:, 2] - chosen[:, 1])
    normal = np.column_stack([-along[:, 1], along[:, 0]]) / np.maximum(np.hypot(*along.T), 1e-12)[:, None]
    held = by_format.leaf_at(shape.walk.leaves, on)
    on, normal, held = on[held >= 0], normal[held >= 0], held[held >= 0]
    leaves = [shape.walk.leaves[k] for k in held]
    reach = np.array([shape.distance(leaf) for leaf in leaves])
    to_edge = np.array(
        [min(*(p - leaf[:2]), *(np.add(leaf[:2], leaf.side) - p)) for p, leaf in zip(on, leaves, strict=True)]
    )
    sides, gaps = [], []
    for sign in (-1.0, 1.0):
        windings, gap = degenerate.path_windings(shape.drawing, on + sign * reach[:, None] * normal, CHORDS)
        sides.append(degenerate.silhouette(shape.drawing, windings))
        gaps.append(gap)
    bounds = (sides[0] != sides[1]) & (np.minimum(*gaps) > 0.9 * reach) & (to_edge > 2.0 * reach)
    for k in np.flatnonzero(bounds):
        leaf = leaves[k]
        if shape.unresolved(leaf):
            continue
        assert not leaf.is_constant, (on[k], leaf)
        line = (leaf.x, leaf.y) + leaf.side * by_format.line(shape.texture, leaf)
        assert distance_to(line, on[k]) <= reach[k], (on[k], leaf)


def distance_to(line, point):
    a, step = line[:-1], np.diff(line, axis=0)
    t = np.clip(((point - a) * step).sum(axis=1) / np.maximum((step**2).sum(axis=1), 1e-300), 0.0, 1.0)
    return np.hypot(*(a + t[:, None] * step - point).T).min()


def coverage_is_the_mean_of_the_cells(shape, rng):
    """But for quads with cells at the depth limit, which may say less than was measured."""
    blue = shape.texture.quads[:, :, 2] / shape.texture.maximum
    assert (blue == blue[:, :1]).all()
    blue = blue[:, 0]
    np.testing.assert_allclose(blue, shape.tree.quad_coverage, rtol=0, atol=0.5 / shape.texture.maximum + 1e-12)
    for quad in rng.permutation(len(blue))[:60]:
        mean, slack = 0.0, 1.0 / shape.texture.maximum
        for child in shape.walk.children[quad]:
            mean += blue[child] / 4.0
        for leaf in shape.walk.leaves_of[quad]:
            mean += by_format.area(shape.texture, leaf) / 4.0
            slack += np.inf if shape.unresolved(leaf) else 0.0
            if not leaf.is_constant:
                length = np.hypot(*np.diff(by_format.line(shape.texture, leaf), axis=0).T).sum()
                slack += (length * shape.distance(leaf) / leaf.side + by_format.AREA_ERROR) / 4.0
        assert abs(mean - blue[quad]) <= slack, quad


def root_coverage_is_the_area(shape, rng):
    truth = render_exact(shape.drawing, (128, 128)).mean(dtype=np.float64)
    found = shape.texture.quads[0, 0, 2] / shape.texture.maximum
    assert abs(found - truth) <= 0.5 / shape.texture.maximum + AREA_ROUNDING


def points_are_inside_where_the_drawing_says(shape, rng):
    """Within the stated distance of the outline either answer is right."""
    leaves = shape.walk.leaves
    chosen = rng.integers(0, len(leaves), 150)
    squares = np.array([leaf[:3] for leaf in leaves])[chosen]
    in_leaves = squares[:, :2] + squares[:, 2:] * rng.random((150, 2))
    points = np.concatenate([degenerate.points_near(shape.drawing, rng, 300), in_leaves])
    windings, gap = degenerate.path_windings(shape.drawing, points, CHORDS)
    truth = degenerate.silhouette(shape.drawing, windings)
    held = by_format.leaf_at(leaves, points)
    wrong = set()
    for k in np.unique(held):
        of_leaf = held == k
        answer = by_format.inside(shape.texture, leaves[k], points[of_leaf])
        if (answer != truth[of_leaf])[gap[of_leaf] > shape.distance(leaves[k])].any():
            wrong.add(leaves[k])
    assert not wrong


def round_trips_are_exact(shape, rng):
    texture, tree = shape.texture, shape.tree
    back = decode(texture)
    again = encode(back, texture.bits, to_source=texture.to_source, name=texture.name)
    np.testing.assert_array_equal(again.quads, texture.quads)
    np.testing.assert_array_equal(again.curves, texture.curves)
    np.testing.assert_array_equal(back.kind, tree.kind)
    np.testing.assert_array_equal(back.ref, tree.ref)
    assert np.abs(back.curves - tree.curves).max(initial=0.0) <= shape.quantum


INVARIANTS = [
    rows_are_met_once_and_in_order,
    curves_stay_in_their_cells,
    outlines_are_listed_where_they_are,
    coverage_is_the_mean_of_the_cells,
    root_coverage_is_the_area,
    points_are_inside_where_the_drawing_says,
    round_trips_are_exact,
]
every_invariant = pytest.mark.parametrize("invariant", INVARIANTS, ids=lambda invariant: invariant.__name__)


# --- the drawings -----------------------------------------------------------------------------------------------------


@cache
def random_shape(seed, bits):
    drawing = degenerate.drawing(seed)
    return converted(drawing, bits, max_depth=7 if bits == 16 else 3, tolerance=TIGHT) if drawing.segments else None


@every_invariant
@settings(max_examples=12)
@given(st.integers(0, 10**9), st.sampled_from([8, 16]))
@example(38, 16)  # curves that cross themselves under the even-odd rule
@example(700, 16)
def test_random_drawings(invariant, seed, bits):
    shape = random_shape(seed, bits)
    if shape is not None:
        invariant(shape, np.random.default_rng(seed))


def glyph(letter):
    try:
        return corpora.glyphs(corpora.dejavu_sans(), letter)[0]
    except SourceError as error:
        return str(error)


def icon(index):
    try:
        files = corpora.mdi(len(ICONS), seed=2)
    except VextureError as error:
        return str(error)
    return read_svg(files[index])


def big_loop(rule):
    """A loop on a short tail: what lies right of the curve, counted with its sign, is less than nothing."""
    lasso = np.array([[(0.5, 0.24), (0.0, 0.45), (0.0, 0.05), (0.5, 0.26)]])
    tail = np.array([(0.5, 0.26), (0.9, 0.26), (0.9, 0.24), (0.5, 0.24)])
    return Drawing((Outline((np.concatenate([lasso, line_cubics(tail[:-1], tail[1:])]),), rule),))


def hole_on_a_line(start):
    """A hole that lies in one cell of a quarter of the square and touches its edge where the contour starts."""
    hole = degenerate.backwards(degenerate.circle((0.40625, 0.375), 0.09375))
    frame = degenerate.polygon([(0.01, 0.01), (0.9, 0.01), (0.9, 0.9), (0.01, 0.9)])
    return Drawing((Outline((frame, np.roll(hole, start, axis=0))),))


SOURCES = {
    **{path.stem: (read_svg, path) for path in SHAPES},
    **{f"letter {letter}": (glyph, letter) for letter in LETTERS},
    **{f"icon {index}": (icon, index) for index in ICONS},
    **{f"big loop, {rule.name}": (big_loop, rule) for rule in FillRule},
    **{f"hole on a line, {start}": (hole_on_a_line, start) for start in range(2)},
}


@cache
def real_shape(source, bits):
    """The drawing converted, or why it cannot be."""
    read, what = SOURCES[source]
    drawing = read(what)
    if isinstance(drawing, str):
        return drawing
    try:
        return converted(drawing, bits)
    except LimitError as error:
        if bits == 16:
            raise
        return str(error)


@every_invariant
@pytest.mark.parametrize("bits", [pytest.param(8, marks=pytest.mark.slow), 16])
@pytest.mark.parametrize("source", SOURCES)
def test_real_drawings(source, bits, invariant):
    shape = real_shape(source, bits)
    if isinstance(shape, str):
        pytest.skip(shape)
    invariant(shape, np.random.default_rng(1))
