"""Texels as arrays: in the rows of an image, and curves as points."""

import numpy as np
from numpy.typing import NDArray

from vexture import layout

__all__ = ["curve_points", "texel_rows"]


def texel_rows(texels: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Texels in rows, the last one filled up with zeros."""
    width = min(1 << (len(texels) - 1).bit_length(), 1 << layout.ROW_BITS)
    rows = -(-len(texels) // width)
    out = np.zeros((rows * width, 4), np.uint32)
    out[: len(texels)] = texels
    return out.reshape(rows, width, 4)


def curve_points(texels: NDArray[np.uint32]) -> NDArray[np.int32]:
    """Points of curves in lattice units of their leaf, (n, 4) -> (n, 4, 2)."""
    mask = (1 << layout.COORDINATE_BITS) - 1
    points = np.stack([texels & mask, texels >> layout.COORDINATE_BITS], axis=2).astype(np.int32)
    points[:, 1:3] -= layout.CONTROL_OFFSET
    return points
