"""The colour of a gradient at a point, as SVG says."""

import numpy as np
import pytest

from gradient_drawings import (
    WARM,
)
from planar import gradient_colours
from vexture.drawing.paint import Gradient, Spread
from vexture.tree.planar.shades import shade_at, shades_of


@pytest.mark.parametrize("spread", Spread)
@pytest.mark.parametrize(
    "focus", [None, (0.0, 0.0), (0.4, 0.0), (0.3, 0.5), (1.5, 0.2), (0.5, 0.5), (0.2, 1.4), (0.0, 1.0)]
)
def test_a_gradient_is_what_svg_says(focus: tuple[float, float] | None, spread: Spread) -> None:
    points = np.random.default_rng(1).random((300, 2))
    gradient = Gradient(((2.0, 0.5, -1.1), (-0.4, 3.0, -1.2)), WARM, spread, focus)
    shades, found = shades_of([gradient]), np.empty((len(points), 4))
    for point, out in zip(points, found, strict=True):
        shade_at(shades, 0, *point.tolist(), out)
    np.testing.assert_allclose(found, gradient_colours(gradient, points), atol=1e-9)
