"""The style of an element: the cascade, its keywords and inheritance."""

from pathlib import Path

import pytest

from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg


def drawing_of(folder: Path, body: str, root: str = 'viewBox="0 0 100 100"') -> Drawing:
    file = folder / "drawing.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>')
    return read_svg(file)


@pytest.mark.parametrize(
    ("keyword", "fills", "opacities"),
    [
        ("inherit", [(1, 0, 0)], [0.25]),
        ("unset", [(1, 0, 0)], [0.5]),
        ("initial", [(0, 0, 0)], [0.5]),
        ("revert", [(1, 0, 0)], [0.5]),
    ],
)
def test_keywords_of_the_cascade(tmp_path: Path, keyword: str, fills: list[object], opacities: list[float]) -> None:
    rect = f'<rect width="9" height="9" style="fill: {keyword}; opacity: {keyword}" fill="blue" opacity="0.1"/>'
    drawing = drawing_of(tmp_path, f'<g fill="red" opacity="0.5">{rect}</g>')
    assert [path.paint.color for path in drawing.paths] == fills
    assert [path.paint.opacity for path in drawing.paths] == opacities


STYLES = """<style>
rect { fill: red; stroke: none }
.blue { fill: blue }
#own { fill: lime }
.loud { fill: white !important }
</style>"""


@pytest.mark.filterwarnings("ignore::vexture.SourceWarning")
@pytest.mark.parametrize(
    ("attributes", "fill"),
    [
        ('fill="black"', "#ff0000"),
        ('class="blue" fill="black"', "#0000ff"),
        ('class="blue" id="own"', "#00ff00"),
        ('class="blue" id="own" style="fill: yellow"', "#ffff00"),
        ('class="loud" id="own" style="fill: yellow"', "#ffffff"),
        ('class="loud" style="fill: yellow !important"', "#ffff00"),
        ('style="fill: yellow; fill: nonsense"', "#ffff00"),
        ('style="fill: currentcolor; color: teal"', "#008080"),
    ],
)
def test_the_more_specific_declaration_wins(tmp_path: Path, attributes: str, fill: str) -> None:
    drawing = drawing_of(tmp_path, f'{STYLES}<g fill="purple"><rect width="9" height="9" {attributes}/></g>')
    assert [path.paint.hex for path in drawing.paths] == [fill]


def test_lengths_of_a_font_refer_to_the_font_around_it(tmp_path: Path) -> None:
    inside = '<g font-size="2em"><rect width="1em" height="1rem"/></g>'
    drawing = drawing_of(tmp_path, f'<g font-size="5">{inside}</g>', 'viewBox="0 0 100 100" font-size="20"')
    low, high = drawing.paths[0].box
    assert (100 * (high - low)).tolist() == pytest.approx([10.0, 20.0])


def test_what_is_not_displayed_or_not_visible_paints_nothing(tmp_path: Path) -> None:
    shown = '<rect id="a" width="9" height="9" visibility="visible"/>'
    body = f'<g visibility="hidden">{shown}<rect width="9" height="9"/></g><g display="none">{shown}</g>'
    assert [path.element for path in drawing_of(tmp_path, body).paths] == ["a"]
