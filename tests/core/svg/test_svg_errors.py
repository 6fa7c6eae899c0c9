"""What is wrong in an SVG loses its element with a note, and not the drawing."""

import warnings
from pathlib import Path

import pytest

import vexture
from vexture.base.errors import SourceError, SourceWarning

FIXTURES = Path(__file__).parent / "fixtures" / "errors"
GREEN, RED, BLACK = "#008000", "#ff0000", "#000000"
LARGE = "the number 1e300 is too large; the limit is 1e+12"
FAR = "it has a coordinate of {}; the limit is 1e+12; correct it"
UNSIZED = (
    "it has no viewBox and no size, and is 300 x 150, as in browsers, of which it fills a small part "
    '(with viewBox="0 0 5 5" it fills all of it)'
)
FLAT = ["its width or height is zero, at which nothing is shown", "nothing in it is painted"]

SHOWN = {
    "arc-1e300": ([GREEN], ["<path> in line 2: " + FAR.format("1e+200")]),
    "coordinate-1e300": ([GREEN], ['<path id="far"> in line 2: ' + FAR.format("1e+300")]),
    "coordinate-infinite": ([GREEN], ["<path> in line 2: " + FAR.format("nan")]),
    "gradient-1e300": ([GREEN], ["<rect> in line 3: " + LARGE]),
    "geometry-inherit": (
        [GREEN, GREEN, GREEN],
        [
            "cx='inherit' of <radialGradient id=\"a\"> in line 2",
            "width='inherit' of <pattern id=\"b\"> in line 3",
            "x='inherit' of <mask id=\"c\"> in line 4",
        ],
    ),
    "hsl-out-of-range": ([GREEN, "#404040", "#ffffff", GREEN], []),
    "length-1e300": ([GREEN], ["<rect> in line 2: " + LARGE]),
    "marker-1e300": (["#0000ff", GREEN], ["<path> in line 3: " + LARGE]),
    "mask-1e300": ([RED, "#ffffff", GREEN], ["the 1st <circle> in line 2: " + LARGE]),
    "namespace-of-element": ([GREEN], ["<rect> in line 2, of another namespace"]),
    "paint-missing": ([GREEN], ["paint '#none', which is not in the drawing (2)"]),
    "prefix-of-element": ([GREEN], ["<a:rect>"]),
    "prefix-of-link": ([GREEN, GREEN], []),
    "switch-only-unknown": ([GREEN], ["<foreignObject>"]),
    "switch-unknown": ([GREEN], []),
    "transform-1e300": ([GREEN], ["<rect> in line 2: the transforms multiply to 1e+22; the limit is 1e+12"]),
    "transform-of-outermost-1e300": ([GREEN], ["transform of the outermost <svg>: " + LARGE]),
    "use-ancestor": ([GREEN], ["<use> in line 2 that shows itself"]),
    "use-cycle": ([RED, RED, GREEN], ["<use> in line 3 that shows itself", "<use> in line 2 that shows itself"]),
    "use-itself": ([GREEN], ['<use id="a"> in line 2 that shows itself']),
    "view-box-nan": ([BLACK], ["viewBox='0 0 nan 10' of <svg> in line 1", UNSIZED]),
    "view-box-negative": ([GREEN], ["viewBox='0 0 -10 10' of <svg> in line 1"]),
    "view-box-nested-three": ([RED, GREEN], ["viewBox='0 0 10' of <svg> in line 2"]),
    "view-box-nested-zero": ([GREEN], []),
    "view-box-of-pattern": ([GREEN], []),
    "view-box-of-symbol-1e300": ([GREEN], ['<symbol id="s"> in line 2: ' + LARGE]),
    "view-box-three": ([BLACK], ["viewBox='0 0 10' of <svg> in line 1", UNSIZED]),
    "view-box-zero": ([], FLAT),
    "width-nan": ([GREEN], ["width='nan' of <svg> in line 1"]),
    "width-zero": ([], FLAT),
}


@pytest.mark.parametrize("path", sorted(FIXTURES.glob("*.svg")), ids=lambda path: path.stem)
def test_an_element_that_is_wrong_is_lost_and_named(path: Path) -> None:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        drawing = vexture.read(path)
    hexes, notes = SHOWN[path.stem]
    assert [shown.paint.hex for shown in drawing.paths] == hexes
    assert [str(note) for note in drawing.notes] == notes


def test_a_drawing_of_no_size_becomes_a_texture() -> None:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        texture = vexture.convert(FIXTURES / "width-zero.svg")
    assert not texture.contains([[0.5, 0.5]]).any()


def test_a_root_of_another_namespace_is_named() -> None:
    with pytest.raises(SourceError, match=r"the root element has the namespace 'urn:x'; the one of SVG is 'http"):
        vexture.read(b'<svg xmlns="urn:x"/>', name="a.svg")


def test_missing_prefixes_excuse_no_other_error() -> None:
    with pytest.raises(SourceError, match="not well-formed XML: Opening and ending tag mismatch: use"):
        vexture.read(b'<svg><a:b/><use xlink:href="#a"></svg>', name="a.svg")
    bomb = "".join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 10))
    with pytest.raises(SourceError, match="entities expand"):
        vexture.read(
            f'<!DOCTYPE svg [<!ENTITY e0 "xxxxxxxxxx">{bomb}]><svg><a:b c="&e9;"/></svg>'.encode(), name="a.svg"
        )


@pytest.mark.parametrize("encoding", ["UTF-16", "utf-16le", "UCS-2", "ISO-10646-UCS-4"])
def test_an_encoding_of_two_bytes_in_a_text_of_one_is_ignored(encoding: str) -> None:
    """Browsers draw it: some programs write the encoding of their memory."""
    text = f"<?xml version='1.0' encoding='{encoding}'?>"
    text += "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'><rect id='ö' width='9' height='9'/></svg>"
    for content in (text.encode(), b"\xef\xbb\xbf" + text.encode(), text.replace(encoding, "UTF-16").encode("utf-16")):
        assert len(vexture.read(content, select="#ö").paths) == 1
