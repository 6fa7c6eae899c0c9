"""Heights at which monotone pieces change their order."""

import numpy as np
import pytest

import vexture
from vexture.renderers.exact import render_exact
from vexture.tree.crossings import crossing_heights, x_at

SIDE = 32768.0


def line(x0: float, y0: float, x3: float, y3: float) -> np.ndarray:
    return np.linspace((x0, y0), (x3, y3), 4)


def heights_of(*curves: np.ndarray, near: float = 1.0) -> list[float]:
    heights, count = crossing_heights(np.stack(curves), near, 0)
    return sorted(heights[:count].tolist())


def test_x_of_a_piece_at_a_height() -> None:
    assert x_at(line(0, 100, 200, 0), 25.0) == pytest.approx(150.0)
    bend = np.array([[0.0, 0.0], [0.0, 30.0], [0.0, 60.0], [90.0, 90.0]])  # x = 90 t^3, y = 90 t
    assert x_at(bend, 45.0) == pytest.approx(90 / 8)
    assert (x_at(bend, 0.0), x_at(bend, 90.0)) == (0.0, 90.0)


def test_lines_cross_where_they_do_by_hand() -> None:
    rising, falling = line(0, 0, SIDE, SIDE), line(0, SIDE, SIDE, 0)
    low = line(0, 100, SIDE, 1100)
    assert heights_of(rising, falling) == pytest.approx([SIDE / 2], abs=1)
    slope = 1000 / SIDE
    expected = sorted([SIDE / 2, 100 / (1 - slope), 100 + slope * (SIDE - 100) / (1 + slope)])
    assert heights_of(rising, falling, low) == pytest.approx(expected, abs=1.01)


def test_what_only_meets_or_coincides_changes_no_order() -> None:
    rising = line(0, 0, SIDE, SIDE)
    assert heights_of(rising, rising) == []
    assert heights_of(rising, rising[::-1].copy()) == []
    assert heights_of(rising, line(100, 0, SIDE, SIDE - 100)) == [], "parallel"
    assert heights_of(line(0, 0, 500, 1000), line(0, 1000, 500, 2000)) == [], "one above the other"
    assert heights_of(rising, line(0, 0, SIDE / 2, SIDE)) == [], "from one point"


def test_a_curve_crosses_its_chord_where_it_does_by_hand() -> None:
    bend = np.array([[0.0, 0.0], [20000.0, 0.0], [SIDE - 17000.0, SIDE], [SIDE, SIDE]])
    t = 20 / 37  # where 20000 (1 - t) = 17000 t
    assert heights_of(bend, line(0, 0, SIDE, SIDE)) == pytest.approx([SIDE * (3 - 2 * t) * t * t], abs=1)


@pytest.mark.parametrize("bulge", [100.0, 9000.0, 20000.0])
def test_a_curve_symmetric_about_its_chord_crosses_it_in_the_middle(bulge: float) -> None:
    bend = np.array([[0.0, 0.0], [bulge, 0.0], [SIDE - bulge, SIDE], [SIDE, SIDE]])
    assert SIDE / 2 in heights_of(bend, line(0, 0, SIDE, SIDE))


@pytest.mark.parametrize("split", [None, "faces"])
def test_both_lobes_between_an_s_and_its_chord_are_filled(split: str | None) -> None:
    source = b'<svg viewBox="0 0 16 16"><path d="M1 15C5 15 3 9 7 9Z"/></svg>'
    drawing = vexture.read(source)
    covered = vexture.convert(drawing, split=split).coverage(64)
    np.testing.assert_allclose(covered, render_exact(drawing, (64, 64)), atol=2 / 255)
