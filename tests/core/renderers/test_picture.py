"""Layers painted on one another."""

import numpy as np

from vexture.drawing.paint import Paint
from vexture.renderers.picture import composite_pictures, paint_layer


def test_a_translucent_layer_darkens_the_one_below() -> None:
    full = np.ones((1, 1), np.float32)
    picture = composite_pictures(
        (1, 1), [paint_layer(Paint((1.0, 0.0, 0.0)), full), paint_layer(Paint(opacity=0.25), full)]
    )
    np.testing.assert_allclose(picture, [[(0.75, 0.0, 0.0, 1.0)]])
    assert picture.dtype == np.float32
