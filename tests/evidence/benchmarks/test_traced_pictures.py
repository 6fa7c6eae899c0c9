"""The benchmark of traced pictures: its measure is right where the answer is known."""

import numpy as np
import pytest

import tracing


def test_pixels_of_a_drawing_come_back_as_they_are() -> None:
    figures, back = tracing.measure_tracing(tracing.art())
    assert figures["error"] < 0.01
    assert figures["far off"] == 0.0
    assert back is not None
    np.testing.assert_allclose(back, tracing.premultiply(tracing.art()), atol=0.05)


@pytest.mark.parametrize("name", tracing.PICTURES)
def test_pictures_are_small_and_have_their_opacity(name: str) -> None:
    pixels = tracing.PICTURES[name]()
    assert (pixels.dtype, pixels.ndim, pixels.shape[2]) == (np.uint8, 3, 4)
    assert max(pixels.shape) <= 320


def test_colours_that_are_premultiplied_come_back() -> None:
    pixels = tracing.of_svg(tracing.LOGO, (120, 80), 120)
    again = tracing.unpremultiply(tracing.premultiply(pixels))
    assert (again[pixels[..., 3] > 0] == pixels[pixels[..., 3] > 0]).all()
