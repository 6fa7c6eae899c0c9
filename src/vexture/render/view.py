"""Views: matrices from pixel coordinates to the unit square."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["check_size", "fit", "view_matrix"]


def check_size(size: tuple[int, int]) -> tuple[int, int]:
    """Width and height."""
    return int(size[0]), int(size[1])


def fit(size: tuple[int, int]) -> NDArray[np.float64]:
    """View of the whole unit square, centred, (3, 3)."""
    width, height = size
    pixel = 1.0 / min(width, height)
    return np.array([[pixel, 0, 0.5 - pixel * width / 2], [0, -pixel, 0.5 + pixel * height / 2], [0, 0, 1.0]])


def view_matrix(to_unit: ArrayLike | None, size: tuple[int, int]) -> NDArray[np.float64]:
    """Check a view that a caller gave, (3, 3)."""
    if to_unit is None:
        return fit(size)
    matrix = np.array(to_unit, np.float64)
    return matrix if len(matrix) == 3 else np.vstack([matrix, (0, 0, 1)])
