"""Sprites: each symbol is a drawing by itself."""

import numpy as np
import pytest

from vexture.conversion.sprites import symbol_drawings
from vexture.svg.read import svg_drawing

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


FRAMED = {
    "above-the-origin": ("0 -960 960 960", ""),
    "around-the-origin": ("-8 -8 16 16", ""),
    "in-parts": ("4.3 4.7 16.1 16", 'overflow="visible"'),
    "own-size": ("0 0 24 24", 'width="48" height="48"'),
    "own-place": ("2 2 24 24", 'x="3" y="4"'),
    "stretched": ("0 0 24 12", 'preserveAspectRatio="none" width="48" height="48"'),
    "sliced": ("-4 0 16 8", 'preserveAspectRatio="xMinYMin slice" width="20" height="20"'),
}


@pytest.mark.parametrize(("box", "others"), FRAMED.values(), ids=FRAMED)
def test_a_symbol_fills_the_frame_of_its_own_view_box(box, others):
    left, top, width, height = map(float, box.split())
    rect = f'<rect x="{left}" y="{top}" width="40%" height="3" stroke="red"/>'
    shapes = f'<path d="M{left} {top}h{width / 2}v{height / 4}z"/>{rect}'
    sheet = "<style>use { x: 5px; width: 1em } symbol { height: 9px } svg { width: 7px }</style>"
    symbol = f'<symbol id="a" viewBox="{box}" {others}>{shapes}</symbol>'
    sprite = f'<svg {ROOT} viewBox="1 2 3 4" height="5">{sheet}{symbol}</svg>'.encode()
    alone = svg_drawing(f'<svg {ROOT} viewBox="{box}">{shapes}</svg>'.encode(), "a.svg")
    (of_atlas,) = symbol_drawings(sprite, "sprite.svg")
    for drawing in (of_atlas, svg_drawing(sprite, "sprite.svg", "#a")):
        assert (drawing.sides, drawing.notes) == (alone.sides, ())
        np.testing.assert_array_equal(drawing.to_source, alone.to_source)
        assert len(drawing.paths) == len(alone.paths) == 3
        for path, same in zip(drawing.paths, alone.paths, strict=True):
            np.testing.assert_allclose(np.hstack(path.contours), np.hstack(same.contours), atol=1e-12)


def test_a_symbol_without_a_view_box_has_a_frame_of_its_size_or_of_what_it_paints():
    symbols = f'<symbol id="sized" width="12" height="24" x="5">{SQUARE}</symbol>'
    symbols += f'<symbol id="painted"><g transform="translate(-500 200)">{SQUARE}</g></symbol>'
    symbols += '<symbol id="small"><path d="M.5 0h.02v.01h-.02z"/></symbol>'
    sized, painted, small = symbol_drawings(f"<svg {ROOT}>{symbols}</svg>".encode(), "sprite.svg")
    assert (sized.sides, sized.notes) == ((0.5, 1.0), ())
    assert sized.paths[0].box.tolist() == [[0.25, 0.75], [0.5, 1.0]]
    assert painted.paths[0].box.tolist() == [[0.0, 0.0], [1.0, 1.0]]
    assert painted.to_source @ [0.0, 1.0, 1.0] == pytest.approx([-500, 200])
    told = "it has no viewBox and no size; its frame is what it paints, viewBox="
    assert [note.message for note in painted.notes] == [f'{told}"-500 200 6 6"']
    assert [note.message for note in small.notes] == [f'{told}"0.5 0 0.02 0.01"']


def test_symbols_that_no_name_leads_to_are_named():
    symbol = f'<symbol {{}} viewBox="0 0 6 6">{SQUARE}</symbol>'
    symbols = "".join(map(symbol.format, ('id="up"', 'id="dup"', "", 'id="dup"', 'id=""')))
    first, second = symbol_drawings(f"<svg {ROOT}>{symbols}</svg>".encode(), "sprite.svg")
    said = ["symbol without an id (2)", "symbol with the id of another, 'dup'"]
    assert ([str(note) for note in first.notes], second.notes) == (said, ())
    assert all(note.is_loss for note in first.notes)
