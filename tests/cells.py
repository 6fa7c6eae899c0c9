"""Cells of a packed texture under the pixels of a picture, as Python reads them: the oracle of what viewers show."""

import numpy as np
from numpy.typing import NDArray

from vexture.texture.texture import Texture
from vexture.texture.walk import walk

FADED = 4.0  # pixels: borders of cells up to this size are not drawn, from twice that on they are


class Cells:
    """The cell at the centre of each pixel, no deeper than a level.

    Attributes: `points`, `inside` the unit square, `depth`, `coverage` as it is stored, or of a planar map `mean`, the
    mean colour; `is_quad`; `border`, the share
    of the pixel that a border of one pixel's width takes; `clear`: inside, and not so near to a border that rounding
    decides which cell it is.
    """

    def __init__(
        self, texture: Texture, matrix: NDArray[np.float64], size: tuple[int, int], finest: int, root: int = 0
    ) -> None:
        x, y = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
        self.points = np.stack([x, y, np.ones_like(x)], axis=-1) @ matrix[:2].T
        self.inside = ((self.points >= 0.0) & (self.points < 1.0)).all(axis=-1)
        self.depth, self.coverage = np.zeros(x.shape, int), np.zeros(x.shape)
        self.is_quad = self.inside.copy()
        self.border = self._border_of(1.0, matrix)
        self.clear = self.inside.copy()
        self.mean = np.zeros((*x.shape, 4))
        quad = np.zeros(x.shape, np.int64)
        flat, shape = texture.flat, texture.roots[root]
        for level in walk(flat, np.array([shape.quad]), shape.is_map)[:finest]:
            side = 0.5 ** (self.depth.max() + 1)
            k = (np.floor(self.points / side).astype(np.int64) & 1) @ [1, 2]
            now = self.is_quad
            k, at = k[now], quad[now]
            self.depth[now] += 1
            self.coverage[now] = level.coverages[at, k] / 255
            if shape.is_map:
                place = level.quads[at] - shape.quad  # four quads have their base paints in one texel
                words = flat[flat[shape.quad - 1, 1] + 1 + place + place // 4, k]
                self.mean[now] = (words[:, None] >> np.array([0, 8, 16, 24], np.uint32) & 255) / 255
            self.border[now] = np.maximum(self.border, self._border_of(side, matrix))[now]
            self.clear &= ~now | (self._distance(side, matrix) > 1e-3)
            before = np.cumsum(level.is_quad.ravel()) - 1
            quad[now] = before[at * 4 + k]
            self.is_quad[now] = level.is_quad[at, k]

    def _border_of(self, side: float, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
        pixel = abs(matrix[0, 0])
        distance = self._distance(side, matrix)
        border: NDArray[np.float64] = np.clip(1.0 - distance, 0.0, 1.0) * np.clip(side / pixel / FADED - 1.0, 0.0, 1.0)
        return border

    def _distance(self, side: float, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
        way = self.points - side * np.round(self.points / side)
        distance: NDArray[np.float64] = np.abs(way).min(axis=-1) / abs(matrix[0, 0])
        return distance


def finest_level(matrix: NDArray[np.float64], cutoff: float = 0.0) -> int:
    """Level of cells no larger than a pixel, or than 2^cutoff pixels."""
    return max(1, int(np.ceil(-np.log2(abs(matrix[0, 0])) - cutoff)))
