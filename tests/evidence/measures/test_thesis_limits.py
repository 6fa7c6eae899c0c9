"""The rules of the thesis that are restored, and what is measured of them, against closed forms."""

import numpy as np
import pytest

from vexture.conversion.pipeline import run_encoding
from vexture.drawing.drawing import Drawing, Path
from vexture.renderers.exact import render_exact
from vexture.thesis.tree import CellKind
from vexture_evidence.measures.leaves import leaves
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, convert_by, example
from vexture_evidence.measures.thesis_limits import (
    clamp_curves,
    close_up,
    corner_cells,
    list_lengths,
    looping,
    repeat_drawing,
    sharp_corners,
    unnecessary_quads,
)

QUARTER = Drawing.polygon([(0.1, 0.1), (0.4, 0.1), (0.4, 0.35), (0.1, 0.35)])
CIRCLE = 0.5522847498


@pytest.fixture(scope="module")
def shield():
    return ConvertedDrawing(example("simple-small"))


def disc(radius=0.3):
    """Four cubics that are a circle but for 3e-4 of its radius."""
    quarter = radius * np.array([(1.0, 0.0), (1.0, CIRCLE), (CIRCLE, 1.0), (0.0, 1.0)])
    turn = np.array([(0.0, 1.0), (-1.0, 0.0)])
    cubics = np.stack([quarter @ np.linalg.matrix_power(turn, k) for k in range(4)]) + 0.5
    cubics[:, 3] = np.roll(cubics[:, 0], -1, axis=0)
    return Drawing((Path((cubics,)),))


def test_clamp_moves_inner_points_along_the_chord_only():
    tree = convert_by(looping(), WAYS["direct"]).tree
    kept, changed = clamp_curves(tree)
    assert changed == 4
    chord = tree.curves[:, 3] - tree.curves[:, 0]
    moved = kept.curves[:, 1:3] - tree.curves[:, 1:3]
    across = moved[..., 0] * chord[:, None, 1] - moved[..., 1] * chord[:, None, 0]
    assert abs(across).max() < 1e-12
    along = np.einsum("kpi,ki->kp", kept.curves[:, 1:3] - kept.curves[:, :1], chord) / (chord**2).sum(axis=1)[:, None]
    assert along.min() > -1e-12
    assert along.max() < 1.0 + 1e-12


def test_clamp_leaves_curves_in_range_and_corners_alone(shield):
    tree = shield.way("direct").tree
    kept, changed = clamp_curves(tree)
    assert changed == 0
    assert (kept.curves == tree.curves).all()


def test_clamp_leaves_straight_corners_alone():
    tree = convert_by(QUARTER, WAYS["direct"]).tree
    assert (tree.kind == CellKind.CORNER).any()
    assert (clamp_curves(tree, 0.4, 0.41)[0].curves == tree.curves)[tree.ref[tree.kind == CellKind.CORNER]].all()


def test_looping_drawing_crosses_itself_in_each_quarter():
    truth = render_exact(looping(), (64, 64))
    assert np.allclose(truth, truth[::-1], atol=1e-3)
    assert np.allclose(truth, truth.T, atol=1e-3)
    assert truth[32, 32] == 1.0
    assert (truth[:16, :16] > 0.5).any()  # the loop, outside the square of the four points


def test_sharp_corners_are_where_the_outline_turns():
    assert len(sharp_corners(disc())) == 0
    assert sorted(map(tuple, sharp_corners(QUARTER))) == [(0.1, 0.1), (0.1, 0.35), (0.4, 0.1), (0.4, 0.35)]
    hexagon = [(0.5 + 0.4 * np.cos(a), 0.5 + 0.4 * np.sin(a)) for a in np.arange(16) * np.pi / 8]
    assert len(sharp_corners(Drawing.polygon(hexagon))) == 0  # 22.5 degrees each
    assert len(sharp_corners(Drawing(()))) == 0


def test_corner_cells_count_cells_with_curves_within_reach():
    half = Drawing.polygon([(0, 0), (1, 0), (1, 0.3), (0, 0.6)])
    found = leaves(convert_by(half, WAYS["direct"]).texture)
    with_curves = len(np.unique(found.owner))
    assert corner_cells(found, np.array([(0.5, 0.5)]), 2.0).tolist() == [with_curves]
    assert corner_cells(found, np.array([(0.2, 0.99)]), 0.01).tolist() == [1]  # the upper left quarter holds the line


def test_unnecessary_quads_are_those_around_one_stretch_of_one_cubic():
    line = Drawing.polygon([(0, 0), (1, 0), (1, 0.3), (0, 0.3)])
    deep = run_encoding(line, "thesis").tree
    assert not unnecessary_quads(line, deep).any()
    # the same cells for a drawing whose outline is one line where the other has a corner
    corner = Drawing.polygon([(0, 0), (1, 0), (1, 0.3), (0.3, 0.3), (0.29, 0.37), (0.28, 0.3), (0, 0.3)])
    tree = run_encoding(corner, "thesis", strategy="sampled").tree
    assert not unnecessary_quads(corner, tree).all()
    needless = unnecessary_quads(line, tree)
    assert needless[1:].any()
    joint = Drawing.polygon([(0, 0), (1, 0), (1, 0.3), (0.285, 0.3), (0, 0.3)])  # two cubics on that line
    assert 0 < unnecessary_quads(joint, tree).sum() < needless.sum()


def test_packed_divides_nothing_without_need(shield):
    assert unnecessary_quads(shield.drawing, shield.way("sampled").texture).sum() > 0
    assert unnecessary_quads(shield.drawing, shield.way("packed").texture).sum() == 0


def test_close_up_shows_the_thesis_lines_and_that_they_are_gone():
    duck = ConvertedDrawing(example("duck"))
    close = close_up(duck.drawing, duck.way("direct").texture, duck.way("packed").texture, side=61, as_thesis=True)
    before, after = close.stray
    assert before > 5
    assert after == 0
    ours = close_up(duck.drawing, duck.way("direct").texture, duck.way("packed").texture, side=61)
    assert ours.stray == (0, 0)


def test_copies_cover_as_much_as_one():
    assert render_exact(repeat_drawing(QUARTER, 3), (1, 1))[0, 0] == pytest.approx(0.3 * 0.25, abs=1e-5)


def test_lists_grow_until_they_are_refused():
    triangle = Drawing.polygon([(0.11, 0.13), (0.87, 0.21), (0.43, 0.83)])
    found = list_lengths(triangle, {"encoding": "thesis", "bits": 8}, (1, 4, 12, 13))
    assert [length.copies for length in found] == [1, 16, 144]  # nothing is tried after a refusal
    assert found[-1].entries is None
    assert "the limit is 256" in found[-1].refused
    assert found[0].entries < found[1].entries <= 256
