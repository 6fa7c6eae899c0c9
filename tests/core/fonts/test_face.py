"""Faces: metrics as the font says them, outlines as fontTools draws them, and damaged files in one line."""

import io
import struct
import sys
import zlib

import numpy as np
import pytest
from fontTools.pens.areaPen import AreaPen
from fontTools.ttLib import TTCollection, TTFont
from made import compress_font, disc, made_font

from vexture.base.errors import DeviceError, SourceError
from vexture.bezier.area import integral_x_dy
from vexture.fonts.face import faces_in, faces_of
from vexture.fonts.files import LARGEST_FONT

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


def test_woff_is_the_font_in_it():
    (plain,), (woff,) = faces_in(PLAIN), faces_in(compress_font(PLAIN, "woff"))
    assert [contour.tolist() for contour in woff.outline(5)] == [contour.tolist() for contour in plain.outline(5)]


def test_woff2_is_the_font_in_it_or_names_what_it_needs():
    pytest.importorskip("brotli", reason="brotli is not installed: pip install 'vexture[text]'")
    assert faces_in(compress_font(PLAIN, "woff2"))[0].family == "Made"


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


def test_woff2_without_brotli_names_the_remedy(monkeypatch):
    monkeypatch.setitem(sys.modules, "brotli", None)
    with pytest.raises(DeviceError, match=r"pip install 'vexture\[text\]'"):
        faces_in(b"wOF2" + bytes(60))


def test_all_faces_of_a_collection_are_read(tmp_path):
    collection = TTCollection()
    collection.fonts = [TTFont(io.BytesIO(made_font({"A": "square"}, family=name))) for name in ("One", "Two")]
    collection.save(tmp_path / "both.ttc")
    assert [face.family for face in faces_of(tmp_path / "both.ttc")] == ["One", "Two"]


def test_a_woff_that_unpacks_to_too_much_is_refused_before_it_does():
    packed = zlib.compress(bytes(LARGEST_FONT + 1), 9)
    entry = struct.pack(">4s4I", b"glyf", 64, len(packed), 4 * LARGEST_FONT, 0)
    with pytest.raises(SourceError, match="larger than 67,108,864 bytes"):
        faces_in(struct.pack(">4s4sIHH7I", b"wOFF", b"\0\1\0\0", 0, 1, *bytes(8)) + entry + packed)


@pytest.mark.parametrize("content", [b"", b"<svg/>", PLAIN[:12], b"wOFF" + PLAIN, b"ttcf" + bytes(20)])
def test_what_is_no_font_is_refused_in_one_line(content):
    with pytest.raises(SourceError, match="font"):
        faces_in(content)
