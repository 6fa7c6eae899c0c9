"""Faces: metrics as the font says them, outlines as fontTools draws them, and damaged files in one line."""

import io
import struct

import numpy as np
import pytest
from fontTools.pens.areaPen import AreaPen
from fontTools.ttLib import TTCollection, TTFont
from made import compress_font, disc, made_font

from vexture.base.errors import SourceError
from vexture.bezier.area import integral_x_dy
from vexture.fonts.face import faces_in, faces_of

PLAIN = made_font({"A": "square", "B": disc(300, 350, 300)}, weight=300, usWidthClass=3)


def area(face, glyph):
    return sum(integral_x_dy(curve) for contour in face.outline(glyph) for curve in contour)


def glyph_of(face, char):
    return face._font.get_nominal_glyph(ord(char))


def test_metrics_are_those_of_the_tables():
    (face,) = faces_in(PLAIN)
    assert (face.family, face.names, face.weight, face.style, face.stretch) == ("Made", ("Made",), 300, "normal", 75.0)
    assert (face.units_per_em, face.ascender, face.descender, face.line_gap) == (1000, 800, -200, 0)
    assert (face.x_height, face.cap_height, face.underline) == (500, 700, (-100, 50))
    assert face.has(ord("A"))
    assert not face.has(ord("Z"))


def test_outlines_are_closed_and_have_the_areas_that_fonttools_computes(default_faces):
    face = default_faces["normal"].with_style(650.0, 80.0, "normal")
    font = TTFont(io.BytesIO(bytes(face.blob.data)))
    glyphs, order = font.getGlyphSet(location=dict(face.variations)), font.getReverseGlyphMap()
    for char in "AgQ8&é":
        name = font.getBestCmap()[ord(char)]
        pen = AreaPen(glyphs)
        glyphs[name].draw(pen)
        contours = face.outline(order[name])
        assert all((contour[:, 3] == np.roll(contour[:, 0], -1, axis=0)).all() for contour in contours)
        assert area(face, order[name]) == pytest.approx(pen.value, rel=1e-3)  # HarfBuzz rounds points


def test_variable_face_takes_the_nearest_style_that_it_has(default_faces):
    face = default_faces["normal"].with_style(1000.0, 10.0, "italic")
    assert (face.weight, face.stretch, face.style) == (900, 62.5, "normal")
    thin = default_faces["normal"].with_style(100.0, 100.0, "normal")
    assert area(thin, glyph_of(thin, "H")) != area(face, glyph_of(face, "H"))


def test_damaged_outlines_of_a_web_font_are_met_when_they_are_used_and_name_the_file(tmp_path):
    brotli = pytest.importorskip("brotli", reason="brotli is not installed: pip install 'vexture[text]'")
    content, file = compress_font(PLAIN), tmp_path / "damaged.woff2"
    reader = TTFont(io.BytesIO(content)).reader
    tables = bytearray(reader.transformBuffer.getvalue())
    head = bytearray(content[: content.index(brotli.compress(bytes(tables), mode=brotli.MODE_FONT))])
    start = reader.tables["glyf"].offset
    tables[start : start + 36] = b"\xff" * 36
    body = brotli.compress(bytes(tables))
    struct.pack_into(">I", head, 8, len(head) + len(body))
    struct.pack_into(">I", head, 20, len(body))
    file.write_bytes(head + body)
    (face,) = faces_of(file)
    assert (face.family, face.has(ord("A"))) == ("Made", True)
    with pytest.raises(SourceError, match=r"damaged\.woff2: the font is damaged \(.*\); save it again"):
        face.outline(1)


@pytest.mark.parametrize(("style", "weight"), [("ThinItalic", 100), ("ExtraLight", 200), ("Regular", 250)])
def test_fonts_lighter_than_their_weight_class_have_the_weight_of_their_name(style, weight):
    """Older Windows made fonts of classes below 250 bolder, so that thin ones have this one."""
    assert faces_in(made_font({"A": "square"}, weight=250, style=style))[0].weight == weight


def test_all_faces_of_a_collection_are_read(tmp_path):
    collection = TTCollection()
    collection.fonts = [TTFont(io.BytesIO(made_font({"A": "square"}, family=name))) for name in ("One", "Two")]
    collection.save(tmp_path / "both.ttc")
    assert [face.family for face in faces_of(tmp_path / "both.ttc")] == ["One", "Two"]
