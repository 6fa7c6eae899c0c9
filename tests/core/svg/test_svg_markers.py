"""Markers of an SVG beside what pictures show: names, limits, notes, and paints of the context."""

import warnings

import numpy as np
import pytest

import vexture
from vexture.base.errors import SourceError, SourceWarning
from vexture.drawing.drawing import Drawing

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
DOT = '<marker id="m" viewBox="0 0 1 1"><rect width="1" height="1" fill="red"/></marker>'
LINE = '<path id="line" d="{}" fill="none" stroke="blue" style="marker: url(#m)"/>'
LEAP = '<path d="M{} 0H9" style="marker-end: url(#{})"/>'


def drawing_of(body: str) -> Drawing:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return vexture.read(f"{HEAD}{body}</svg>".encode())


def hexes(body: str) -> list[str]:
    return [path.paint.hex for path in drawing_of(body).paths]


def test_markers_have_the_name_of_their_shape() -> None:
    stroked = DOT.replace('fill="red"', 'id="inside" fill="red" stroke="lime" stroke-width=".1"')
    drawing = drawing_of(stroked + LINE.format("M20 20H80"))
    assert [path.element for path in drawing.paths] == ["line/stroke", *2 * ["line", "line/stroke"]]


@pytest.mark.parametrize(
    ("data", "count"),
    [
        ("M10 10", 0),  # it paints nothing, and so has no markers
        ("M10 10z", 2),
        ("M10 10h5", 2),
        ("M10 10h5v5z", 4),
        ("M10 10h5v5zh5", 5),  # the vertex at which a part was closed is the first one of the next part
        ("M10 10h5M20 20", 3),
        ("M10 10M20 20h5", 3),
        ("M10 10a5 5 0 0 0 9 9", 2),
        ("M10 10h5!", 2),
    ],
)
def test_each_vertex_has_a_marker(data: str, count: int) -> None:
    assert hexes(DOT + LINE.format(data)).count("#ff0000") == count


def test_a_shape_that_measures_others_does_so_without_its_markers() -> None:
    half = '<mask id="a" width="1" height="1" x="0" y="0"><rect width="100" height="100" fill="white"/></mask>'
    drawing = drawing_of(f'{DOT}{half}<g mask="url(#a)">{LINE.format("M20 20H80V60")}</g>')
    window = next(path for path in drawing.paths if path.paint.hex == "#ffffff").contours[0][:, 0]
    np.testing.assert_allclose([window.min(axis=0), window.max(axis=0)], [[0.2, 0.4], [0.8, 0.8]], atol=1e-12)


def test_paints_of_the_context_are_those_of_the_nearest_element_that_has_the_marker_or_is_the_use() -> None:
    dot = DOT.replace('"red"', '"context-stroke"')
    assert hexes(dot + LINE.format("M20 20H80")) == ["#0000ff"] * 3
    used = '<defs><rect id="r" width="9" height="9" fill="context-fill"/></defs><use href="#r" fill="lime"/>'
    assert hexes(used) == ["#00ff00"]
    inside = '<marker id="m" viewBox="0 0 9 9"><use href="#r" fill="context-stroke"/></marker>'
    assert hexes(used.replace("lime", "none") + inside + LINE.format("M20 20H80")) == ["#0000ff"] * 3
    assert hexes('<rect width="9" height="9" fill="context-fill"/>') == []


def test_a_gradient_of_the_context_spans_the_box_of_the_use() -> None:
    ramp = '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>'
    boxes = '<rect x="{}" width="9" height="9" fill="context-fill"/>'
    drawing = drawing_of(f'{ramp}<defs><g id="r">{boxes.format(0)}{boxes.format(41)}</g></defs>'
                         '<use href="#r" x="10" fill="url(#g)"/>')  # fmt: skip
    rows = [path.paint.gradient.to_ramp[0] for path in drawing.paths if path.paint.gradient is not None]
    np.testing.assert_allclose(rows, [[2.0, 0.0, -0.2]] * 2, atol=1e-12)  # from 0.1 to 0.6 of the drawing


def test_markers_of_an_empty_marker_and_of_a_line_without_width_cost_nothing() -> None:
    many = LINE.format("M0 0" + "h.001" * 60_000)
    assert len(drawing_of('<marker id="m"/>' + many).paths) == 1
    assert drawing_of(DOT + many.replace("fill=", 'stroke-width="0" fill=')).paths == ()


def test_too_many_markers_are_an_error() -> None:
    said = r"<path id=\"line\"> in line 1: <use>, clips, markers, masks and patterns show more than 50,000 elements"
    with pytest.raises(SourceError, match=said):
        drawing_of(DOT + LINE.format("M0 0" + "h.001" * 60_000))


def test_markers_nested_too_deeply_are_an_error() -> None:
    chain = "".join(f'<marker id="m{k}">{LEAP.format(0, f"m{k + 1}")}</marker>' for k in range(40))
    with pytest.raises(SourceError, match=r"its clips, markers, masks and patterns are nested more than 32 deep"):
        drawing_of(f"{chain}{LEAP.format(0, 'm0')}{DOT}")


def test_markers_that_show_one_another_end() -> None:
    pair = "".join(f'<marker id="{a}"><path d="M0 0h1v1z" marker-mid="url(#{b})"/></marker>' for a, b in ("mn", "nm"))
    drawing = drawing_of(pair + LINE.format("M20 20H80"))
    assert [str(note) for note in drawing.notes] == [
        'marker-mid that refers to itself, of <marker id="m"> in line 1 (4)'
    ]
    assert len(drawing.paths) == 1 + 2 + 2 * 2
