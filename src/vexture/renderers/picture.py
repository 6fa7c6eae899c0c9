"""Composites layers in their colours into one picture."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Paint

__all__ = ["painted"]


def painted(size: tuple[int, int], layers: Iterable[tuple[Paint, NDArray[np.float32]]]) -> NDArray[np.float32]:
    """Composite flat colours one over the other, the lowest first, as SVG does: source-over in sRGB.

    `size` is (width, height); each coverage is a (height, width) float32 array. The picture is (height, width, 4)
    float32, premultiplied RGBA, 0..1.
    """
    width, height = size
    picture = np.zeros((height, width, 4), np.float32)
    for paint, covered in layers:
        alpha = covered[..., None] * np.float32(paint.opacity)
        picture *= 1.0 - alpha
        picture += alpha * np.array((*paint.color, 1.0), np.float32)
    return picture
