"""The rules of the thesis that are restored, and what is measured of them, against closed forms."""

import numpy as np
import pytest

from both_encodings import decode
from vexture.conversion.pipeline import run_encoding
from vexture.drawing.drawing import Drawing, Path
from vexture.renderers.exact import render_exact
from vexture.thesis.tree import CellKind
from vexture_evidence.measures.leaves import leaves
from vexture_evidence.measures.outline import first_samples, off_outline
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, convert_by, example
from vexture_evidence.measures.stored_coverage import stored_values
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


def test_distances_from_an_outline_are_those_of_the_circle():
    rng = np.random.default_rng(6)
    points = rng.uniform(0.0, 1.0, (200, 2))
    radial = abs(np.hypot(*(points - 0.5).T) - 0.3)
    assert np.allclose(off_outline(points, disc()), radial, atol=1e-4)


def test_distances_of_points_far_from_everything_are_those_of_the_nearest_chord():
    tiny = Drawing.polygon([(0.9, 0.9), (0.91, 0.9), (0.91, 0.91)])
    assert off_outline(np.array([(0.0, 0.9), (0.9, 0.0), (0.905, 0.9)]), tiny) == pytest.approx([0.9, 0.9, 0.0])


def test_nearest_chord_is_found_beyond_the_margin():
    right = [(0.53, 0.4), (0.53, 0.6), (0.56, 0.5)]
    left = [(0.4834, 0.4), (0.4834, 0.6), (0.45, 0.5)]
    point = np.array([(0.5001, 0.5)])
    assert off_outline(point, Drawing.polygon(right)) == pytest.approx([0.0299])
    assert off_outline(point, Drawing.polygon(right, left)) == pytest.approx([0.0167])


@pytest.mark.parametrize("off", [1e-3, 1e-7])
def test_distances_are_found_to_rounding(off):
    cubic = np.array([(0.1, 0.1), (0.1, 0.1001), (0.9, 0.2), (0.9, 0.9)])  # starts slowly
    back = np.linspace(cubic[3], cubic[0], 4)
    t = np.linspace(0.01, 0.99, 33)[:, None]
    s = 1.0 - t
    p0, p1, p2, p3 = cubic
    point = s**3 * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t**3 * p3
    tangent = 3 * s * s * (p1 - p0) + 6 * s * t * (p2 - p1) + 3 * t * t * (p3 - p2)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1) / np.linalg.norm(tangent, axis=1)[:, None]
    drawing = Drawing((Path((np.stack([cubic, back]),)),))
    assert off_outline(point + off * normal, drawing) == pytest.approx(off, rel=1e-6)


def test_first_samples_lie_on_the_outline_and_are_as_dense_as_the_thesis_has_them():
    points = first_samples(QUARTER)
    assert off_outline(points, QUARTER).max() < 1e-12
    assert len(points) == sum(np.ceil(256 * side).astype(int) for side in (0.3, 0.25, 0.3, 0.25))


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


def test_stored_values_are_compared_with_the_area():
    conversion = convert_by(QUARTER, WAYS["direct"])
    values = stored_values(QUARTER, conversion.tree)
    assert values.quad_off.max() < 1e-4
    packed = stored_values(QUARTER, decode(convert_by(QUARTER, WAYS["packed"]).texture))
    assert 0.0 < packed.quad_off[0] <= 0.51 / 255
    wrong = conversion.tree
    wrong.coverage[0] += 0.1
    assert stored_values(QUARTER, wrong).quad_off[0] == pytest.approx(0.1, abs=1e-4)


def test_sixteen_samples_know_areas_in_sixteenths(shield):
    conversion = shield.way("sampled")
    values = stored_values(shield.drawing, conversion.tree, conversion.texture)
    with_curve = np.unique(values.found.owner)
    assert np.allclose(16 * values.found.coverage[with_curve], np.rint(16 * values.found.coverage[with_curve]))


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
