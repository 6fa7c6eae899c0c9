"""Files of fonts: those for the web, unpacked, and others refused in one line."""

import struct
import sys
import zlib

import pytest
from made import compress_font, disc, made_font

from vexture.base.errors import DeviceError, SourceError
from vexture.fonts.face import faces_in
from vexture.fonts.files import LARGEST_FONT

PLAIN = made_font({"A": "square", "B": disc(300, 350, 300)}, weight=300, usWidthClass=3)


def test_woff_is_the_font_in_it():
    (plain,), (woff,) = faces_in(PLAIN), faces_in(compress_font(PLAIN, "woff"))
    assert [contour.tolist() for contour in woff.outline(5)] == [contour.tolist() for contour in plain.outline(5)]


def test_woff2_is_the_font_in_it_or_names_what_it_needs():
    pytest.importorskip("brotli", reason="brotli is not installed: pip install 'vexture[text]'")
    assert faces_in(compress_font(PLAIN, "woff2"))[0].family == "Made"


def test_woff2_without_brotli_names_the_remedy(monkeypatch):
    monkeypatch.setitem(sys.modules, "brotli", None)
    with pytest.raises(DeviceError, match=r"pip install 'vexture\[text\]'"):
        faces_in(b"wOF2" + bytes(60))


def test_a_woff_that_unpacks_to_too_much_is_refused_before_it_does():
    packed = zlib.compress(bytes(LARGEST_FONT + 1), 9)
    entry = struct.pack(">4s4I", b"glyf", 64, len(packed), 4 * LARGEST_FONT, 0)
    with pytest.raises(SourceError, match="larger than 67,108,864 bytes"):
        faces_in(struct.pack(">4s4sIHH7I", b"wOFF", b"\0\1\0\0", 0, 1, *bytes(8)) + entry + packed)


@pytest.mark.parametrize("content", [b"", b"<svg/>", PLAIN[:12], b"wOFF" + PLAIN, b"ttcf" + bytes(20)])
def test_what_is_no_font_is_refused_in_one_line(content):
    with pytest.raises(SourceError, match="font"):
        faces_in(content)
