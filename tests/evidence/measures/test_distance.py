"""Distance fields against closed formulas, and what is known of their pictures."""

import numpy as np
import pytest

from vexture.base.errors import LimitError
from vexture.bezier.convert import line_cubics
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.renderers.exact import render_exact
from vexture.svg.read import read_svg
from vexture_evidence.measures.closeups import closeup
from vexture_evidence.measures.distance import LARGEST, distance_from, signed_distances
from vexture_evidence.measures.metrics import errors

SQUARE = ((0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75))


def centres(side):
    """x and y, up, of the texels' centres."""
    at = (np.arange(side) + 0.5) / side
    return np.meshgrid(at, at[::-1])


def box_distance(x, y, low=0.25, high=0.75):
    """Signed distance from a square's border, above 0 inside (closed formula)."""
    dx, dy = (np.maximum(low - axis, axis - high) for axis in (x, y))
    outside = np.hypot(np.maximum(dx, 0), np.maximum(dy, 0))
    return -(outside + np.minimum(np.maximum(dx, dy), 0))


@pytest.mark.parametrize("side", [7, 16, 33, 200])
def test_distances_from_a_square(side):
    found = signed_distances(Drawing.polygon(SQUARE), side, 0.2)
    np.testing.assert_allclose(found, np.clip(box_distance(*centres(side)), -0.2, 0.2), atol=1e-9)


def test_distances_from_a_circle(tmp_path):
    (tmp_path / "circle.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1 1"><circle cx=".5" cy=".5" r=".3"/></svg>'
    )
    x, y = centres(64)
    found = signed_distances(read_svg(tmp_path / "circle.svg"), 64, 0.1)
    np.testing.assert_allclose(found, np.clip(0.3 - np.hypot(x - 0.5, y - 0.5), -0.1, 0.1), atol=2e-4)


def test_edges_inside_the_silhouette_do_not_count():
    """Two overlapping rectangles, and two that share an edge, are one box."""
    whole = signed_distances(Drawing.polygon(SQUARE), 32, 0.2)
    for split in ((0.6, 0.4), (0.5, 0.5)):
        left = ((0.25, 0.25), (split[0], 0.25), (split[0], 0.75), (0.25, 0.75))
        right = ((split[1], 0.25), (0.75, 0.25), (0.75, 0.75), (split[1], 0.75))
        both = Drawing(Drawing.polygon(left).paths + Drawing.polygon(right).paths)
        off = np.abs(signed_distances(both, 32, 0.2) - whole)
        assert off.max() < 0.2 / 32


def test_holes_of_the_even_odd_rule_are_outside():
    inner = ((0.4, 0.4), (0.6, 0.4), (0.6, 0.6), (0.4, 0.6))
    rings = [line_cubics(np.array(ring), np.roll(np.array(ring), -1, axis=0)) for ring in (SQUARE, inner)]
    found = signed_distances(Drawing((Path(tuple(rings), FillRule.EVENODD),)), 40, 0.2)
    x, y = centres(40)
    np.testing.assert_allclose(
        found, np.clip(np.minimum(box_distance(x, y), -box_distance(x, y, 0.4, 0.6)), -0.2, 0.2), atol=1e-9
    )


def test_texels_are_distances_in_steps_of_the_spread():
    field = distance_from(Drawing.polygon(SQUARE), 32, 3.0)
    expected = 255 * np.clip(0.5 + box_distance(*centres(32)) * 32 / 6.0, 0, 1)
    assert np.abs(field.texels - expected).max() <= 0.5 + 1e-6
    assert [len(level) for level in field.mips] == [16, 8, 4, 2, 1]
    assert field.nbytes == 1365


def test_straight_edges_are_sharp_at_any_size_and_corners_are_not():
    drawing, size = Drawing.polygon(SQUARE), (128, 128)
    field = distance_from(drawing, 32)

    def worst(place):
        view = closeup(size, np.array(place), 16.0)
        return errors(field.sample(size, view), render_exact(drawing, size, view)).max

    assert worst((0.25, 0.5)) < 10
    assert worst((0.75, 0.75)) > 200


def test_full_is_full_and_outside_is_empty_where_it_is_small():
    drawing = Drawing.polygon(((0, 0), (1, 0), (1, 1), (0, 1)))
    field = distance_from(drawing, 64)
    assert field.sample((3, 3))[1, 1] == 1.0
    around = field.sample((3, 3), closeup((3, 3), np.array([0.5, 0.5]), 1 / 3))
    assert around[1, 1] == pytest.approx(1.0, abs=0.6)
    assert not np.delete(around.ravel(), 4).any()


def test_a_shape_up_to_the_square_s_border_ends_there():
    drawing, size = Drawing.polygon(((0, 0), (1, 0), (1, 1), (0, 1))), (64, 64)
    view = closeup(size, np.array([0.0, 0.5]), 4.0)
    found = errors(distance_from(drawing, 16).sample(size, view), render_exact(drawing, size, view))
    assert found.mae < 1.0


def test_an_empty_drawing_is_empty():
    field = distance_from(Drawing(()), 16)
    assert not field.texels.any()
    assert not field.sample((8, 8)).any()


@pytest.mark.parametrize("side", [0, LARGEST + 1])
def test_side_out_of_range_is_said(side):
    with pytest.raises(LimitError, match=f"1..{LARGEST}"):
        distance_from(Drawing.polygon(SQUARE), side)
