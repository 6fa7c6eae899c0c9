"""Conditions of media, and what each answers for a drawing."""

from pathlib import Path

import pytest
import tinycss2
from styled_squares import SQUARE, colors, read_quietly

from vexture.svg.media import Medium


@pytest.mark.parametrize(
    ("root", "holds"),
    [
        ('viewBox="0 0 9 9" width="3in"', True),
        ('viewBox="0 0 400 300"', True),
        ('viewBox="0 0 400 300" height="200"', False),
        ("", True),
        ('width="100%" height="50"', True),
        ('width="280" height="50"', False),
    ],
)
def test_media_have_the_size_of_the_drawing(tmp_path: Path, root: str, holds: bool) -> None:
    style = "<style>@media (min-width: 287.9px) { path { fill: blue } }</style>"
    assert colors(read_quietly(tmp_path, style + SQUARE, root)) == [(0, 0, 1) if holds else (0, 0, 0)]


@pytest.mark.parametrize(
    ("query", "answer"),
    [
        ("", True),
        ("screen", True),
        ("print", False),
        ("print, screen", True),
        ("not print", True),
        ("only screen and (width: 400px)", True),
        ("screen and (width: 401px)", False),
        ("not screen and (width: 401px)", True),
        ("(min-width: 400px) and (max-height: 299px)", False),
        ("(width > 300px) or (height > 500px)", True),
        ("(300px < width <= 400px)", True),
        ("(300px < width < 400px)", False),
        ("(300px < width > 200px)", None),
        ("(aspect-ratio: 4/3)", True),
        ("(orientation: portrait)", False),
        ("(25em = width)", True),
        ("(width: 400)", None),
        ("(resolution: 96dpi)", True),
        ("(min-resolution: 2x)", False),
        ("(-webkit-min-device-pixel-ratio: 1)", True),
        ("(hover)", False),
        ("(hover: none)", True),
        ("(color)", True),
        ("(monochrome)", False),
        ("(moon: full)", None),
        ("not (moon: full)", None),
        ("(moon: full) or (color)", True),
        ("(moon: full) and (monochrome)", False),
        ("(color) and (color) or (color)", None),
        ("not ((color) and (monochrome))", True),
        ("screen or print", None),
    ],
)
def test_media_queries_of_a_screen(query: str, answer: bool | None) -> None:
    assert Medium(400.0, 300.0).holds(tinycss2.parse_component_value_list(query)) is answer
