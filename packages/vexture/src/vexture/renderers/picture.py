"""Composite the layers of a drawing to one picture."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.paint import Paint


def paint_layer(paint: Paint, covered: NDArray[np.float32]) -> NDArray[np.float32]:
    """Paint a layer: premultiplied RGBA (height, width, 4) from its colour and coverage (height, width)."""
    alpha = covered[..., None] * np.float32(paint.opacity)
    return alpha * np.array((*paint.color, 1.0), np.float32)


def composite_pictures(size: tuple[int, int], pictures: Iterable[NDArray[np.float32]]) -> NDArray[np.float32]:
    """Composite pictures one over the other, the lowest first, as SVG does: source-over in sRGB.

    `size` is (width, height); the pictures are premultiplied RGBA, (height, width, 4), 0..1, and so is the result.
    """
    width, height = size
    picture = np.zeros((height, width, 4), np.float32)
    for above in pictures:
        picture *= 1.0 - above[..., 3:]
        picture += above
    return picture
