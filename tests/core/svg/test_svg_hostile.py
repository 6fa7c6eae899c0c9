"""Bad input: one line, no traceback, and nothing outside the file is touched."""

import gzip
import re
from pathlib import Path

import pytest
from lxml import etree

from vexture.base.deadline import within
from vexture.base.errors import LimitError, SourceError, SourceWarning, printable
from vexture.svg.read import read_svg, svg_drawing
from vexture.svg.select import Node

FIXTURES = Path(__file__).parent / "fixtures"
HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'

SAID = {
    "empty": "not well-formed XML",
    "entity-bomb": "entities expand to too much text",
    "external-dtd": "Entity .* external ones never",
    "external-entity": "Entity .* external ones never",
    "far-from-view-box": "the limit is 1e.09; correct the coordinate",
    "html": "the root element is <html>, not <svg>",
    "not-xml": "not well-formed XML",
    "truncated": "not well-formed XML: Premature end of data in tag g line 2",
    "use-bomb": "<use> shows more than 50,000 elements",
}

MASKED = '<rect width="9" height="9" mask="url(#m{})"/>'
MASK = '<mask id="m{0}">' + 2 * MASKED.replace("{}", "{1}") + "</mask>"
CLIP = '<clipPath id="c{0}" clip-path="url(#c{1})"><circle r="9"/></clipPath>'

GENERATED = {
    "nested.svg": (HEAD + "<g>" * 50_000 + "</g>" * 50_000 + "</svg>", "nested more than 256 deep"),
    "unclosed.svg": (HEAD + "<g>" * 50_000, "nested more than 256 deep"),
    "long.svg": (HEAD + f'<path d="M0 0{"L12.345 45.678" * 1_000_000}"/></svg>', "longer than 10,000,000 characters"),
    "chain.svg": (
        HEAD + "".join(f'<use id="u{k}" href="#u{k + 1}"/>' for k in range(2000)) + '<g id="u2000"/></svg>',
        "stands inside 1,000 others",
    ),
    "masks.svg": (
        HEAD + "".join(MASK.format(k, k + 1) for k in range(25)) + MASKED.format(0) + "</svg>",
        "<use>, clips, markers, masks and patterns show more than 50,000 elements",
    ),
    "clips.svg": (
        HEAD
        + "".join(CLIP.format(k, k + 1) for k in range(2000))
        + '<rect width="9" height="9" clip-path="url(#c0)"/></svg>',
        "clips, markers, masks and patterns are nested more than 32 deep",
    ),
    "brackets.svg": (HEAD + f"<rect style='fill:{'[' * 50_000}'/></svg>", "nests brackets too deeply"),
    "cut.svgz": (gzip.compress(HEAD.encode() + b"</svg>")[:-9], "gzip data breaks off"),
    "damaged.svgz": (b"\x1f\x8b" + b"\x07" * 50, "gzip data is damaged"),
    "bomb.svgz": (gzip.compress(b" " * (2**28 + 9)), "larger than 268,435,456 bytes"),
    "bytes.svg": (bytes(range(256)) * 9, "not well-formed XML"),
}


def message_of(path: Path | str) -> str:
    with pytest.raises(SourceError) as caught:
        read_svg(path)
    message = str(caught.value)
    assert message.startswith(f"{printable(str(path))}: ")
    assert "\n" not in message
    assert len(message) < len(str(path)) + 300
    return message


@pytest.mark.parametrize("path", sorted((FIXTURES / "bad").glob("*.svg")), ids=lambda path: path.stem)
def test_bad_files_are_refused_in_one_line(path: Path) -> None:
    message = message_of(path)
    assert re.search(SAID[path.stem], message), message
    assert "root:" not in message  # nothing of /etc/passwd


@pytest.mark.parametrize("name", sorted(GENERATED))
def test_bombs_are_refused_in_one_line(tmp_path: Path, name: str) -> None:
    content, said = GENERATED[name]
    file = tmp_path / name
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    assert said in message_of(file)


@pytest.mark.slow
def test_a_path_of_a_million_segments_is_read(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    steps = "h1v1" * 499_999
    file.write_text(f'<svg viewBox="0 0 500000 500000"><path d="M0 0{steps}v-499999z"/></svg>')
    assert read_svg(file).segments == 1_000_000


def test_a_selector_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    file.write_text(f"{HEAD}<style>{':not(' * 3000}g{')' * 3000} {{fill: red}} ::{{}}</style></svg>")
    with pytest.warns(SourceWarning, match="CSS selector"):
        read_svg(file)


RECTS = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><style>{}</style>{}</svg>'


@pytest.mark.slow
@pytest.mark.parametrize(
    "selector",
    [".c0 ~ .c1999", ".c1998 + .c1999", ".c1998:has(~ .c1999) ~ .c1999", "svg:has(.c1999) .c1999", ".c1999"],
)
def test_a_selector_may_ask_for_any_of_many_siblings(selector):
    body = "".join(f'<rect class="c{k}" width="1" height="1"/>' for k in range(2000))
    drawing = svg_drawing(RECTS.format(selector + "{fill:red}", body).encode(), "siblings.svg")
    assert [path.paint.hex for path in drawing.paths if path.paint.hex != "#000000"] == ["#ff0000"]


def test_selectors_make_an_element_once():
    root = Node.from_xml_root(etree.fromstring(RECTS.format("", "<g><a/><b/><c/></g>")))
    *_, a, b, c = root.iter_subtree()
    assert a.parent is root._children[1]
    assert [*a.iter_next_siblings()][1] is c
    assert next(c.previous_siblings) is b
    assert [*c.ancestors][1] is root


def test_a_selector_that_asks_without_end_meets_the_limit():
    selector = ".none" + " ~ rect" * 9 + " ~ circle"  # any nine of hundreds of siblings, in order
    body = '<rect width="1" height="1"/>' * 500 + '<circle r="1"/>'
    with pytest.raises(LimitError, match=r"^x\.svg: converting takes longer than 0\.1 s"), within(0.1):
        svg_drawing(RECTS.format(selector + "{fill:red}", body).encode(), "x.svg")
