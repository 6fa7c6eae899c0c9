"""Style sheets beyond what pictures show: hostile ones, and what is named."""

import warnings
from pathlib import Path

import pytest

from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg

SQUARE = '<path id="p" d="M0 0h9v9z"/>'


def read_quietly(folder: Path, body: str, root: str = 'viewBox="0 0 9 9"') -> Drawing:
    file = folder / "a.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>')
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return read_svg(file)


def colors(drawing: Drawing) -> list[tuple[float, float, float]]:
    return [path.paint.color for path in drawing.paths]


def test_references_that_multiply_have_no_value(tmp_path: Path) -> None:
    bomb = "".join(f"--a{n}: var(--a{n - 1}) var(--a{n - 1});" for n in range(1, 60))
    style = f"<style>path {{ --a0: red; {bomb} fill: var(--a59, blue) }}</style>"
    assert colors(read_quietly(tmp_path, style + SQUARE)) == [(0, 0, 1)]


def test_long_chains_and_rings_of_references(tmp_path: Path) -> None:
    links = "".join(f"--a{n}: var(--a{n + 1});" for n in range(3_000))
    chain = f"<style>svg {{ {links} --a3000: blue }} path {{ fill: var(--a0, red) }}</style>"
    assert colors(read_quietly(tmp_path, chain + SQUARE)) == [(0, 0, 1)]
    ring = chain.replace("--a3000: blue", "--a3000: var(--a7)")
    assert colors(read_quietly(tmp_path, ring + SQUARE)) == [(1, 0, 0)]


def test_rings_that_share_a_property_have_no_value(tmp_path: Path) -> None:
    style = (
        "--a: var(--b, red); --b: var(--a, red) var(--c, red); --c: var(--b, red); --d: var(--c, blue); fill: var(--{})"
    )
    for name, color in (("a", (0, 0, 0)), ("b", (0, 0, 0)), ("c", (0, 0, 0)), ("d", (0, 0, 1))):
        square = SQUARE.replace("/>", f' style="{style.format(name)}"/>')
        assert colors(read_quietly(tmp_path, square)) == [color]


def test_nested_rules_that_multiply_are_named(tmp_path: Path) -> None:
    style = "<style>path" + " { &amp; + &amp;" * 40 + " { fill: red }" + " }" * 40 + "</style>"
    drawing = read_quietly(tmp_path, style + SQUARE)
    assert [str(note) for note in drawing.notes] == ["CSS selector '& + &', which cannot be read"]


def test_a_shorthand_that_is_not_valid_is_named(tmp_path: Path) -> None:
    drawing = read_quietly(tmp_path, SQUARE.replace("/>", ' style="font: red; fill: blue"/>'))
    assert [str(note) for note in drawing.notes] == ["font='red' of <path id=\"p\"> in line 1"]
    assert colors(drawing) == [(0, 0, 1)]


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


def test_long_lists_of_selectors_are_read(tmp_path: Path) -> None:
    style = f"<style>{','.join(f'.cls-{n}' for n in range(5_000))},path {{ fill: blue }}</style>"
    assert colors(read_quietly(tmp_path, style + SQUARE)) == [(0, 0, 1)]
