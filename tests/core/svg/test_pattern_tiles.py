"""Tiles of patterns: no seams, strips of what spans them, and limits."""

import numpy as np
import pytest
from pattern_drawings import DISC, DOT, FILLED, PATTERN, RECT, SIZE, dots, drawing_of, gap

from vexture.svg.pattern_tiles import MOST

WHOLE = {
    "stretched": '<rect width="7" height="7"/>',
    "larger": '<rect x="-9" y="-9" width="70" height="70"/>',
    "repeated": '<path d="M0 0H3H7V7H0z"/>',
    "halves": '<path d="M0 0H7L0 7zM7 0V7H0z"/>',
    "curves": '<path d="M-1 -1H2Q6 3 2 8H-1zM2 8Q6 3 2 -1H9V8z"/>',
}


@pytest.mark.parametrize("shape", [RECT, DISC])
@pytest.mark.parametrize("turn", [0, 30, 45])
@pytest.mark.parametrize("name", WHOLE)
def test_tiles_have_no_seams(name: str, turn: int, shape: str) -> None:
    """Translucent, so that two tiles that overlap would show as much as a gap."""
    attributes = f'x="0.3" y="0.1" width="7" height="7" fill="#06c" patternTransform="rotate({turn}) scale(1.1)"'
    tiled = PATTERN.format(attributes, WHOLE[name]) + shape.format(FILLED + ' fill-opacity="0.5"')
    assert gap(tiled, shape.format('fill="#06c" fill-opacity="0.5"')) < 2e-6


def test_neighbours_share_their_border_bit_for_bit() -> None:
    """Each tile has a column and a row of corners inside, and shares those on its borders."""
    attributes = 'x="0.3" y="0.1" width="0.7" height="0.7"'
    content = '<path d="M0 0H.3H.7V.2V.7H0z"/>'
    (path,) = drawing_of(PATTERN.format(attributes, content) + '<rect width="70" height="70" fill="url(#p)"/>').paths
    corners = np.array([contour[:, 0] for contour in path.contours if contour.shape == (6, 4, 2)])
    inside = np.concatenate(corners[((corners > 0.31) & (corners < 0.69)).all(axis=(1, 2))])
    for axis in (0, 1):
        exact = np.unique(inside[:, axis])
        assert len(exact) == len(np.unique(exact.round(9))) > 100


def test_what_spans_tiles_is_one_strip() -> None:
    """Each line of a hatching is one contour, of four cubics, and so is a background."""
    for line in ('<line y2="10" stroke="red" stroke-width="2"/>', '<path d="M-1 5H11" stroke="red" stroke-width="2"/>'):
        content = f'<rect width="10" height="10" fill="lime"/>{line}'
        drawing = drawing_of(PATTERN.format(SIZE + ' patternTransform="rotate(90)"', content) + RECT.format(FILLED))
        assert [len(path.contours) for path in drawing.paths] == [1, 10]
        assert drawing.segments == 44


def test_gradients_move_with_their_tiles() -> None:
    ramp = '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>'
    tile = '<rect width="20" height="30" fill="url(#g)"/>'
    tiled = PATTERN.format('width="25" height="40" x="5" patternTransform="rotate(20)"', tile) + DISC.format(FILLED)
    uses = "".join(
        f'<g transform="translate({5 + 25 * i} {40 * j})">{tile}</g>' for i in range(-9, 9) for j in range(-9, 9)
    )
    clip = f'<clipPath id="c">{DISC.format("")}</clipPath>'
    by_hand = f'{clip}<g clip-path="url(#c)"><g transform="rotate(20)">{uses}</g></g>'
    assert gap(ramp + tiled, ramp + by_hand) < 2e-6


MANY = "<g/>" * (MOST["elements"] // 2)
RAMP = '<linearGradient id="g"><stop/><stop offset="1" stop-color="red"/></linearGradient>'
SHADED = DOT.replace('"red"', '"url(#g)"')
SOLID = '<pattern id="p"> in line 1 read as solid: here it has {} in its tiles; all patterns of a drawing may have {:,}'


@pytest.mark.parametrize(
    ("body", "said"),
    [
        (dots('width=".1" height=".1" viewBox="0 0 9 9"'), SOLID.format("4,000,000 segments", MOST["segments"])),
        (
            RAMP + PATTERN.format('width="2" height="2" viewBox="0 0 9 9"', SHADED) + RECT.format(FILLED),
            SOLID.format("2,500 gradients", MOST["gradients"]),
        ),
        (
            f'<pattern id="p" {SIZE}>{DOT}{MANY}</pattern>{DISC.format(FILLED)}<g transform="scale(.5)">'
            f"{DISC.format(FILLED)}</g>",
            SOLID.format("10,002 elements", MOST["elements"]),
        ),
    ],
)
def test_too_many_tiles_are_solid_and_named(body: str, said: str) -> None:
    drawing = drawing_of(body)
    assert [str(note) for note in drawing.notes] == [said]
    assert drawing.paths[-1].paint.hex == "#808080"


def test_tiles_in_tiles_are_counted() -> None:
    inside = '<path d="M0 0H9V9z" fill="url(#p{})"/>'
    chain = "".join(PATTERN.format(SIZE, inside.format(k + 1)).replace('"p"', f'"p{k}"') for k in range(5))
    small = PATTERN.format('width=".5" height=".5" viewBox="0 0 9 9"', DOT).replace('"p"', '"p5"')
    drawing = drawing_of(chain + small + RECT.format(FILLED.replace("p)", "p0)")))
    assert 100_000 < drawing.segments <= MOST["segments"]
    assert drawing.notes == ()
