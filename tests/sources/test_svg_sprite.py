"""Sprites: each symbol is a drawing by itself."""

import pytest

from vexture.svg.read import svg_drawing
from vexture.svg.sprite import symbol_drawings

RAMP = '<linearGradient id="ramp"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>'
SQUARE = '<path d="M0 0h6v6h-6z"/>'
SYMBOLS = f"""<symbol id="wide" viewBox="0 0 24 12">{SQUARE}</symbol>
<symbol id="shaded" viewBox="0 0 6 6"><path fill="url(#ramp)" d="M0 0h6v6h-6z"/></symbol>
<symbol id="twice" viewBox="0 0 12 6"><use href="#wide" width="6" height="6"/>{SQUARE}</symbol>
<symbol id="around" viewBox="0 0 6 6">{SQUARE}<symbol id="within" viewBox="0 0 9 9">{SQUARE}</symbol></symbol>"""
COUNTED = "<style>symbol:nth-of-type(2) path { fill: lime } #wide > path { fill: aqua }</style>"
ROOT = 'xmlns="http://www.w3.org/2000/svg"'
SPRITES = {
    "plain": f"<svg {ROOT}>{RAMP}{SYMBOLS}</svg>",
    "in-defs": f"<svg {ROOT}><defs>{SYMBOLS}{RAMP}</defs></svg>",
    "gradient-in-a-symbol": f"<svg {ROOT}>{SYMBOLS}<symbol id='paints'>{RAMP}</symbol></svg>",
    "styled": f"<svg {ROOT}>{COUNTED}{RAMP}{SYMBOLS}</svg>",
    "shown-nowhere": f'<svg {ROOT} style="display:none">{RAMP}{SYMBOLS}</svg>',
    "without-size": f'<svg {ROOT} style="position: absolute; width: 0; height: 0" width="0">{RAMP}{SYMBOLS}</svg>',
}


def contents(drawing):
    contours = [contour.tobytes() for path in drawing.paths for contour in path.contours]
    return drawing.sides, contours, [path.paint for path in drawing.paths], drawing.notes


@pytest.mark.parametrize("sprite", SPRITES.values(), ids=SPRITES)
def test_each_symbol_is_what_select_makes_of_it(sprite):
    found = {drawing.name: drawing for drawing in symbol_drawings(sprite.encode(), "sprite.svg")}
    assert [*found][:5] == ["wide", "shaded", "twice", "around", "within"]
    assert found["wide"].sides == (1.0, 0.5)
    assert found["twice"].segments == 8
    for name in ("shaded", "twice", "around", "within"):
        selected = svg_drawing(sprite.encode(), "sprite.svg", f"#{name}")
        assert contents(found[name]) == contents(selected), name


def test_style_sheets_count_the_symbols_of_the_whole_sprite():
    found = {drawing.name: drawing for drawing in symbol_drawings(SPRITES["styled"].encode(), "sprite.svg")}
    assert [path.paint.hex for path in found["wide"].paths] == ["#00ffff"]
    assert [path.paint.hex for path in found["around"].paths] == ["#000000"]


def test_a_symbol_that_paints_nothing_says_so():
    sprite = f'<svg {ROOT}><symbol id="empty" viewBox="0 0 1 1"/><symbol id="wide">{SQUARE}</symbol></svg>'
    empty, _ = symbol_drawings(sprite.encode(), "sprite.svg")
    assert [note.message for note in empty.notes] == ["nothing in it is painted"]
