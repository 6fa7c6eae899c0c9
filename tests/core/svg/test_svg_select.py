"""A part of a drawing, by a CSS selector: what is chosen is painted as it was, everything else is not."""

from pathlib import Path

import numpy as np
import pytest

from vexture.base.errors import LimitError, ParameterError, SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg, svg_drawing

ROOT = 'xmlns="http://www.w3.org/2000/svg" xmlns:map="urn:map" viewBox="0 0 100 100"'
MAP = """<svg {}><style>.road {{ stroke: red; fill: none }} g > .road {{ stroke-width: 4 }}</style>
<defs><path id="leaf" d="M0 0h4v4h-4z"/><symbol id="pin" viewBox="0 0 2 2"><circle class="dot" cx="1" cy="1" r="1"/>
<rect width="1" height="2"/></symbol></defs>
<g id="land" fill="green" transform="translate(10 10)"><path id="island" d="M0 0h50v50z"/><use href="#leaf" x="60"/></g>
<g id="roads" map:label="Roads" opacity="0.5"><path class="road" d="M10 80H90"/></g>
<svg x="50" y="50" width="20" height="20" viewBox="0 0 2 2"><rect id="clipped" x="1" width="9" height="9"/></svg>
<use id="here" href="#pin" width="10" height="10"/><g display="none"><path id="hidden" d="M0 0h9v9z"/></g>
<foreignObject id="words">words</foreignObject></svg>"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "map.svg"
    path.write_text(MAP.format(ROOT))
    return path


@pytest.fixture
def whole(file: Path) -> Drawing:
    with pytest.warns(SourceWarning, match="left out: <foreignObject>$"):
        return read_svg(file)


@pytest.mark.parametrize(
    ("select", "painted"),
    [
        ("svg", [0, 1, 2, 3, 4, 5]),
        ("#land", [0, 1]),
        ("#island", [0]),
        ("#land > use", [1]),
        ("#leaf", [1]),
        ("#roads, #island", [0, 2]),
        (".road", [2]),
        ("[map|label=Roads]", [2]),
        ("g:not([opacity]) path", [0]),
        ("svg svg", [3]),
        ("#clipped", [3]),
        ("#here", [4, 5]),
        ("#pin", [4, 5]),
        (".dot", [4]),
        ("  .dot ,\n#pin > rect", [4, 5]),
    ],
)
def test_parts_are_painted_as_in_the_whole(file: Path, whole: Drawing, select: str, painted: list[int]) -> None:
    warned = ("svg",)
    if select in warned:
        with pytest.warns(SourceWarning, match="foreignObject"):
            part = read_svg(file, select)
    else:
        part = read_svg(file, select)
    assert len(part.paths) == len(painted)
    for path, k in zip(part.paths, painted, strict=True):
        assert (path.paint, path.fill_rule) == (whole.paths[k].paint, whole.paths[k].fill_rule)
        for contour, same in zip(path.contours, whole.paths[k].contours, strict=True):
            np.testing.assert_array_equal(contour, same)
    np.testing.assert_array_equal(part.to_source, whole.to_source)
    assert part.name == "map"


@pytest.mark.parametrize("select", ["#island", "#leaf"])
def test_parts_align_where_the_file_has_no_size(tmp_path: Path, select: str) -> None:
    file = tmp_path / "unsized.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><path id="island" d="M10 10h50v50z"/><g><path id="leaf" '
        'd="M70 80h9v9z"/></g></svg>'
    )
    with pytest.warns(SourceWarning, match="300 x 150"):
        whole, part = read_svg(file), read_svg(file, select)
    np.testing.assert_array_equal(part.to_source, whole.to_source)
    k = ["#island", "#leaf"].index(select)
    np.testing.assert_array_equal(part.paths[0].contours[0], whole.paths[k].contours[0])


REFUSED = {
    "": "is no CSS selector",
    "#": "is no CSS selector",
    "g >": "is no CSS selector",
    "g,,path": "is no CSS selector",
    "[": "is no CSS selector",
    "}": "is no CSS selector",
    ":nth-child(2n+)": "it breaks off",
    "nothere|g": "is no CSS selector",
    ".\x0eot(": "is no CSS selector",
    "path\0": "matches no element",
    "\ud800": "matches no element",
    ":is(" * 5000 + "g" + ")" * 5000: "nests brackets too deeply",
    "x" * 100_000: "matches no element",
    "#missing": "matches no element",
    "path:hover": "matches no element",
    "path::before": "matches no element",
    "#hidden": "matches 1 element that paints nothing",
    "defs, #hidden": "matches 2 elements that paint nothing",
    "style": "matches 1 element that paints nothing",
}


@pytest.mark.parametrize("select", REFUSED, ids=lambda select: repr(select[:12]))
def test_what_chooses_nothing_gets_one_line(file: Path, select: str) -> None:
    with pytest.raises((LimitError, ParameterError)) as caught:
        read_svg(file, select)
    message = str(caught.value)
    assert (caught.type is ParameterError) == ("is no CSS selector" in message)
    assert message.startswith(f"{file}: `select` ")
    assert REFUSED[select] in message
    assert message.isprintable()
    assert len(message) < 300 + len(str(file))


def test_what_is_not_chosen_is_not_complained_about(file: Path, recwarn: pytest.WarningsRecorder) -> None:
    assert read_svg(file, "#island").segments == 3
    assert not recwarn.list
    with pytest.warns(SourceWarning, match="left out: <foreignObject>$"):
        read_svg(file, "foreignObject, #island")


SPRITE = f"""<svg {ROOT}><style>.half {{ fill: blue }}</style><defs><symbol id="a" viewBox="0 0 24 12">
<path class="half" d="M0 0h12v12h-12z"/></symbol><symbol viewBox="0 0 2 2"><circle cx="1" cy="1" r="1"/></symbol></defs>
</svg>"""


def test_a_symbol_that_is_chosen_is_the_drawing() -> None:
    drawing = svg_drawing(SPRITE.encode(), "sprite.svg", "#a")
    assert drawing.sides == (1.0, 0.5)
    np.testing.assert_allclose(drawing.to_source, [[24, 0, 0], [0, -24, 18]])
    (path,) = drawing.paths
    assert path.paint.hex == "#0000ff"
    np.testing.assert_allclose(path.box, [[0, 0.25], [0.5, 0.75]])
    assert len(svg_drawing(SPRITE.encode(), "sprite.svg", "symbol").paths) == 2


def test_a_sprite_names_its_symbols() -> None:
    notes = [note.message for note in svg_drawing(SPRITE.encode(), "sprite.svg").notes]
    choice = "choose one by `select`, or make an atlas of all, as `vexture convert --atlas` does"
    assert notes == [f"1 symbol: '#a' ({choice})"]


def test_box_of_a_group_is_that_of_all_that_it_shows() -> None:
    """A clip in parts of the bounding box stays where it is in the whole drawing."""
    clip = '<clipPath id="c" clipPathUnits="objectBoundingBox"><path d="M0 0h1v.5h-1z"/></clipPath>'
    shapes = '<path id="a" d="M0 0h40v20h-40z"/><path id="b" d="M0 60h40v20h-40z"/>'
    content = f'<svg {ROOT}>{clip}<g clip-path="url(#c)">{shapes}</g></svg>'.encode()
    whole, part = svg_drawing(content, "a.svg"), svg_drawing(content, "a.svg", "#a")
    for drawing in (whole, part):
        (mask,) = (path for path in drawing.paths if path.group >= 0 and drawing.groups[path.group].mask)
        assert mask.box.tolist() == [[0.0, 0.6], [0.4, 1.0]]
