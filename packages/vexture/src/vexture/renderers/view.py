"""Views: matrices from pixel coordinates to the unit square, for every renderer.

In pixel coordinates, x points right and y **down**; the origin is a corner of pixel (0, 0), whose centre is (0.5, 0.5).
A view is a 3x3 matrix N to the unit square, in which y points **up**: (u, v) = (N0, N1)/N2 of (x, y, 1).
Pixels where N2 is not positive lie beyond the horizon and show nothing.
"""

import math
from dataclasses import dataclass
from typing import Final, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.base.errors import ParameterError

SIZE_LIMIT: Final = 16384
"""Longest side of an image in pixels; a usual limit of GPUs."""

HOMOGENEOUS_RANGE: Final = 20
"""Largest binary exponent, positive or negative, of a view's largest entry; beyond it, the view is rescaled."""

CONDITION_LIMIT: Final = 1e8
"""Largest condition number of the map from the image to the unit square. The limit excludes singular maps, and
magnifications at which float64 cannot resolve 1e-4 pixels."""

Size: TypeAlias = int | tuple[int, int]
"""Width and height of an image in pixels, or the side of a square image."""


class View(Protocol):
    """Part of the plane that an image of any size shows."""

    def matrix(self, size: tuple[int, int]) -> NDArray[np.float64]:
        """Matrix (3, 3) from pixel coordinates of an image with this size to the unit square."""


ViewLike: TypeAlias = ArrayLike | View | None
"""A matrix, (2, 3) or (3, 3), a `View`, or None, which fits the unit square into the image."""


def size_of(size: Size) -> tuple[int, int]:
    """Check a size; return width and height, integers in 1..`SIZE_LIMIT`, or raise a `ParameterError`."""
    try:
        width, height = (size, size) if isinstance(size, int | np.integer) else size
        whole = all(int(side) == side and not isinstance(side, bool) for side in (width, height))
    except (TypeError, ValueError, OverflowError):
        raise ParameterError(f"`size` is {size!r}; give (width, height), two integers in 1..{SIZE_LIMIT}") from None
    if not whole or not (1 <= width <= SIZE_LIMIT and 1 <= height <= SIZE_LIMIT):
        raise ParameterError(f"`size` is {width} x {height}; both must be integers in 1..{SIZE_LIMIT}")
    return int(width), int(height)


@dataclass(frozen=True, slots=True)
class ViewWindow:
    """A rectangle of the unit square, centred in the image at the largest size that fits; see `window`."""

    x: float
    y: float
    w: float
    h: float
    rotate: float = 0.0

    def __post_init__(self) -> None:
        x, y, w, h, rotate = self.x, self.y, self.w, self.h, self.rotate
        if not all(map(math.isfinite, (x, y, w, h, rotate))) or w <= 0.0 or h <= 0.0:
            raise ParameterError(
                f"`view` is {x:g},{y:g},{w:g},{h:g} turned by {rotate:g} degrees; all must be finite, w and h above 0"
            )
        self.matrix((1, 1))  # raises an error for numbers that no image can resolve

    def matrix(self, size: tuple[int, int]) -> NDArray[np.float64]:
        """Matrix (3, 3) from pixel coordinates of an image with this size to the unit square."""
        width, height = size_of(size)
        pixel = max(self.w / width, self.h / height)
        angle = math.radians(self.rotate)
        cosine, sine = pixel * math.cos(angle), pixel * math.sin(angle)
        # pixels map to points by the inverse of the picture's rotation; pixel y points down
        matrix = np.array(
            [[cosine, -sine, self.x + self.w / 2], [-sine, -cosine, self.y + self.h / 2], [0.0, 0.0, 1.0]]
        )
        matrix[:2, 2] -= matrix[:2, :2] @ (width / 2, height / 2)
        return view_matrix(matrix, size)


def window(x: float, y: float, w: float, h: float, rotate: float = 0.0) -> ViewWindow:
    """View of a rectangle of the unit square, for images of any size: centred, at the largest size that fits.

    Parameters
    ----------
    x, y : float
        Lower left corner of the rectangle, unit-square units, y up.
    w, h : float
        Its width and height, unit-square units, above 0.
    rotate : float
        Rotation of the picture about the rectangle's centre, counter-clockwise, in degrees.

    Returns
    -------
    Window
        For the parameter `view`.

    Raises
    ------
    ParameterError
        If a number is not finite, `w` or `h` is not above 0, or the view is too small, large or far from the square.

    Examples
    --------
    >>> lower_left = np.array([0, 100, 1])  # in pixels
    >>> (window(0.5, 0.25, 0.5, 0.5).matrix((100, 100)) @ lower_left).tolist()
    [0.5, 0.25, 1.0]
    """
    return ViewWindow(x, y, w, h, rotate)


def fit(size: Size) -> NDArray[np.float64]:
    """View of the whole unit square, centred in the image at the largest size that fits, (3, 3)."""
    return view_matrix(ViewWindow(0.0, 0.0, 1.0, 1.0), size) + 0.0  # no negative zeros


def view_matrix(view: ViewLike, size: Size) -> NDArray[np.float64]:
    """Check a caller's view of an image; return its matrix, (3, 3) float64.

    A view is affine, (2, 3), or projective, (3, 3); None fits the square into the image. Raises a `ParameterError` if
    the matrix has another shape, is not finite, is singular, looks away from the unit square's plane, or magnifies more
    than float64 can resolve.
    """
    width, height = size_of(size)
    if view is None:
        return fit((width, height))
    entries = view.matrix((width, height)) if hasattr(view, "matrix") else view
    try:
        matrix = np.array(entries, dtype=np.float64)
    except (TypeError, ValueError):
        raise ParameterError("`view` is not a matrix of numbers; give 2x3 or 3x3") from None
    if matrix.shape == (2, 3):
        matrix = np.vstack([matrix, (0.0, 0.0, 1.0)])
    if matrix.shape != (3, 3):
        raise ParameterError(f"`view` has the shape {matrix.shape}; it must be 2x3 (affine) or 3x3 (projective)")
    if not np.isfinite(matrix).all():
        raise ParameterError("`view` holds a number that is not finite; give finite numbers")
    scale = np.frexp(np.abs(matrix).max())[1]
    if abs(scale) > HOMOGENEOUS_RANGE:  # a homogeneous matrix may have any scale, but not in a shader's floats
        matrix = np.ldexp(matrix, -scale)
    corners = np.array([[0, width, 0, width], [0, 0, height, height], [1, 1, 1, 1]])
    condition = np.linalg.cond(matrix * (width, height, 1.0))
    if not condition <= CONDITION_LIMIT:
        raise ParameterError(
            f"`view` is singular, or too small, large or far from the square: condition number {condition:.1e}, "
            f"the limit is {CONDITION_LIMIT:.0e}; give one nearer to the unit square"
        )
    if (matrix[2] @ corners).max() <= 0.0:
        raise ParameterError("the third row of `view` is negative in the whole image; change the sign of the matrix")
    return matrix


def view_base(matrix: NDArray[np.float64], size: tuple[int, int]) -> tuple[int, int]:
    """Point of the unit square nearest to the image's centre, as 32-bit fixed-point numbers.

    In a magnified view, offsets from this point are small, so that float32 resolves the pixels.
    """
    u, v, w = matrix @ (size[0] / 2, size[1] / 2, 1.0)
    if w <= 0.0:
        return 0, 0
    scaled = np.clip(np.array([u, v]) / w, 0.0, 1.0) * 2.0**32
    return int(min(scaled[0], 2.0**32 - 1)), int(min(scaled[1], 2.0**32 - 1))
