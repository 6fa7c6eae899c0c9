"""Style sheets beyond what pictures show: hostile ones, and what is named."""

import warnings
from pathlib import Path

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


def test_nested_rules_that_multiply_are_named(tmp_path: Path) -> None:
    style = "<style>path" + " { &amp; + &amp;" * 40 + " { fill: red }" + " }" * 40 + "</style>"
    drawing = read_quietly(tmp_path, style + SQUARE)
    assert [str(note) for note in drawing.notes] == ["CSS selector '& + &', which cannot be read"]


def test_a_shorthand_that_is_not_valid_is_named(tmp_path: Path) -> None:
    drawing = read_quietly(tmp_path, SQUARE.replace("/>", ' style="font: red; fill: blue"/>'))
    assert [str(note) for note in drawing.notes] == ["font='red' of <path id=\"p\"> in line 1"]
    assert colors(drawing) == [(0, 0, 1)]


def test_long_lists_of_selectors_are_read(tmp_path: Path) -> None:
    style = f"<style>{','.join(f'.cls-{n}' for n in range(5_000))},path {{ fill: blue }}</style>"
    assert colors(read_quietly(tmp_path, style + SQUARE)) == [(0, 0, 1)]
