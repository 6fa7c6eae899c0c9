"""Features that are not supported are named, once for a file."""

import warnings
from pathlib import Path

import pytest

from vexture import read
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg

FIXTURES = Path(__file__).parent / "fixtures"

TILES = " (it has 40,960,000 tiles; the limit is 2,000)"

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
    "filter": "left out: filter of offset and tile" + TILES,
    "filter-functions": "left out: filter of drop shadow, offset and tile" + TILES,
    "filter-missing": "invalid and ignored: filter='url(#none)' of <rect> in line 2",
    "filter-steps": f"left out: filter of flood, offset, blur, color matrix and more{TILES} (2)",
    "gradient-mesh": "left out: gradient mesh",
    "hatch": "left out: hatch",
    "html": "left out: <p> in line 2, of another namespace",
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
    "mask-in-linear-light": "simplified: mask in linear light (color-interpolation) read as one in sRGB",
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
