"""Views: matrices from pixel coordinates to the unit square, shared by every renderer.

Pixel coordinates have x to the right and y **down**, the corner of pixel (0, 0) at the origin and centres at +0.5.
A view is the 3x3 matrix N that takes them to the unit square, y **up**: (u, v) = (N0, N1)/N2 of (x, y, 1).
Pixels where N2 is not positive lie beyond the horizon and see nothing.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.errors import LimitError

__all__ = ["CONDITION_LIMIT", "SIZE_LIMIT", "check_size", "fit", "view_matrix", "window"]

SIZE_LIMIT: Final = 16384
"""Pixels; longest side of an image, which is also what GPUs allow."""

HOMOGENEOUS_RANGE: Final = 20
"""Powers of two; a view whose largest entry is outside is scaled."""

CONDITION_LIMIT: Final = 1e8
"""Largest condition number of the map from the whole image to the unit square: a singular map lies beyond, and so does
a magnification that leaves float64 too few bits for 1e-4 pixel."""


def check_size(size: tuple[int, int]) -> tuple[int, int]:
    """Width and height of an image, as integers in 1..`SIZE_LIMIT`.

    Raises
    ------
    LimitError
        If there are not two integers in that range.

    Examples
    --------
    >>> check_size((640, 480))
    (640, 480)
    """
    try:
        width, height = size
        whole = int(width) == width and int(height) == height
    except (TypeError, ValueError, OverflowError):
        raise LimitError(f"size is {size!r}; give (width, height), two integers in 1..{SIZE_LIMIT}") from None
    if not whole or not (1 <= width <= SIZE_LIMIT and 1 <= height <= SIZE_LIMIT):
        raise LimitError(f"size is {width} x {height}; both must be integers in 1..{SIZE_LIMIT}")
    return int(width), int(height)


def window(size: tuple[int, int], x: float, y: float, w: float, h: float, rotate: float = 0.0) -> NDArray[np.float64]:
    """View of a rectangle of the unit square, centred in the image at the largest size that fits.

    Parameters
    ----------
    size : tuple of int
        Width and height of the image in pixels.
    x, y : float
        Lower left corner of the rectangle, unit-square units, y up.
    w, h : float
        Its width and height, unit-square units, above 0.
    rotate : float
        Degrees by which the picture is turned counter-clockwise about the rectangle's centre.

    Returns
    -------
    (3, 3) float64 array
        From pixel coordinates to the unit square.

    Raises
    ------
    LimitError
        If the size, a number or the magnification is out of range.

    Examples
    --------
    >>> corner = np.array([0, 100, 1])  # lower left, in pixels
    >>> (window((100, 100), 0.5, 0.25, 0.5, 0.5) @ corner).tolist()
    [0.5, 0.25, 1.0]
    """
    width, height = check_size(size)
    if not all(map(math.isfinite, (x, y, w, h, rotate))) or w <= 0.0 or h <= 0.0:
        raise LimitError(
            f"view is {x:g},{y:g},{w:g},{h:g} turned by {rotate:g} degrees; all must be finite, W and H above 0"
        )
    pixel = max(w / width, h / height)
    cosine, sine = pixel * math.cos(math.radians(rotate)), pixel * math.sin(math.radians(rotate))
    # the picture turns one way, so the pixel looks up its point the other way; pixel y points down
    matrix = np.array([[cosine, -sine, x + w / 2], [-sine, -cosine, y + h / 2], [0.0, 0.0, 1.0]])
    matrix[:2, 2] -= matrix[:2, :2] @ (width / 2, height / 2)
    return view_matrix(matrix, size)


def fit(size: tuple[int, int]) -> NDArray[np.float64]:
    """View of the whole unit square, centred in the image at the largest size that fits, (3, 3).

    Raises
    ------
    LimitError
        If the size is out of range.

    Examples
    --------
    >>> fit((4, 4))
    array([[ 0.25,  0.  ,  0.  ],
           [ 0.  , -0.25,  1.  ],
           [ 0.  ,  0.  ,  1.  ]])
    """
    return window(size, 0.0, 0.0, 1.0, 1.0) + 0.0  # no negative zeros


def view_matrix(to_unit: ArrayLike | None, size: tuple[int, int]) -> NDArray[np.float64]:
    """Check a view that a caller gave.

    Parameters
    ----------
    to_unit : (2, 3) or (3, 3) array, or None
        From pixel coordinates to the unit square, affine or projective; None fits the square into the image.
    size : tuple of int
        Width and height of the image in pixels.

    Returns
    -------
    (3, 3) float64 array
        The same map.

    Raises
    ------
    LimitError
        If the matrix is of another shape, not finite, singular, looks away from the unit square's plane, or
        magnifies more than float64 can resolve.

    Examples
    --------
    >>> view_matrix([[0.5, 0, 0], [0, -0.5, 1]], (2, 2))[2]
    array([0., 0., 1.])
    """
    width, height = check_size(size)
    if to_unit is None:
        return fit(size)
    try:
        matrix = np.array(to_unit, dtype=np.float64)
    except (TypeError, ValueError):
        raise LimitError("to_unit is not a matrix of numbers; give 2x3 or 3x3") from None
    if matrix.shape == (2, 3):
        matrix = np.vstack([matrix, (0.0, 0.0, 1.0)])
    if matrix.shape != (3, 3):
        raise LimitError(f"to_unit has the shape {matrix.shape}; it must be 2x3 (affine) or 3x3 (projective)")
    if not np.isfinite(matrix).all():
        raise LimitError("to_unit holds a number that is not finite; give finite numbers")
    scale = np.frexp(np.abs(matrix).max())[1]
    if abs(scale) > HOMOGENEOUS_RANGE:  # a homogeneous matrix may have any scale, but a shader's floats have not
        matrix = np.ldexp(matrix, -scale)
    corners = np.array([[0, width, 0, width], [0, 0, height, height], [1, 1, 1, 1]])
    condition = np.linalg.cond(matrix * (width, height, 1.0))
    if not condition <= CONDITION_LIMIT:
        raise LimitError(
            f"to_unit is singular or too far from the square: condition number {condition:.1e}, "
            f"the limit is {CONDITION_LIMIT:.0e}; give a larger or nearer view"
        )
    if (matrix[2] @ corners).max() <= 0.0:
        raise LimitError("to_unit's third row is negative in the whole image; change the sign of the matrix")
    return matrix
