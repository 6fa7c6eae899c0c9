"""What a file is by its first bytes, and its bytes after decompression."""

import gzip
import io

import pytest
from PIL import Image

from vexture.base import content
from vexture.base.content import FileKind, about, decompress, header_of, kind_of, known_kind, markup_of, picture_size
from vexture.base.errors import LimitError, SourceError

KINDS = [
    (b"\xabKTX 20\xbb\r\n\x1a\n", "a.svg", FileKind.TEXTURE),
    (b"\x89PNG\r\n\x1a\n", "a.svg", FileKind.PICTURE),
    (b"BM\x3a\0\0\0\0\0\0\0\x36", "", FileKind.PICTURE),
    (b"BMW is a car", "car.svg", FileKind.SVG),
    (b"RIFF\0\0\0\0WAVEfmt ", "", FileKind.SVG),
    (b"\xef\xbb\xbf\n {}", "a.svg", FileKind.GEOJSON),
    (b"name;lat;lon\na;52;4", "", FileKind.AREAS),
    (b"name;latitude;height\na;52;4", "", FileKind.SVG),
    (b"\x89HDF\r\n\x1a\n", "", FileKind.DEPTHS),
    (b"NCOLS 4\nNROWS 3", "", FileKind.DEPTHS),
    (b"hello", "a.NC", FileKind.DEPTHS),
    (b"<svg/>", "a.nc", FileKind.SVG),
]


@pytest.mark.parametrize(("start", "name", "kind"), KINDS)
def test_content_decides_and_else_the_suffix(start, name, kind):
    assert kind_of(start, name) is kind


@pytest.mark.parametrize(("start", "name"), [(b"", "a.svg"), (b"hello", "a.svg"), (b"hello", "a.ktx2")])
def test_what_is_of_no_kind_is_refused(start, name):
    with pytest.raises(SourceError, match="is empty; give an SVG" if not start else "holds nothing that can be read"):
        known_kind(start, name)


def test_markup_is_known_in_every_encoding_and_after_a_prolog():
    text = '<?xml version="1.0"?>\n<!-- <svg> --><!DOCTYPE kml [<!ENTITY a "b">]>\n<k:kml/>'
    for encoding in ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"):
        assert markup_of(text.encode(encoding)) == "kml", encoding
    assert markup_of(b'<a:Collection xmlns:gml="http://www.opengis.net/gml/3.2">') == "gml"
    assert markup_of(b'<svg xmlns:gml="http://www.opengis.net/gml/3.2">') == ""


def test_columns_of_places_in_csv():
    quoted = header_of(b'"name, old",x,y\n1,2,3')
    assert (quoted.names, quoted.delimiter, quoted.across, quoted.up) == (("name, old", "x", "y"), ",", "x", "y")
    assert (quoted.has_places, quoted.is_degrees) == (True, False)
    assert header_of(b"lat\tLon\twidth")[1:] == ("\t", None, "Lon", "lat")
    assert header_of(b"a;WKT").text == "WKT"
    assert not header_of(b"lat;width").has_places


def test_gzip_is_decompressed_or_refused_in_a_line(monkeypatch):
    packed = gzip.compress(b"<svg/>" * 100)
    assert decompress(packed) == b"<svg/>" * 100
    assert decompress(b"<svg/>") == b"<svg/>"
    with pytest.raises(SourceError, match="breaks off"):
        decompress(packed[:-9])
    with pytest.raises(SourceError, match="is damaged"):
        decompress(packed[:12] + bytes(20))
    monkeypatch.setattr(content, "LARGEST_FILE", 599)
    with pytest.raises(SourceError, match="larger than 599 bytes"):
        decompress(packed)


def test_a_file_that_cannot_be_read_says_why(tmp_path):
    with pytest.raises(SourceError, match="is a folder"):
        content.read_bytes(tmp_path)
    with pytest.raises(SourceError, match="cannot be read: No such file"):
        content.read_bytes(tmp_path / "none")
    assert content.start_of(tmp_path / "none") == b""


def test_size_that_a_picture_declares():
    data = io.BytesIO()
    Image.new("RGB", (3, 2)).save(data, "PNG")
    assert picture_size(data.getvalue()) == ("PNG", 3, 2)
    assert picture_size(data.getvalue()[:20]) is None
    assert picture_size(b"<svg/>") is None


def test_errors_keep_their_class_and_get_the_name_of_the_source():
    with pytest.raises(LimitError, match=r"^a\.svg: too large$"), about("a.svg"):
        raise LimitError("too large")
    with pytest.raises(KeyError), about("a.svg"):
        raise KeyError("a bug")
