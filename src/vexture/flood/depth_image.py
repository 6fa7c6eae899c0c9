"""Depths as a small gray picture."""

from io import BytesIO
from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["deepest", "depth_png"]

LONGEST: Final = 256
"""Pixels on the longer side, at most: what is read out under a pointer, not the shoreline."""


def deepest(depth: NDArray[np.float32]) -> float:
    """Greatest depth in metres, 0 if all is dry or unknown.

    Examples
    --------
    >>> deepest(np.array([[np.nan, 1.5]], np.float32))
    1.5
    """
    known = depth[np.isfinite(depth)]
    return max(0.0, float(known.max())) if known.size else 0.0


def depth_png(depth: NDArray[np.float32], most: float) -> bytes:
    r"""Depths as an 8-bit gray PNG: 255 is `most`, 0 is dry or unknown, and what is wet is at least 1.

    Parameters
    ----------
    depth : (rows, columns) float32 array
        Metres, the northernmost row first; larger ones are scaled down.
    most : float
        Metres, from `deepest`.

    Examples
    --------
    >>> depth_png(np.array([[np.nan, 1.5]], np.float32), 1.5)[:4]
    b'\x89PNG'
    """
    from PIL import Image

    metres = np.where(np.isfinite(depth), np.maximum(depth, 0.0), 0.0).astype(np.float32)
    share = LONGEST / max(metres.shape)
    picture = Image.fromarray(metres)
    if share < 1.0:
        width, height = (max(1, round(share * side)) for side in picture.size)
        picture = picture.resize((width, height), Image.Resampling.BOX)
    metres = np.asarray(picture)
    values = np.rint(255.0 * metres / most if most > 0.0 else metres * 0.0)
    gray = np.where(metres > 0.0, np.clip(values, 1.0, 255.0), 0.0).astype(np.uint8)
    out = BytesIO()
    Image.fromarray(gray).save(out, format="PNG", optimize=True)
    return out.getvalue()
