"""The reader of SVG in a page makes the drawings that Python's makes, and what is hostile does no harm."""

import re
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from svg_drawings import MOST_OFF, served_reader, share_off, to_drawing

from corpora import icons_logos_and_flags
from vexture.base.errors import VextureError
from vexture.base.notes import Note
from vexture.svg.read import svg_drawing

FIXTURES = Path(__file__).parents[1] / "core" / "svg" / "fixtures"

KNOWN = {
    "transform/css-axes-together.svg": "two turns about axes in space",
    "transform/css-origin-in-depth.svg": "depth of `transform-origin`",
    "strokes/join-miter-clip.svg": "`stroke-linejoin: miter-clip`, which Chromium does not know",
    "style/media-of-people.svg": "the browser's own answers to media queries",
    "unsupported/flowed-text.svg": "text",
}
"""Fixtures that the page reads in another way, with the reason."""

LOGO_IN_PAGE = """
<style>.logo { color: #f00; --wing: #00f; width: 50px } .logo .c { fill: #0f0; opacity: 0.5 }</style>
<svg hidden>
  <symbol id="leaf" viewBox="0 0 10 10"><rect width="10" height="5" fill="var(--wing)"/></symbol>
</svg>
<svg class="logo" viewBox="0 0 40 10">
  <rect width="10" height="10" fill="currentColor"/>
  <rect x="10" width="10" height="10" fill="var(--wing)"/>
  <rect class="c" x="20" width="10" height="10"/>
  <use href="#leaf" x="30" width="10" height="10"/>
</svg>"""

Read = Callable[[str], dict[str, Any]]


@pytest.fixture(scope="module")
def reader(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Any, list[str]]]:
    """A page with the reader, and the list of the paths that it asks the server for."""
    with served_reader(tmp_path_factory.mktemp("reader")) as (url, asked):
        page = chromium.new_page()
        page.goto(url)
        page.wait_for_function("window.readText")
        yield page, asked
        page.close()


@pytest.fixture
def read(reader: tuple[Any, list[str]]) -> Read:
    """Read a text in the page."""
    return lambda text: reader[0].evaluate("text => readText(text, 'drawing')", text)


def svg(body: str, root: str = 'viewBox="0 0 100 100"') -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" {root}>{body}</svg>'


def wrong(files: list[Path], read: Read) -> list[str]:
    """Files of which the page's drawing differs from Python's."""
    found = []
    for file in files:
        content = file.read_bytes()
        value = read(content.decode("utf-8", "replace"))
        try:
            ours = svg_drawing(content, str(file))
        except VextureError:
            found += [] if "error" in value else [str(file)]
            continue
        if "error" in value or share_off(ours, to_drawing(value)) >= MOST_OFF:
            found.append(str(file))
    return found


def names(files: list[str]) -> set[str]:
    return {Path(file).relative_to(FIXTURES).as_posix() for file in files}


FOLDERS = {
    *("bad", "errors", "filters", "gradients", "groups", "images", "markers", "masks", "paths", "patterns", "shapes"),
    *("strokes", "structure", "style", "transform", "unsupported", "viewport"),
}
"""Folders of fixtures that the page reads. It names animations, texts and gradients of backgrounds."""

FIXTURES_READ = sorted(file for folder in FOLDERS for file in (FIXTURES / folder).glob("*.svg"))


def test_some_fixtures_are_drawn_as_by_python(read: Read) -> None:
    files = [file for file in FIXTURES_READ[::8] if file.parent.name != "bad"]
    assert len(files) > 50
    assert names(wrong(files, read)) <= KNOWN.keys()


@pytest.mark.slow
def test_all_fixtures_are_drawn_as_by_python(read: Read) -> None:
    assert names(wrong(FIXTURES_READ, read)) == {*KNOWN}


@pytest.mark.slow
def test_icons_logos_and_flags_are_drawn_as_by_python(read: Read) -> None:
    try:
        files = icons_logos_and_flags(2)
    except VextureError as error:
        pytest.skip(str(error))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = wrong(files, read)
    assert len(found) <= 0.01 * len(files), found


@pytest.mark.parametrize(
    "body",
    [
        '<foreignObject width="9" height="9"/>',
        '<unknown/><rect width="9" height="9"/>',
        '<script>alert(1)</script><rect width="9" height="9" onclick="alert(1)"/>',
        '<use href="#none"/><rect width="9" height="9" fill="url(#none) red"/>',
        '<rect width="9" height="9" clip-path="url(#none)"/>',
        '<rect width="9" height="9"><animate attributeName="x" to="9"/></rect>',
        '<image href="https://example.org/a.png" width="9" height="9"/><rect width="9" height="9"/>',
    ],
)
def test_notes_have_the_words_of_python(read: Read, body: str) -> None:
    text = svg(body)
    value = read(text)
    assert value["notes"], value
    ours = [Note(note.kind, note.message, note.count) for note in svg_drawing(text.encode(), "a.svg").notes]
    assert [Note(**note) for note in value["notes"]] == ours


def test_a_stroke_of_too_many_dashes_is_solid_in_the_words_of_python(read: Read) -> None:
    text = svg(
        '<path id="fine" d="M0 9H100" stroke="red" stroke-width="2" stroke-dasharray="1e-9"/>'
        '<path d="M0 50h100" stroke="blue" stroke-width="4" stroke-dasharray="10"/>'
    )
    value, ours = read(text), svg_drawing(text.encode(), "a.svg")
    (note,) = ours.notes
    assert "50,000,000,000 dashes" in note.message
    (other,) = value["notes"]
    count = re.compile("[0-9,]+ dashes")  # the page's numbers are rounded otherwise
    words = note.message.replace(" in line 1", "")  # and it has no numbers of lines
    assert count.sub("dashes", other["message"]) == count.sub("dashes", words)
    assert count.search(other["message"])
    assert share_off(ours, to_drawing(value)) < MOST_OFF


def test_nothing_is_fetched_and_no_script_runs(reader: tuple[Any, list[str]], read: Read) -> None:
    page, asked = reader
    asked.clear()
    url = page.url + "fetched/"
    value = read(
        f'<?xml-stylesheet href="{url}1"?>'
        + svg(
            f'<style>@import "{url}2"; @import url({url}3); @font-face {{ font-family: a; src: url({url}4) }}'
            f" .a {{ fill: url({url}5#a); background: url({url}6); cursor: url({url}7), auto }}</style>"
            f'<image href="{url}8" width="9" height="9"/><image xlink:href="{url}9" width="9" height="9"/>'
            f'<use href="{url}10#a"/><rect class="a" width="9" height="9" mask="url({url}11#a)"/>'
            f'<rect width="9" height="9" filter="url({url}12#a)"/>'
            f'<rect width="9" height="9" style="clip-path: url({url}13#a); mask-image: url({url}14)"/>'
            f'<foreignObject width="9" height="9"><h:img src="{url}15" onerror="top.ran = 1"/>'
            f'<h:iframe src="{url}16"/></foreignObject><h:link rel="stylesheet" href="{url}17"/>'
            f'<script href="{url}18"/><script>window.top.ran = 1; fetch("{url}19")</script>'
            f'<filter id="f"><feImage href="{url}20"/></filter><rect width="9" height="9" filter="url(#f)"/>'
            f'<text font-family="a">text</text><a href="{url}21"><rect width="5" height="5" onload="top.ran = 1"/></a>'
            f'<svg onload="top.ran = 1"/><animate onbegin="top.ran = 1" attributeName="x" to="1"/>',
            'viewBox="0 0 100 100" onload="top.ran = 1" xmlns:h="http://www.w3.org/1999/xhtml"',
        )
    )
    assert "error" not in value
    assert len(value["paths"]) > 1
    page.wait_for_timeout(300)
    assert asked == []
    assert page.evaluate("[window.ran, document.querySelectorAll('iframe').length]") == [None, 0]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "not well-formed XML: it is empty"),
        ("PNG", "not well-formed XML: it does not begin with <"),
        ("<svg", "not well-formed XML: line 1"),
        (
            "<html xmlns='http://www.w3.org/1999/xhtml'/>",
            "the root element is <html>, not <svg>; this is not an SVG file",
        ),
        ('<svg xmlns="urn:other"/>', "the root element has the namespace 'urn:other'; the one of SVG is"),
        (svg("<g>" * 257 + "</g>" * 257), "its elements are nested more than 256 deep; flatten its groups"),
        (svg('<g id="a">' + '<use href="#b"/>' * 300 + '</g><g id="b">' + "<g/>" * 300 + "</g>"), "a use bomb"),
    ],
)
def test_what_cannot_be_read_is_one_error(read: Read, text: str, message: str) -> None:
    value = read(text)
    assert value["error"].startswith("VextureError: ")
    assert message in value["error"]
    assert "\n" not in value["error"]


def test_huge_files_are_refused_at_once(reader: tuple[Any, list[str]]) -> None:
    page = reader[0]
    for text, limit in (("'<g/>'.repeat(1e6)", "200,000"), ("'<desc>' + 'x'.repeat(5e7) + '</desc>'", "33,554,432")):
        start = f"'<svg xmlns=\"http://www.w3.org/2000/svg\">' + {text} + '</svg>'"
        value = page.evaluate(f"readText({start})")
        assert limit in value["error"]
        assert value["ms"] < 2000


def test_an_element_of_the_page_keeps_what_the_page_gives_it(reader: tuple[Any, list[str]]) -> None:
    page = reader[0]
    page.evaluate("text => { document.body.innerHTML = text; }", LOGO_IN_PAGE)
    value = page.evaluate("async () => readSource(document.querySelector('.logo'))")
    assert [(path["paint"]["color"], path["paint"]["opacity"]) for path in value["paths"]] == [
        ([1, 0, 0], 1),
        ([0, 0, 1], 1),
        ([0, 1, 0], 0.5),
        ([0, 0, 1], 1),
    ]
    assert value["notes"] == []
    assert page.evaluate("document.querySelectorAll('.logo > *').length") == 4
    assert page.evaluate("document.querySelectorAll('iframe').length") == 0
    page.evaluate("document.body.replaceChildren()")


@pytest.mark.parametrize(
    "source",
    [
        "new Blob([text])",
        "new TextEncoder().encode(text)",
        "new Response(new Blob([text]).stream().pipeThrough(new CompressionStream('gzip')))",
        "new URL('data:image/svg+xml,' + encodeURIComponent(text))",
        "new Uint8Array([0xff, 0xfe, ...new Uint8Array(Uint16Array.from(text, (c) => c.charCodeAt(0)).buffer)])",
    ],
)
def test_a_source_is_text_bytes_a_file_or_an_address(reader: tuple[Any, list[str]], source: str) -> None:
    text = svg('<rect id="é" width="50" height="50"/>')
    value = reader[0].evaluate(f"async (text) => readSource({source})", text)
    assert [path["element"] for path in value["paths"]] == ["é"]


def test_a_source_that_is_none_is_refused(reader: tuple[Any, list[str]]) -> None:
    for source, message in (
        ("5", "the source is 5; give the text of an SVG"),
        ("new URL('http://127.0.0.1:9/')", "cannot be loaded"),
        ("document.body", "the element is <.*body.*>; give an <svg> of the page"),
    ):
        with pytest.raises(Exception, match=message):
            reader[0].evaluate(f"async () => readSource({source})")


def test_styles_count_in_a_page_whose_policy_forbids_them(chromium: Any, reader: tuple[Any, list[str]]) -> None:
    page = chromium.new_page()
    page.goto(reader[0].url + "strict")
    page.wait_for_function("window.readText")
    style = "<style media='all'>.a { fill: #f00 }</style><style>.b { fill: #0f0 }</style>"
    shapes = '<rect class="{}" width="9" height="9" style="fill-opacity: 0.5"/>'
    value = page.evaluate("text => readText(text)", svg(style + shapes.format("a") + shapes.format("b")))
    page.close()
    found = [(path["paint"]["color"], path["paint"]["opacity"]) for path in value["paths"]]
    assert found == [([1, 0, 0], 0.5), ([0, 1, 0], 0.5)]
