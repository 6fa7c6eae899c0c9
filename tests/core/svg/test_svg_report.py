"""What is not supported is named, once for a file."""

import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

from vexture import atlas, convert, coverage, read, render
from vexture.base.errors import SourceWarning
from vexture.base.notes import MOST_SUBJECTS
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg

FIXTURES = Path(__file__).parent / "fixtures"

SAID = {
    "animation": "left out: animation",
    "animation-in-gradient": "left out: animation (2)",
    "box-of-outermost": "left out: background-image of the outermost <svg>, border of the outermost <svg>, "
    "border-radius of the outermost <svg>, box-shadow of the outermost <svg>, padding of the outermost <svg>",
    "clip-path": "left out: clip-path 'shape(from 0 0, line to 9px 9px)'",
    "clip-path-elsewhere": "left out: clip-path 'circle(9px)', clip-path 'inset(5px)', clip-path 'inset(4px)'",
    "at-rules": "left out: media=\"(depth: 3)\" of <style>, @container, @media (moon: full), CSS selector 'a !! b',"
    " which cannot be read",
    "external-use": "left out: <use> of 'other.svg#a', which is not in the drawing",
    "event-attribute": "left out: script (2)",
    "filter": "left out: filter of blur",
    "filter-functions": "left out: filter of drop shadow and blur",
    "filter-missing": "invalid and ignored: filter='url(#none)' of <rect> in line 2",
    "filter-steps": "left out: filter of flood, offset, blur, color matrix and more (2)",
    "gradient-mesh": "left out: gradient mesh",
    "hatch": "left out: hatch",
    "html": "left out: <p> in line 2, of another namespace",
    "linear-light": "simplified: gradient in linear light (color-interpolation) read as one in sRGB, "
    "mask in linear light (color-interpolation) read as one in sRGB",
    "flowed-text": "left out: shape-inside of a text",
    "functions": "left out: device-cmyk() in fill, env() in stroke-width; "
    "invalid and ignored: opacity='foo(3)' of <rect id=\"a\"> in line 2",
    "foreign-object": "left out: <foreignObject>; nothing in it is painted",
    "image": "left out: image 'x.png' (there is no such file beside the drawing); nothing in it is painted",
    "import": "left out: @import",
    "many": "left out: <foreignObject> (2), image 'x' (there is no such file beside the drawing); "
    "invalid and ignored: rx='x' of <rect> in line 5",
    "marker": "left out: marker-start 'url(#none)', marker-start that refers to itself, of <marker id=\"c\"> in line 2;"
    " invalid and ignored: markerWidth='-3' of <marker id=\"c\"> in line 2",
    "mask": "left out: mask 'url(stars.svg#m)'",
    "mask-of-outermost": "left out: @media (min-width: 1e400px); "
    "simplified: clip-path of the outermost <svg> read in the units of its content",
    "mask-of-layers": "left out: mask 'url(#m), linear-gradient(black, transpar'",
    "motion-path": "left out: offset-path",
    "missing-paint": "left out: paint '#none', which is not in the drawing (2)",
    "pattern": 'simplified: <pattern id="c"> in line 2 read as solid: here it has 12,500,000,000 segments in its tiles;'
    " all patterns of a drawing may have 400,000",
    "perspective": "left out: perspective",
    "script": "left out: script",
    "transform-without-size": "it has no viewBox and no size, and is 300 x 150, as in browsers, which cuts it; "
    "nothing in it is painted",
    "unknown-element": "left out: <flowRoot>",
    "view-and-cursor": "its cursors are left out, which no picture shows; "
    "its views are not followed; all of it is shown",
    "variable-missing": "invalid and ignored: var(--none), which has no value (`page_colors` gives it one)",
    "vector-effect": "left out: vector-effect 'fixed-position'",
    "xml-stylesheet": "left out: style sheet 'a.css'",
}


@pytest.mark.parametrize("path", sorted((FIXTURES / "unsupported").glob("*.svg")), ids=lambda path: path.stem)
def test_unsupported_features_are_named_once(path: Path) -> None:
    with pytest.warns(SourceWarning) as caught:
        read_svg(path)
    assert [str(warning.message) for warning in caught] == [f"{path}: {SAID[path.stem]}"]
    assert caught[0].filename == __file__


def read_quietly(file: Path) -> Drawing:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return read(file)


ABOUT = {
    "at-rules": [
        ("left out", 'media="(depth: 3)" of <style>', [("s", None)]),
        ("left out", "@container", [("t", None)]),
        ("left out", "@media (moon: full)", [("t", None)]),
        ("left out", "CSS selector 'a !! b', which cannot be read", [("t", None)]),
    ],
    "perspective": [("left out", "perspective", [("b", (0, 0.91 + 0.09 * (1 - 0.5**0.5), 0.09, 1))])],
    "variable-missing": [
        ("invalid", SAID["variable-missing"][21:], [("a", (0, 0.91, 0.09, 1))]),
    ],
    "animation-in-gradient": [("left out", "animation", [("<stop> in line 2", None), ("sun", (0, 0.91, 0.09, 1))])],
    "filter-steps": [
        ("left out", SAID["filter-steps"][10:-4], [("card", (0, 0.91, 0.09, 1)), ("badge", (0.2, 0.91, 0.29, 1))])
    ],
    "image": [
        ("left out", "image 'x.png' (there is no such file beside the drawing)", [("<image> in line 2", None)]),
        ("remark", "nothing in it is painted", []),
    ],
}


@pytest.mark.parametrize("name", ABOUT)
def test_notes_name_their_elements_and_where_those_are(name: str) -> None:
    notes = read_quietly(FIXTURES / "unsupported" / f"{name}.svg").notes
    said = [(note.kind, note.message, [subject.name for subject in note.elements]) for note in notes]
    assert said == [(kind, message, [element for element, _ in about]) for kind, message, about in ABOUT[name]]
    boxes = [box for _, _, about in ABOUT[name] for _, box in about]
    for subject, box in zip([subject for note in notes for subject in note.elements], boxes, strict=True):
        assert subject.box == (box and pytest.approx(box))


def test_transforms_that_are_not_valid_are_named(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    body = '<path id="p" d="M0 0h9v9z" style="rotate: 1 1 30deg; scale: 2px; translate: red"/>'
    file.write_text(f'<svg viewBox="0 0 9 9" style="scale: none">{body}</svg>')
    assert [f"{note.kind}: {note}" for note in read_quietly(file).notes] == [
        "invalid: translate='red' of <path id=\"p\"> in line 1",
        "invalid: rotate='1 1 30deg' of <path id=\"p\"> in line 1",
        "invalid: scale='2px' of <path id=\"p\"> in line 1",
    ]


def test_the_box_of_an_element_holds_all_its_uses_and_strokes_but_not_what_it_masks(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><defs><g id="a" rotate="1" scale="2">'
        '<path d="M10 10h10" stroke="red" stroke-width="2"/></g></defs>'
        '<use id="b" style="filter: blur(1px)" href="#a"/><use href="#a" y="80"/>'
        '<mask id="m" style="filter: blur(1px)"><path id="c" style="filter: blur(1px)" d="M0 0h100v100h-100z"/></mask>'
        '<path style="filter: blur(1px)" d="M40 40h10v10h-10z" mask="url(#m)"/></svg>'
    )
    (note,) = read_quietly(file).notes
    boxes = dict(note.elements)
    assert boxes["b"] == pytest.approx((0.1, 0.89, 0.2, 0.91))
    assert boxes["c"] is None
    assert boxes["the 3rd <path> in line 1"] == pytest.approx((0.4, 0.5, 0.5, 0.6))


def test_a_note_names_so_many_elements_and_counts_the_others(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    file.write_text(f'<svg viewBox="0 0 9 9">{"<foreignObject/>" * 40}</svg>')
    assert [(note.count, len(note.elements)) for note in read_quietly(file).notes] == [(40, MOST_SUBJECTS), (1, 0)]


GROUP = "opacity of a group, which each of its shapes has by itself"
BLEND = "mix-blend-mode"
SHADE = "gradient shown as its mean colour"
RAMP = '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>'
TWO = '<rect width="5" height="5"/><rect x="2" width="5" height="5"/>'
BESIDE = '<rect width="2" height="5"/><rect x="2" width="5" height="5"/>'


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ('<rect width="5" height="5" stroke="red" opacity=".5"/>', [GROUP]),
        ('<rect width="5" height="5" opacity=".5"/>', []),
        (f'<g opacity=".5">{TWO}</g>', [GROUP]),
        (f'<g opacity=".5"><g>{TWO}</g></g>', [GROUP]),
        (f'<g opacity=".5">{BESIDE}</g>', []),
        (f'<g opacity="1">{TWO}</g>', []),
        (f'<defs><g id="a">{TWO}</g></defs><use href="#a" opacity=".5"/>', [GROUP]),
        (f'<svg opacity=".5">{TWO}</svg>', [GROUP]),
        ('<rect width="5" height="5" style="mix-blend-mode: multiply"/>', [BLEND]),
        ('<rect width="5" height="5" style="mix-blend-mode: multiply; opacity: .5"/>', [BLEND]),
        (f'<g opacity=".5"><g opacity=".5">{TWO}</g></g>', [f"{GROUP} (2)"]),
        (f'<g opacity=".5" style="mix-blend-mode: screen">{TWO}</g>', [GROUP, BLEND]),
        ('<rect width="5" height="5" style="mix-blend-mode: normal"/>', []),
        (f'{RAMP}<rect width="5" height="5" fill="url(#g)"/>', [SHADE]),
        (f'{RAMP}<g opacity=".5" fill="url(#g)" stroke="url(#g)">{TWO}</g>', [GROUP, f"{SHADE} (4)"]),
        (f"{RAMP}{TWO}", []),
    ],
)
def test_layers_name_what_they_lose_and_readings_lose_nothing(body: str, said: list[str]) -> None:
    drawing = read(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{body}</svg>'.encode())
    assert drawing.notes == ()
    assert all([str(note) for note in layer.notes] == said for layer in drawing.layers())


def test_layers_name_the_opacity_of_the_outermost_svg() -> None:
    drawing = read(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9" opacity=".5">{TWO}</svg>'.encode())
    assert [str(note) for note in drawing.layers()[0].notes] == [GROUP]


SHARED = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><g opacity=".5">{TWO}</g><foreignObject/></svg>'


def warned(work: Callable[[], object]) -> list[str]:
    with warnings.catch_warnings(record=True, action="always") as caught:
        work()
    assert {warning.filename for warning in caught} <= {__file__}
    return [str(warning.message) for warning in caught]


def test_what_layers_lose_is_warned_of_where_a_drawing_is_stacked(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    file.write_text(SHARED)
    unread, lost = f"{file}: left out: <foreignObject>", f"simplified: {GROUP}"
    assert warned(lambda: convert(file)) == [unread]
    assert warned(lambda: convert(file, split="paint")) == [f"{unread}; {lost}"]
    assert warned(lambda: atlas([file], split="paint")) == [f"{unread}; {lost}"]
    drawing = read_quietly(file)
    assert warned(lambda: coverage(drawing, 4)) == []
    assert warned(lambda: render(drawing, 4)) == []
    assert warned(lambda: render(drawing, 4, renderer="exact")) == []
    for stacked in (
        lambda: convert(drawing, split="paint"),
        lambda: atlas([drawing], split="paint"),
    ):
        assert warned(stacked) == [f"a: {lost}"]


@pytest.mark.parametrize(
    ("name", "color"),
    [
        ("pattern", (0.5, 0.5, 0.5)),
        ("missing-paint", (1, 0, 0)),
    ],
)
def test_paint_servers_become_flat_colors(name: str, color: tuple[float, float, float]) -> None:
    with pytest.warns(SourceWarning):
        drawing = read_svg(FIXTURES / "unsupported" / f"{name}.svg")
    assert [path.paint.color for path in drawing.paths] == [color]


@pytest.mark.parametrize(
    ("name", "rest"),
    [("breaks-off", "L10"), ("breaks-off-in-arc", "A30 30 0 2 0 10 90"), ("garbage-in-the-middle", "# L10 90z")],
)
def test_a_path_is_drawn_up_to_its_error(name: str, rest: str) -> None:
    with pytest.warns(SourceWarning, match="invalid and ignored: d='...") as caught:
        drawing = read_svg(FIXTURES / "paths" / f"{name}.svg")
    assert f"'...{rest}' of <path> in line 2" in str(caught[0].message)
    assert drawing.segments == 3


def test_a_long_list_is_cut(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    file.write_text('<svg viewBox="0 0 9 9">' + "".join(f"<thing{k}/>" for k in range(30)) + "</svg>")
    with pytest.warns(SourceWarning, match=r"<thing7>, and 22 more; nothing in it is painted$"):
        read_svg(file)


def test_a_file_without_size_is_reported_once(tmp_path: Path) -> None:
    """It is painted twice, the first time to find what lies beyond its size."""
    file = tmp_path / "a.svg"
    file.write_text('<svg><foreignObject/><rect width="9" height="9"/></svg>')
    with pytest.warns(
        SourceWarning, match="left out: <foreignObject>; it has no viewBox and no size, and is 300 x 150"
    ):
        read_svg(file)
    file.write_text("<svg><foreignObject/></svg>")
    with pytest.warns(SourceWarning, match="left out: <foreignObject>; .*, as in browsers; nothing in it is painted$"):
        read_svg(file)
