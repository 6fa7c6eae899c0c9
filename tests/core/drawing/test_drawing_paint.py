"""Paints: flat colours and gradients, in other coordinates, faded, and as CSS writes them."""

import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture.drawing.paint import Gradient, Paint, Stop

RED, BLUE = Stop(0.0, (1.0, 0.0, 0.0)), Stop(1.0, (0.0, 0.0, 1.0), 0.5)
TURNED = ((0.0, 2.0, 1.0), (-3.0, 0.0, 4.0))
LINEAR = Gradient(TURNED, (RED, BLUE))


@pytest.mark.parametrize(
    ("paint", "text"),
    [
        (Paint(), "#000000"),
        (Paint((1.0, 0.5, 0.0)), "#ff8000"),
        (Paint((0.2, 0.4, 0.6), 0.8), "#336699cc"),
        (Paint(opacity=0.0), "#00000000"),
    ],
)
def test_a_paint_as_css_writes_it(paint: Paint, text: str) -> None:
    assert paint.hex == text


def test_other_coordinates_are_those_of_a_product_of_matrices() -> None:
    matrix = ((1.5, 0.25, -2.0), (0.5, 3.0, 7.0))
    expected = np.vstack([TURNED, (0, 0, 1)]) @ np.vstack([matrix, (0, 0, 1)])
    found = Paint.from_gradient(LINEAR).after(matrix).gradient
    assert found is not None
    np.testing.assert_allclose(found.to_ramp, expected[:2])
    assert found.stops == LINEAR.stops
    flat = Paint((1.0, 0.0, 0.0))
    assert flat.after(matrix) is flat


def test_a_faded_paint_has_the_product_of_opacities() -> None:
    paint = Paint.from_gradient(LINEAR)
    faded = paint.fade(0.5)
    assert paint.opacity == 0.75
    assert faded.opacity == 0.375
    assert faded.color == paint.color == (0.5, 0.0, 0.5)
    assert faded.gradient is not None
    assert [stop.opacity for stop in faded.gradient.stops] == [0.5, 0.25]
    assert paint.fade(1.0) is paint


def test_only_what_shows_nothing_below_is_opaque() -> None:
    whole = (RED, Stop(1.0, (0.0, 0.0, 1.0)))
    assert Paint().is_opaque
    assert not Paint(opacity=0.999).is_opaque
    assert Paint.from_gradient(Gradient(TURNED, whole)).is_opaque
    assert not Paint.from_gradient(LINEAR).is_opaque
    assert Paint.from_gradient(Gradient(TURNED, whole, focus=(0.5, 0.25))).is_opaque
    assert not Paint.from_gradient(Gradient(TURNED, whole, focus=(0.75, 0.25))).is_opaque, "a cone has sides"


def test_numbers_out_of_range_are_refused() -> None:
    with pytest.raises(SourceError, match=r"a stop is at 1\.5"):
        Stop(1.5, (0.0, 0.0, 0.0))
    with pytest.raises(SourceError, match="a paint is"):
        Paint((0.0, -0.1, 0.0))
    with pytest.raises(SourceError, match=r"has stops at \[1.0, 0.0\]; it needs one or more, in order"):
        Gradient(TURNED, (BLUE, RED))
    with pytest.raises(SourceError, match="it needs one or more"):
        Gradient(TURNED, ())
    for to_ramp, focus in ((((1.0, 0.0, np.inf), (0.0, 1.0, 0.0)), None), (TURNED, (-0.1, 0.0))):
        with pytest.raises(SourceError, match="all must be finite"):
            Gradient(to_ramp, (RED, BLUE), focus=focus)
