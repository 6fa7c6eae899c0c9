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
    line,
    linear,
    made_font,
    radial,
    solid,
    stack_paints,
    sweep,
    transform_paint,
)

import vexture
from vexture.base.errors import LimitError, SourceError
from vexture.drawing.drawing import Drawing, Path
from vexture.fonts import layers as module
from vexture.fonts import text as texts
from vexture.fonts.face import faces_in
from vexture.fonts.layers import PORTER_DUFF, GlyphLayers
from vexture.renderers.exact import render_exact_colours


def layers_of(paint, **options):
    face = faces_in(made_font({"A": "square"}, {"A": paint}))[0]
    return face.layers(face._font.get_nominal_glyph(ord("A")), **options)


def colour_at(layers, *points):
    """Premultiplied colours at points of the em, by the exact renderer: each the mean of a hundredth of the em."""
    found = Drawing.from_source(
        [
            Path(tuple(contour * [1, -1] for contour in path.contours), path.fill_rule, flipped(path), path.group)
            for path in layers.paths
        ],
        (0, -900, 1000, 1000),
        groups=layers.groups,
    )
    image = render_exact_colours(found, 100)
    return [image[int((900 - y) / 10), int(x / 10)] for x, y in points]


def flipped(path):
    return path.paint.after(((1, 0, 0), (0, -1, 0)))


def premultiplied(color, alpha=1.0):
    red, green, blue, own = PALETTE[color]
    return np.array([red, green, blue, 1.0]) * own * alpha


def over(above, below):
    return above + below * (1.0 - above[3])


def close(found, expected):
    np.testing.assert_allclose(found, expected, atol=1.5 / 255)


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


def ramp(first, last, part):
    a, b = (np.array(PALETTE[color]) for color in (first, last))
    color = a + (b - a) * part
    return np.array([*color[:3], 1.0]) * color[3]


@pytest.mark.parametrize(("extend", "part"), [("pad", 1.0), ("repeat", 0.275), ("reflect", 0.725)])
def test_linear_gradient_is_straightened_and_goes_on_beyond_its_stops(extend, part):
    """The stops are at 0.25 and 0.75, and p2 slants the gradient."""
    colors = line((0.25, RED, 1), (0.75, BLUE, 1), extend=extend)
    found = layers_of(fill_shape("square", linear(colors, 100, 0, 500, 400, 100, 500)))  # by x only, from 100 to 500
    middle, beyond = colour_at(found, (305, 305), (455, 105))
    close(middle, ramp(RED, BLUE, 0.525))
    close(beyond, ramp(RED, BLUE, part))


@pytest.mark.parametrize("extend", ["repeat", "reflect"])
def test_a_ramp_without_length_that_repeats_is_its_last_colour(extend):
    colors = line((0.5, RED, 1), (0.5, BLUE, 1), extend=extend)
    for gradient in (linear(colors, 100, 0, 500, 0, 100, 500), radial(colors, 300, 300, 50, 300, 300, 200)):
        (path,) = layers_of(fill_shape("square", gradient)).paths
        assert path.paint.gradient is None
        close(path.paint.color, PALETTE[BLUE][:3])


def test_radial_gradient_between_two_circles():
    colors = line((0, GREEN, 1), (1, BLUE, 1))
    found = layers_of(fill_shape("square", radial(colors, 405, 305, 100, 405, 305, 300)))
    centre, ring = colour_at(found, (405, 305), (605, 305))
    close(centre, premultiplied(GREEN))
    close(ring, ramp(GREEN, BLUE, 0.5))


def test_radial_gradient_from_below_radius_zero_and_to_zero():
    below = line((-1, GREEN, 1), (1, BLUE, 1))  # radius 0 is a quarter of the way between the stops
    found = layers_of(fill_shape("square", radial(below, 405, 305, 100, 405, 305, 300)))
    close(colour_at(found, (705, 305))[0], premultiplied(BLUE))
    close(colour_at(found, (605, 305))[0], ramp(GREEN, BLUE, 0.75))
    inwards = layers_of(fill_shape("square", radial(line((0, GREEN, 1), (1, BLUE, 1)), 405, 305, 300, 405, 305, 0)))
    close(
        colour_at(inwards, (405, 305))[0], ramp(GREEN, BLUE, 1.0 - 3.8 / 300)
    )  # the mean distance in its pixel is 3.8
    close(colour_at(inwards, (555, 305))[0], ramp(GREEN, BLUE, 0.5))


@pytest.mark.parametrize("points", [(100, 0, 500, 0, 700, 0), (100, 0, 500, 0, 100, 0)])
def test_a_gradient_without_direction_shows_nothing(points):
    assert layers_of(fill_shape("square", linear(line((0, RED, 1), (1, BLUE, 1)), *points))).paths == ()


def test_sweep_gradient_is_named():
    found = layers_of(fill_shape("disc", sweep(line((0, RED, 1), (1, BLUE, 1)), 550, 450, 0, 180)))
    assert [str(note) for note in found.notes] == ["sweep gradient shown as its mean colour"]
    assert found.paths[0].paint.gradient is None


def test_a_transform_moves_outline_and_gradient():
    inner = fill_shape("left", linear(line((0, RED, 1), (1, BLUE, 1)), 100, 0, 500, 0, 100, 500))
    found = layers_of(transform_paint(inner, 0.5, 0, 0, 0.5, 300, 200))
    assert found.paths[0].box.tolist() == [[350.0, 200.0], [550.0, 550.0]]
    close(colour_at(found, (455, 305))[0], ramp(RED, BLUE, 0.525))


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
