"""Faces with gradients, integrated over pixels."""

import pytest
from exact_shapes import circle
from test_exact_gradients import box, colour_of, full

from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact_colours
from vexture.renderers.view import window

LEVEL = 1 / 255
PROMISE = 0.1 * LEVEL
PIXEL = (1, 1)
BLACK, WHITE, RED = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (1.0, 0.0, 0.0)
ACROSS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def test_what_is_covered_changes_nothing():
    hidden, flat = full(ACROSS), box(0.0, 0.0, 1.0, 1.0, Paint((0.2, 0.4, 0.6)))
    disc = Path((circle(),), paint=Paint(RED, 0.5))
    images = [render_exact_colours(Drawing((*below, flat, disc)), 9) for below in ((), (hidden,))]
    assert (images[0] == images[1]).all()


def test_a_shape_beyond_the_sides_of_the_image():
    view = window(0.31, 0.42, 0.2, 0.2).matrix(PIXEL)
    assert colour_of(full(ACROSS), view=view)[0] == pytest.approx(0.41, abs=PROMISE / 10)
