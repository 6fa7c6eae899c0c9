"""The figure of a traced picture: its parts are enlarged about one corner."""

import numpy as np
import pytest

from vexture.drawing.drawing import Drawing
from vexture_evidence.figures.tracing import PIXELS, tracing

SIDE = 32
SQUARE = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])


@pytest.mark.parametrize("true", [None, SQUARE])
def test_the_enlarged_part_is_about_a_corner(true):
    image = np.zeros((SIDE, SIDE), np.float32)
    image[8:24, 8:24] = 1.0
    figure = tracing(image, SQUARE, true)
    whole, traced, texture, part = figure.axes
    assert np.array_equal(whole.images[0].get_array(), image)
    for panel in (traced, part):
        (west, east), (south, north) = panel.get_xlim(), panel.get_ylim()
        assert east - west == pytest.approx(PIXELS / SIDE)
        assert {(west + east) / 2, (south + north) / 2} <= {0.25, 0.75}
    assert traced.get_xlim() == pytest.approx(part.get_xlim())
    assert len(traced.lines) == (1 if true is None else 2)
    drawn = part.images[0].get_array()
    assert drawn.mean() == pytest.approx(0.25, abs=0.01)  # a quarter of it is inside
    assert texture.images[0].get_array().mean() == pytest.approx(0.25, abs=1e-3)
