"""What is not supported is named, once for a file."""

import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

from vexture import atlas, convert, coverage, read, render
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg

FIXTURES = Path(__file__).parent / "fixtures"


def read_quietly(file: Path) -> Drawing:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return read(file)


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
