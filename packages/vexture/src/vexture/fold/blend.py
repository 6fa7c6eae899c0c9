"""The functions of ``shaders/fold.glsl`` on the CPU, in float64, for many points at once.

They have the shader's names without the prefix, as in `vexture.renderers.cpu`, and take its uniforms first. The
shader's comments explain them.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.fold.layout import (
    FOLD_KIND_SHIFT,
    FOLD_PERIODIC,
    FOLD_SMOOTH_BOTH,
    FOLD_SMOOTH_END,
    FOLD_SMOOTH_START,
    FOLD_TICKS,
)

Numbers = NDArray[np.float64]
Words = NDArray[np.uint32]


class Folded(NamedTuple):
    """Points at which the shape is looked up, and the footprints of pixels there."""

    uv: Numbers
    dx: Numbers
    dy: Numbers


def progress(time: float, cycle: float, texel: Words) -> Numbers:
    """Return the fraction of its displacement that each texel, (..., 4) words, has at a time."""
    kind = texel[..., 2] >> np.uint32(FOLD_KIND_SHIFT)
    since = time - (texel[..., 2] & np.uint32((1 << FOLD_KIND_SHIFT) - 1)) / FOLD_TICKS
    if cycle > 0.0:
        since = since - cycle * np.floor(since / cycle)
    part = np.maximum(since / (texel[..., 3] / FOLD_TICKS), 0.0)
    x = np.minimum(part, 1.0)
    return np.select(
        [kind == FOLD_PERIODIC, kind == FOLD_SMOOTH_BOTH, kind == FOLD_SMOOTH_START, kind == FOLD_SMOOTH_END],
        [np.sin(2.0 * np.pi * (part - np.floor(part))), x * x * (3.0 - 2.0 * x), x * x, 1.0 - (1.0 - x) ** 2],
        x,
    )


def fold(now: Numbers, wrap: str, base: NDArray[np.uint32], offset: Numbers, dx: Numbers, dy: Numbers) -> Folded:
    """Displace points and footprints, all (n, 2), by the current displacements of all texels, (rows, columns, 2)."""
    size = np.array([now.shape[1], now.shape[0]])
    near = offset - np.floor(offset) if wrap == "repeat" else np.clip(offset, -2.0, 2.0)
    scaled = base * size / 2.0**32 + near * size  # the shader keeps the two parts apart, because of its float32
    middle = np.floor(scaled).astype(np.int64)
    t = scaled - middle - 0.5
    weights = (0.5 * (0.5 - t) ** 2, 0.75 - t * t, 0.5 * (0.5 + t) ** 2)
    slopes = (t - 0.5, -2.0 * t, t + 0.5)
    moved, along_x, along_y = np.zeros((3, *offset.shape))
    for i in range(3):
        for j in range(3):
            at = middle + np.array([i - 1, j - 1])
            at = (at + size) % size if wrap == "repeat" else np.clip(at, 0, size - 1)
            displaced = now[size[1] - 1 - at[:, 1], at[:, 0]]
            moved += (weights[i][:, 0] * weights[j][:, 1])[:, None] * displaced
            along_x += (slopes[i][:, 0] * weights[j][:, 1])[:, None] * displaced
            along_y += (weights[i][:, 0] * slopes[j][:, 1])[:, None] * displaced
    along_x *= size[0]
    along_y *= size[1]
    right = dx + along_x * dx[:, :1] + along_y * dx[:, 1:]
    up = dy + along_x * dy[:, :1] + along_y * dy[:, 1:]
    return Folded(offset + moved, right, up)
