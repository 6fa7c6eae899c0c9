"""Glyphs in colour: their pixels are those that OpenType's formulas and other renderers of the same shapes give."""

import io
from itertools import pairwise

import numpy as np
import pytest
from fontTools.ttLib import TTFont, newTable
from fontTools.ttLib.tables.otTables import PaintFormat
from fontTools.ttLib.tables.S_V_G_ import SVGDocument
from made import (
    BLUE,
    CLEAR_RED,
    GREEN,
    HALF,
    OWN,
    PALETTE,
    RED,
    composite,
    fill_shape,
    made_font,
    solid,
    stack_paints,
    transform_paint,
)
from painted_glyphs import close, colour_at, layers_of, premultiplied

import vexture
from vexture.base.errors import LimitError, SourceError
from vexture.fonts import layers as module
from vexture.fonts import text as texts
from vexture.fonts.face import faces_in
from vexture.fonts.layers import PORTER_DUFF, GlyphLayers


def over(above, below):
    return above + below * (1.0 - above[3])


def test_layers_of_both_versions_are_paths_in_their_order():
    found = layers_of(stack_paints(fill_shape("square", solid(RED)), fill_shape("disc", solid(BLUE, 0.5))))
    assert (len(found.paths), found.groups, found.notes) == (2, (), ())
    inside, outside = colour_at(found, (405, 405), (105, 605))
    close(inside, over(premultiplied(BLUE, 0.5), premultiplied(RED)))
    close(outside, premultiplied(RED))


def test_version_zero_and_the_colour_of_the_text():
    face = faces_in(made_font({"A": "square"}, {"A": [("square", GREEN), ("disc", OWN)]}))[0]
    assert face._font.face.has_color_layers
    found = face.layers(face._font.get_nominal_glyph(ord("A")), foreground=(0.25, 0.5, 0.75))
    close(found.paths[0].paint.color, PALETTE[GREEN][:3])
    assert found.paths[1].paint.color == (0.25, 0.5, 0.75)


def test_a_plain_glyph_has_no_layers():
    face = faces_in(made_font({"A": "square", "B": "disc"}, {"A": solid(RED)}))[0]
    assert face.layers(face._font.get_nominal_glyph(ord("B"))) is None


def test_a_glyph_in_a_glyph_is_their_intersection():
    found = layers_of(fill_shape("square", fill_shape("tall", solid(RED))))
    inside, above, beside = colour_at(found, (405, 305), (405, 755), (205, 305))
    close(inside, premultiplied(RED))
    assert not above.any()
    assert not beside.any()


@pytest.mark.parametrize("mode", [*PORTER_DUFF, "SRC_OVER", "DEST_OVER", "PLUS", "MULTIPLY", "HSL_HUE"])
def test_composite_modes_are_those_of_the_compositing_specification(mode):
    """Above a half transparent square, below an almost opaque one; where both, one and none of them are."""
    found = layers_of(composite(mode, fill_shape("tall", solid(HALF)), fill_shape("left", solid(BLUE, 0.75))))
    above, below = premultiplied(HALF), premultiplied(BLUE, 0.75)
    nothing = np.zeros(4)
    points = ((405, 305), (555, 305), (205, 305), (805, 305))
    pairs = ((above, below), (above, nothing), (nothing, below), (nothing, nothing))
    for colour, pair in zip(colour_at(found, *points), pairs, strict=True):
        close(colour, mixed(mode, *pair))


def mixed(mode, s, b):
    """Premultiplied colours by the formulas of Compositing and Blending Level 1, sections 9 and 10."""
    if mode in ("MULTIPLY", "HSL_HUE"):
        if not s[3] or not b[3]:
            return over(s, b)
        blend = s[:3] / s[3] * b[:3] / b[3] if mode == "MULTIPLY" else hue_of(s[:3] / s[3], b[:3] / b[3])
        colour = (1 - b[3]) * s[:3] + (1 - s[3]) * b[:3] + s[3] * b[3] * blend
        return np.array([*colour, s[3] + b[3] - s[3] * b[3]])
    a, c = s[3], b[3]
    parts = {
        "CLEAR": (0, 0),
        "SRC": (1, 0),
        "DEST": (0, 1),
        "SRC_OVER": (1, 1 - a),
        "DEST_OVER": (1 - c, 1),
        "SRC_IN": (c, 0),
        "DEST_IN": (0, a),
        "SRC_OUT": (1 - c, 0),
        "DEST_OUT": (0, 1 - a),
        "SRC_ATOP": (c, 1 - a),
        "DEST_ATOP": (1 - c, a),
        "XOR": (1 - c, 1 - a),
        "PLUS": (1, 1),
    }
    above, below = parts[mode]
    return np.minimum(s * above + b * below, 1.0)


def hue_of(source, backdrop):
    weights = np.array([0.3, 0.59, 0.11])
    low, middle, high = np.argsort(source)
    spread = np.zeros(3)
    range_ = backdrop.max() - backdrop.min()
    spread[middle] = (source[middle] - source[low]) * range_ / (source[high] - source[low])
    spread[high] = range_
    colour = spread + (weights @ backdrop - weights @ spread)
    light = weights @ colour
    if colour.min() < 0:
        colour = light + (colour - light) * light / (light - colour.min())
    if colour.max() > 1:
        colour = light + (colour - light) * (1 - light) / (colour.max() - light)
    return colour


def test_a_glyph_clips_what_is_within_its_box():
    found = layers_of(fill_shape("disc", transform_paint(fill_shape("square", solid(RED)), 0.2, 0, 0, 0.2, 190, 105)))
    corner, inside = colour_at(found, (225, 125), (345, 235))
    assert not corner.any()
    close(inside, premultiplied(RED))


def test_a_paint_without_a_glyph_is_within_what_it_is_combined_with():
    found = layers_of(composite("SRC_IN", solid(RED), fill_shape("left", solid(OWN))))
    inside, outside = colour_at(found, (205, 305), (605, 305))
    close(inside, premultiplied(RED))
    assert not outside.any()


def test_groups_that_combine_each_other_many_times_are_refused(monkeypatch):
    monkeypatch.setattr(module, "MOST_PATHS", 20)
    paint = fill_shape("square", solid(RED, 0.5))
    for _ in range(6):
        paint = composite("XOR", paint, fill_shape("disc", solid(CLEAR_RED)))
    with pytest.raises(SourceError, match="a glyph paints more than 20 paths and groups; use another font"):
        layers_of(paint)


def test_a_chain_of_groups_without_a_path_is_refused():
    """Only paths were counted: 50 groups that mask each other, with nothing to paint, took all time and memory."""
    paint = solid(GREEN)
    for _ in range(50):
        paint = composite("XOR", paint, solid(RED))
    with pytest.raises(SourceError, match="a glyph paints more than 10,000 paths and groups; use another font"):
        layers_of(paint)


def glyph_of(name):
    return {"Format": PaintFormat.PaintColrGlyph, "Glyph": f"u{ord(name):04X}"}


def test_glyphs_that_paint_each_other_end():
    """In a circle, and twice each to a depth of 16: HarfBuzz paints what its limits allow."""
    last = fill_shape("square", solid(RED))
    circle = {"A": stack_paints(glyph_of("B"), last), "B": stack_paints(glyph_of("A"), last)}
    names = "ABCDEFGHIJKLMNOPQ"
    twice = {a: stack_paints(glyph_of(b), glyph_of(b)) for a, b in pairwise(names)} | {"Q": last}
    for paints in (circle, twice):
        face = faces_in(made_font(dict.fromkeys(paints, "square"), paints))[0]
        assert 1 <= len(face.layers(face._font.get_nominal_glyph(ord("A"))).paths) <= 10_000


def test_a_text_of_glyphs_of_many_paths_is_refused(monkeypatch, tmp_path):
    """100,000 characters of 10,000 paths each were a billion."""
    monkeypatch.setattr(texts, "MOST_PARTS", 1000)
    (tmp_path / "a.ttf").write_bytes(
        made_font({"A": "square"}, {"A": stack_paints(*[fill_shape("square", solid(RED))] * 99)})
    )
    assert len(vexture.text("AA", font=tmp_path / "a.ttf").paths) == 198
    with pytest.raises(LimitError, match="`text` has more than 1,000 segments and groups; draw it in parts"):
        vexture.text("AAA", font=tmp_path / "a.ttf")


def test_pictures_are_named_and_their_outline_is_shown():
    face = faces_in(with_svg())[0]
    glyph = face._font.get_nominal_glyph(ord("A"))
    found = face.layers(glyph)
    assert isinstance(found, GlyphLayers)
    assert [str(note) for note in found.notes] == ["glyphs that are SVG documents, shown as outlines"]
    assert found.paths[0].contours == face.outline(glyph)


def with_svg():
    font = TTFont(io.BytesIO(made_font({"A": "square"})))
    place = font.getGlyphID("u0041")
    font["SVG "] = table = newTable("SVG ")
    table.docList = [SVGDocument(f'<svg xmlns="http://www.w3.org/2000/svg"><g id="glyph{place}"/></svg>', place, place)]
    file = io.BytesIO()
    font.save(file)
    return file.getvalue()
