"""Places of a filter's pixels in user space: coordinates, cover of rectangles, and values between pixels."""

from dataclasses import dataclass
from math import ceil, inf
from typing import Final, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError

Rectangle: TypeAlias = tuple[float, float, float, float]
"""Left, top, right and bottom in user space, whose y axis points down."""

Numbers: TypeAlias = NDArray[np.float64]

Pixels: TypeAlias = Numbers
"""Premultiplied colours and opacity, 0..1, (rows, columns, 4), the top row first."""

EdgeMode: TypeAlias = Literal["none", "duplicate", "wrap"]
"""Values beyond the edges of a picture: transparent, those at the edge, or those of the opposite edge."""

Cover: TypeAlias = tuple[Numbers, Numbers]
"""Parts of rows, and parts of columns, that a rectangle covers."""

EVERYWHERE: Final[Rectangle] = (-inf, -inf, inf, inf)

SMALLEST: Final = 1e-9
LARGEST: Final = 1e12
"""Least and greatest side of a pixel, in user units; its place is less than the latter from 0."""

ROUNDING: Final = 1e-9
"""Part of a pixel that counts as nothing: coordinates that should coincide differ by rounding."""


@dataclass(frozen=True, slots=True)
class PixelFrame:
    """Pixels in user space; their sides are parallel to its axes, and rows follow each other downwards.

    Parameters
    ----------
    left, top : float
        Corner of the first pixel of the first row.
    width, height : float
        Sides of one pixel.
    rows, columns : int
    """

    left: float
    top: float
    width: float
    height: float
    rows: int
    columns: int

    def __post_init__(self) -> None:
        numbers = (self.left, self.top, self.width, self.height)
        is_small = all(abs(number) <= LARGEST for number in numbers)
        if not is_small or min(numbers[2:]) < SMALLEST or min(self.rows, self.columns) < 1:
            raise SourceError(
                f"a filter has {self.columns} x {self.rows} pixels of {self.width:g} x {self.height:g} at "
                f"{self.left:g}, {self.top:g}; use pixels of {SMALLEST:g} to {LARGEST:g}, nearer than {LARGEST:g}"
            )

    @property
    def bounds(self) -> Rectangle:
        """Rectangle of all pixels."""
        return self.left, self.top, self.left + self.columns * self.width, self.top + self.rows * self.height

    @property
    def xs(self) -> Numbers:
        """X coordinates of the middles of the columns."""
        return self.left + self.width * np.arange(0.5, self.columns)

    @property
    def ys(self) -> Numbers:
        """Y coordinates of the middles of the rows."""
        return self.top + self.height * np.arange(0.5, self.rows)

    def cover(self, rectangle: Rectangle) -> Cover:
        """Return the parts of the rows and of the columns that a rectangle covers.

        Examples
        --------
        >>> rows, columns = PixelFrame(0.0, 0.0, 2.0, 1.0, 2, 3).cover((1.0, -9.0, 4.0, 0.25))
        >>> rows.tolist(), columns.tolist()
        ([0.25, 0.0], [0.5, 1.0, 0.0])
        """
        left, top, right, bottom = rectangle
        rows = _covered_parts((top - self.top) / self.height, (bottom - self.top) / self.height, self.rows)
        return rows, _covered_parts((left - self.left) / self.width, (right - self.left) / self.width, self.columns)


def _covered_parts(low: float, high: float, count: int) -> Numbers:
    """Parts of pixels of width 1 that lie between two places."""
    edges = np.arange(count + 1).clip(low, max(low, high))
    parts: Numbers = np.diff(edges).clip(0.0, 1.0)
    parts[parts < ROUNDING] = 0.0
    parts[parts > 1.0 - ROUNDING] = 1.0
    return parts


def intersect_rectangles(a: Rectangle, b: Rectangle) -> Rectangle:
    """Return the common part of two rectangles, which has no extent if there is none.

    Examples
    --------
    >>> intersect_rectangles((0, 0, 4, 4), (2, 5, 6, 8))
    (2, 5, 4, 5)
    """
    left, top = max(a[0], b[0]), max(a[1], b[1])
    return left, top, max(left, min(a[2], b[2])), max(top, min(a[3], b[3]))


def crop(pixels: Pixels, frame: PixelFrame, rectangle: Rectangle) -> Pixels:
    """Clip a picture to a rectangle (9.4); pixels at its border remain in part."""
    rows, columns = frame.cover(rectangle)
    if rows.min() == 1.0 and columns.min() == 1.0:
        return pixels
    return pixels * (rows[:, None] * columns)[..., None]


def fill_border(pixels: Pixels, frame: PixelFrame, cropped: Rectangle, target: Rectangle) -> Pixels:
    """Undo `crop` at those sides that a rectangle shares with another one, to which the result will be cropped.

    Cropped once more, pixels at these sides would fade twice.
    """
    sides = [
        side if abs(side - other) <= ROUNDING * size else border
        for side, other, border, size in zip(cropped, target, EVERYWHERE, (frame.width, frame.height) * 2, strict=True)
    ]
    rows, columns = frame.cover((sides[0], sides[1], sides[2], sides[3]))
    if rows.min() == 1.0 and columns.min() == 1.0:
        return pixels
    cover = rows[:, None] * columns
    return pixels / np.where(cover > 0.0, cover, 1.0)[..., None]


@dataclass(frozen=True, slots=True)
class _Places:
    """Neighbours of places along an axis: first index, second index, and share of the second."""

    low: NDArray[np.intp]
    high: NDArray[np.intp]
    share: Numbers
    low_weight: Numbers  # 0 for a transparent neighbour beyond the edge
    high_weight: Numbers


def _places(positions: Numbers, count: int, edges: tuple[float, float], mode: EdgeMode) -> _Places:
    """Find the neighbours of positions, where a pixel's middle has its index as position.

    `edges` are the positions of the picture's edges, which may cut pixels.
    """
    first, last = max(0, ceil(edges[0] - ROUNDING)), min(count, ceil(edges[1] - ROUNDING)) - 1
    if last < first:  # thinner than a pixel, or beyond the pixels
        first = last = int(np.clip(np.floor(0.5 * (edges[0] + edges[1]) + 0.5), 0, count - 1))
    extent = edges[1] - edges[0]
    if mode == "wrap" and extent > 0.0:
        positions = edges[0] + np.mod(positions - edges[0], extent)
    positions = positions.clip(first - 2.0, last + 2.0)
    rounded = np.rint(positions)
    positions = np.where(np.abs(positions - rounded) < ROUNDING, rounded, positions)
    floor = np.floor(positions)
    low = floor.astype(np.intp)
    high, share = low + 1, positions - floor
    if mode == "wrap":  # between the last and the first middle there may be more or less than a pixel
        seam = max(extent - (last - first), ROUNDING)
        before, after = positions < first, positions > last
        low, high = np.where(before | after, last, low), np.where(before | after, first, high)
        share = np.where(after, (positions - last) / seam, np.where(before, 1.0 + (positions - first) / seam, share))
        share = share.clip(0.0, 1.0)
    visible = [((index >= first) & (index <= last)) | (mode != "none") for index in (low, high)]
    return _Places(low.clip(first, last), high.clip(first, last), share, visible[0] * (1.0 - share), visible[1] * share)


def sample_rows(pixels: Numbers, positions: Numbers, edges: tuple[float, float], mode: EdgeMode) -> Numbers:
    """Return the values of an array between its rows, linearly.

    Parameters
    ----------
    pixels : (rows, ...) array
    positions : (n,) array
        The middle of a row has its index as position.
    edges : (float, float)
        Positions of the upper and lower edges; -1/2 and rows - 1/2 for all rows.
    mode : str
        Values beyond the edges.

    Examples
    --------
    >>> sample_rows(np.array([2.0, 4.0]), np.array([-1.0, -0.5, 0.0, 0.25, 3.0]), (-0.5, 1.5), "none").tolist()
    [0.0, 1.0, 2.0, 2.5, 0.0]
    >>> sample_rows(np.array([2.0, 4.0]), np.array([-1.0, 1.5, 3.0]), (-0.5, 1.5), "wrap").tolist()
    [4.0, 3.0, 4.0]
    """
    places = _places(positions, len(pixels), edges, mode)
    shape = (-1,) + (1,) * (pixels.ndim - 1)
    if not places.share.any():
        if places.low_weight.all():
            return pixels[places.low]
        return pixels[places.low] * places.low_weight.reshape(shape)
    return pixels[places.low] * places.low_weight.reshape(shape) + pixels[places.high] * places.high_weight.reshape(
        shape
    )


def sample_columns(pixels: Numbers, positions: Numbers, edges: tuple[float, float], mode: EdgeMode) -> Numbers:
    """Return the values of an array (rows, columns, ...) between its columns, as `sample_rows` between its rows."""
    return sample_rows(pixels.swapaxes(0, 1), positions, edges, mode).swapaxes(0, 1)


def shift(pixels: Pixels, frame: PixelFrame, dx: float, dy: float) -> Pixels:
    """Move a picture by a vector in user space; fractions of pixels are interpolated (feOffset, 9.18).

    Parameters
    ----------
    pixels : (rows, columns, 4) array
    frame : PixelFrame
    dx, dy : float

    Returns
    -------
    (rows, columns, 4) array
    """
    rows = np.arange(frame.rows) - np.clip(dy / frame.height, -frame.rows - 1.0, frame.rows + 1.0)
    columns = np.arange(frame.columns) - np.clip(dx / frame.width, -frame.columns - 1.0, frame.columns + 1.0)
    moved = sample_rows(pixels, rows, (-0.5, frame.rows - 0.5), "none")
    return sample_columns(moved, columns, (-0.5, frame.columns - 0.5), "none")


def tile(pixels: Pixels, frame: PixelFrame, reference: Rectangle) -> Pixels:
    """Repeat the part of a picture in a rectangle over all pixels (feTile, 9.20).

    The seams of tiles are not antialiased: a pixel has the colour that the tile has in its middle.
    """
    left, top, right, bottom = edge_positions(frame, reference)
    if not (left < right and top < bottom):
        return np.zeros_like(pixels)
    repeated = sample_rows(pixels, np.arange(frame.rows, dtype=np.float64), (top, bottom), "wrap")
    return sample_columns(repeated, np.arange(frame.columns, dtype=np.float64), (left, right), "wrap")


def edge_positions(frame: PixelFrame, rectangle: Rectangle) -> Rectangle:
    """Return the sides of a rectangle in columns and rows, where a pixel's middle has its index as position."""
    left, top, right, bottom = rectangle
    return (
        (left - frame.left) / frame.width - 0.5,
        (top - frame.top) / frame.height - 0.5,
        (right - frame.left) / frame.width - 0.5,
        (bottom - frame.top) / frame.height - 0.5,
    )
