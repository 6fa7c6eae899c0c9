"""Pictures from which the page reads the depth at the pointer: depths, or classes of them."""

from io import BytesIO
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.extent import DepthClasses

PIXELS: Final = 256
"""Most pixels on the longer side: the picture serves to read a depth at the pointer, not to draw."""

SCALE: Final = 50.0
"""Metres. Steps between two depths are even in much shallower water, and a share of the depth in much deeper water."""

STEP: Final = 1e-4
"""Of the numbers in a picture: 5 mm where it is shallow, a ten-thousandth of the depth where it is deep.

A sea of 12 km ends at 61,738, so that all depths have 16 bits.
"""

CODE: Final = {"scale": SCALE, "step": STEP}
"""The facts to read a picture of depths: a depth is `scale` times the hyperbolic sine of its number times `step`."""


def deepest(depth: NDArray[np.float32]) -> float:
    """Greatest depth in metres, 0 if all is dry or unknown."""
    known = depth[np.isfinite(depth)]
    return max(0.0, float(known.max())) if known.size else 0.0


def depth_png(depth: NDArray[np.float32]) -> bytes:
    """Depths in metres as a 16-bit gray PNG, which `CODE` reads: 0 is dry or unknown, and wet pixels are at least 1."""
    metres = _thin_grid(np.where(np.isfinite(depth), np.maximum(depth, 0.0), 0.0).astype(np.float64))
    numbers = np.rint(np.arcsinh(metres / SCALE) / STEP)
    return _png(np.where(metres > 0.0, np.clip(numbers, 1.0, 65535.0), 0.0).astype(np.uint16))


def ranks_png(classes: DepthClasses) -> bytes:
    """Ranks of classes of depth as an 8-bit gray PNG: 0 is dry or unknown."""
    return _png(_thin_grid(classes.ranks))


def ranges_as_json(classes: DepthClasses) -> list[list[float | None]]:
    """Metres from which each class begins and at which it ends, which is null if it has no end."""
    return [[low, high if np.isfinite(high) else None] for low, high in classes.ranges]


def _thin_grid(grid: NDArray[Any]) -> NDArray[Any]:
    """Every second, third or further sample of a grid that is too large."""
    stride = -(-max(grid.shape) // PIXELS)
    return np.ascontiguousarray(grid[stride // 2 :: stride, stride // 2 :: stride])


def _png(pixels: NDArray[Any]) -> bytes:
    from PIL import Image

    out = BytesIO()
    Image.fromarray(pixels).save(out, format="PNG", optimize=True)
    return out.getvalue()
