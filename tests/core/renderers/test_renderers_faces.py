"""Faces of the exact renderer, of which so many are kept."""

import numpy as np
from test_exact_colours import box, max_difference

from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact_colours
from vexture.renderers.faces import KEPT


def test_more_faces_than_are_kept():
    """Bars of smoke, upright and level ones, each from its place to the far side: a face for every pair of numbers."""
    count, thin = 280, 0.01
    assert count**2 > KEPT
    upright = tuple(box(k / count, 0.0, 1.0, 1.0, Paint(opacity=thin)) for k in range(count))
    level = tuple(box(0.0, 0.0, 1.0, 1.0 - k / count, Paint(opacity=thin)) for k in range(count))
    twice_as_high = [[1 / count, 0, 0], [0, -0.5 / count, 1]]
    image = render_exact_colours(Drawing(upright + level), (count, 2 * count), twice_as_high)
    columns, rows = np.arange(1, count + 1), np.arange(2, 2 * count + 2) // 2
    assert max_difference(image[..., 3], 1.0 - (1.0 - thin) ** (columns + rows[:, None])) < 1e-6
