"""Figures of chapter 6 show what they say, for drawings of any kind."""

import numpy as np
import pytest
from fitting import assert_legible

from vexture.drawing.drawing import Drawing, FillRule
from vexture_evidence.figures.discussion import (
    before_after,
    density,
    edited_drawing,
    lines_at_borders,
    list_growth,
    stored_value_errors,
    unneeded_divisions,
)
from vexture_evidence.measures.editing import edit_texture
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, convert_by, example
from vexture_evidence.measures.stored_coverage import stored_values
from vexture_evidence.measures.thesis_limits import Lengths, close_up, unnecessary_quads

pytestmark = pytest.mark.slow  # test_report_is_whole draws these figures too

RINGS = Drawing.polygon(
    [(0.02, 0.4), (0.98, 0.4), (0.98, 0.6), (0.02, 0.6)],
    [(0.1, 0.45), (0.9, 0.45), (0.9, 0.55), (0.1, 0.55)],
    fill_rule=FillRule.EVENODD,
)


@pytest.fixture(scope="module", params=["duck", "hairline", "rings"])
def shape(request):
    if request.param != "rings":
        return ConvertedDrawing(example(request.param))
    made = ConvertedDrawing(example("duck"))
    made.drawing = RINGS
    return made


def test_before_after_shows_both_pictures_and_their_errors(shape):
    close = close_up(shape.drawing, shape.way("direct").texture, shape.way("packed").texture, side=32)
    part = close_up(shape.drawing, shape.way("direct").texture, shape.way("packed").texture, (0.4, 0.3, 0.6, 0.5), 32)
    figure = before_after([close, part], [("direct", "packed")] * 2)
    assert_legible(figure)
    for place, image in ((1, close.images[0]), (3, close.images[1]), (5, part.images[0]), (7, part.images[1])):
        assert (figure.axes[place].images[0].get_array() == image).all()
    assert f"{close.errors[0].mae:.2g}"[:3] in figure.axes[1].get_title(loc="left")
    assert figure.axes[4].get_xlim() == (0.4, 0.6)


def test_lines_at_borders_are_errors_on_one_scale(shape):
    close = close_up(shape.drawing, shape.way("direct").texture, shape.way("packed").texture, side=33, as_thesis=True)
    figure = lines_at_borders(close, ("before", "after"))
    assert_legible(figure)
    first, second = (axes.images[0] for axes in figure.axes[1:3])
    assert np.allclose(first.get_array(), 255.0 * abs(close.images[0].astype(float) - close.truth))
    assert first.get_clim() == second.get_clim()


def test_density_looks_where_the_first_is_farthest_off(shape):
    figure = density(shape.drawing, {way: shape.way(way).texture for way in ("direct", "packed")})
    assert_legible(figure)
    assert figure.axes[0].get_xlim() == figure.axes[1].get_xlim()
    for line in figure.axes[2].lines:
        assert (np.diff(line.get_ydata()) >= 0.0).all()


def test_every_unneeded_quad_is_marked():
    shield = ConvertedDrawing(example("simple-small"))
    textures = [shield.way(way).texture for way in ("sampled", "packed")]
    figure = unneeded_divisions(
        [(way, shield.drawing, texture) for way, texture in zip(("sampled", "packed"), textures, strict=True)]
    )
    assert_legible(figure)
    counts = [int(unnecessary_quads(shield.drawing, texture).sum()) for texture in textures]
    assert [len(axes.patches) for axes in figure.axes] == counts
    assert counts[0] > counts[1] == 0


def test_stored_values_have_one_scale(shape):
    tree = shape.way("direct").tree
    stored = {"one": stored_values(shape.drawing, tree), "two": stored_values(shape.drawing, shape.way("packed").tree)}
    figure = stored_value_errors(stored)
    assert_legible(figure)
    first, second = (axes.collections[0] for axes in figure.axes[:2])
    assert np.allclose(first.get_array(), 255.0 * stored["one"].off)
    assert first.get_clim() == second.get_clim()


def test_refused_copies_are_marked_and_not_drawn():
    lengths = {"direct": [Lengths(1, 8), Lengths(100, None, refused="too many")], "packed": [Lengths(100, 900)]}
    figure = list_growth(lengths, {"a part": np.zeros((4, 4))})
    assert_legible(figure)
    lines = {tuple(line.get_xdata()): line.get_marker() for line in figure.axes[0].lines}
    assert lines[1,] == "o"
    assert lines[100,] in "xs"


def test_what_was_drawn_in_addition_is_coloured():
    drawing = RINGS
    after = edit_texture(
        drawing, convert_by(drawing, WAYS["packed"]).texture, '<circle cx="0.5" cy="-0.8" r="0.1"/>', 1
    )
    figure = edited_drawing(convert_by(drawing, WAYS["direct"]).texture, after, np.zeros((8, 8)))
    assert_legible(figure)
    colours = [{line.get_color() for line in axes.lines} for axes in figure.axes[1:3]]
    assert len(colours[1]) == len(colours[0]) + 1
