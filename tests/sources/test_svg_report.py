"""What is not supported is named, once for a file."""

import warnings
from pathlib import Path

import pytest

from vexture import read
from vexture.errors import SourceWarning
from vexture.svg.read import read_svg

FIXTURES = Path(__file__).parent / "fixtures"

SAID = {
    "animation": "left out: animation",
    "clip-path": "left out: clip-path",
    "css-rotate": "left out: rotate",
    "css-variables": "left out: CSS variables",
    "external-use": "left out: <use> of 'other.svg#a'",
    "filter": "left out: filter",
    "foreign-object": "left out: <foreignObject>; nothing in it is painted",
    "image": "left out: <image>; nothing in it is painted",
    "import": "left out: @import",
    "lab-color": "simplified: colour of a space other than sRGB read as black",
    "linear-gradient": "simplified: linearGradient read as a solid colour",
    "many": "left out: <text> (2), <image>; invalid and ignored: r='x' of <rect> in line 5",
    "marker": "left out: marker",
    "mask": "left out: mask",
    "missing-paint": "left out: paint '#none' (2)",
    "pattern": "simplified: pattern read as solid",
    "radial-gradient-by-reference": "simplified: radialGradient read as a solid colour",
    "script": "left out: script",
    "text": "left out: <text>; nothing in it is painted",
    "unknown-element": "left out: <flowRoot>",
    "vector-effect": "left out: vector-effect 'fixed-position'",
}


@pytest.mark.parametrize("path", sorted((FIXTURES / "unsupported").glob("*.svg")), ids=lambda path: path.stem)
def test_unsupported_features_are_named_once(path: Path) -> None:
    with pytest.warns(SourceWarning) as caught:
        read_svg(path)
    assert [str(warning.message) for warning in caught] == [f"{path}: {SAID[path.stem]}"]
    assert caught[0].filename == __file__


GROUP = "opacity of a group, which each of its shapes has by itself"
SHAPE = "opacity of a shape, which its fill and its stroke have by themselves"
TWO = '<rect width="5" height="5"/><rect x="2" width="5" height="5"/>'
BESIDE = '<rect width="2" height="5"/><rect x="2" width="5" height="5"/>'


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ('<rect width="5" height="5" stroke="red" opacity=".5"/>', [SHAPE]),
        ('<rect width="5" height="5" opacity=".5"/>', []),
        (f'<g opacity=".5">{TWO}</g>', [GROUP]),
        (f'<g opacity=".5"><g>{TWO}</g></g>', [GROUP]),
        (f'<g opacity=".5">{BESIDE}</g>', []),
        (f'<g opacity="1">{TWO}</g>', []),
        (f'<defs><g id="a">{TWO}</g></defs><use href="#a" opacity=".5"/>', [GROUP]),
        (f'<svg opacity=".5">{TWO}</svg>', [GROUP]),
        ('<rect width="5" height="5" style="mix-blend-mode: multiply"/>', ["mix-blend-mode"]),
        ('<rect width="5" height="5" style="mix-blend-mode: normal"/>', []),
    ],
)
def test_opacity_and_blending_that_are_not_drawn_are_named(body: str, said: list[str]) -> None:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        drawing = read(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{body}</svg>'.encode())
    assert [note.message for note in drawing.notes] == said


def test_opacity_of_the_outermost_svg_is_named() -> None:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        drawing = read(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9" opacity=".5">{TWO}</svg>'.encode())
    assert [note.message for note in drawing.notes] == [GROUP]


@pytest.mark.parametrize(
    ("name", "color"),
    [
        ("linear-gradient", (0.5, 0, 0.5)),
        ("radial-gradient-by-reference", (0, 1, 0)),
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
    """It is painted twice, the first time to find its size."""
    file = tmp_path / "a.svg"
    file.write_text('<svg><text>a</text><rect width="9" height="9"/></svg>')
    with pytest.warns(SourceWarning, match="left out: <text>$"):
        read_svg(file)


def test_gradients_that_lend_to_each_other_end(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    gradients = '<linearGradient id="a" href="#b"/><linearGradient id="b" href="#a"/>'
    file.write_text(f'<svg viewBox="0 0 9 9">{gradients}<rect width="9" height="9" fill="url(#a)"/></svg>')
    with pytest.warns(SourceWarning, match="linearGradient"):
        assert read_svg(file).paths == ()
