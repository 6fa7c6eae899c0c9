"""Where water gets to: the highest sill on the lowest way to each place."""

import heapq
from collections.abc import Iterable

import numpy as np

from .grid import Array

Place = tuple[int, int]


def thresholds(bed: Array, sources: Iterable[Place]) -> Array:
    """For each cell the level at which water from any of the sources reaches it, over edges of cells."""
    rows, columns = bed.shape
    heights = bed.tolist()
    reached = np.full(bed.shape, np.inf)
    heap = [(heights[r][c], r, c) for r, c in sources]
    while heap:
        level, r, c = heapq.heappop(heap)
        if level < reached[r, c]:
            reached[r, c] = level
            for i, j in ((r - 1, c), (r + 1, c), (r, c - 1), (r, c + 1)):
                if 0 <= i < rows and 0 <= j < columns and reached[i, j] == np.inf:
                    heapq.heappush(heap, (max(level, heights[i][j]), i, j))
    return reached
