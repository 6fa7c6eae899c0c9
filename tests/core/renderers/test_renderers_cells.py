"""Cells that a pixel meets, and their parts in it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from packed_views import ENTRIES, turned_view
from test_renderers_cpu import errors, source

import corpora
from vexture.renderers.cells import VexturePlace, first_square, next_square
from vexture.renderers.cpu import render_cpu
from vexture.renderers.exact import render_exact
from vexture.renderers.method import NO_CELL

STEP = 1 / 255


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.parametrize("pixels", [20, 61, 64, 100])
@pytest.mark.parametrize("name", ["duck", "letter &", "icon 1", "degenerate 12", "holed disc"])
def test_pixels_whose_edges_lie_on_cell_lines(name: str, pixels: int, entry: str) -> None:
    """Quarter turns and half-pixel shifts of the unit square: sides of pixels, of cells and of drawings meet."""
    drawing, texture = source(name)
    step = 1 / pixels
    for quarter in range(4):
        turn = np.linalg.matrix_power(np.array([[0.0, -1.0], [1.0, 0.0]]), quarter) * step
        for shift in (0.0, 0.5):
            matrix = np.eye(3)
            matrix[:2, :2] = turn
            matrix[:2, 2] = 0.5 - turn @ (pixels / 2 + shift, pixels / 2 + shift)
            size, view = ENTRIES[entry](((pixels, pixels), matrix))
            error = np.abs(render_cpu(texture, size, view) - render_exact(drawing, size, view)).max()
            assert error < STEP, (quarter, shift)


@pytest.mark.parametrize(
    ("pixels", "degrees", "narrow"), [(64, 0, 1), (16, 0, 1), (16, 30, 1), (100, 45, 8), (90, 20, 16)]
)
def test_cells_that_a_pixel_cuts_count_by_the_part_in_it(pixels: float, degrees: float, narrow: float) -> None:
    """A coast with up to a hundred edges in a pixel, whose cells are divided far below those that the sum visits."""
    mean, largest, leaves = errors(corpora.fractal_coastline(12_288, seed=1), turned_view(pixels, degrees, narrow))
    assert not leaves
    assert mean < 0.1
    assert largest < 4.0


@given(st.integers(0, 10**9), st.integers(8, 14))
def test_the_squares_of_a_walk_are_those_that_meet_the_box_each_once(seed: int, finest: int) -> None:
    """Against every cell of that size, by brute force."""
    rng = np.random.default_rng(seed)
    side = 1 << finest
    low = rng.integers(0, 1 << 28, 2) if seed % 2 else rng.integers(0, 1 << 8, 2) << 20
    high = np.minimum(low + rng.integers(0, 12 * side, 2), (1 << 28) - 1)
    place = VexturePlace((0, 0), (0.0, 0.0), tuple(map(int, low)), tuple(map(int, high)))
    met = []
    square = first_square(place)
    smallest = min(finest, square.bit)  # the box may be smaller than a cell
    while square.position[0] < NO_CELL:
        assert (low <= square.position).all()
        assert (square.position <= high).all()
        origin = tuple(place & -side for place in square.position)
        assert square.bit >= smallest
        met.append(origin)
        square = next_square(square.position, (origin[0] + side, origin[1] + side), place)
    cells = [range(start & -side, end + 1, side) for start, end in zip(place.low, place.high, strict=True)]
    assert len(met) == len(set(met))
    assert set(met) == {(x, y) for x in cells[0] for y in cells[1]}
