"""Quality of a picture: the numbers that every benchmark reports, always against the exact coverage."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing

LEVELS = 255.0
"""Largest value of an 8-bit picture; errors are given in its steps."""

TRUTH = 0.03 / LEVELS
"""Accuracy of the exact coverage. A pixel within this of 0 counts as empty, and within this of 1 as full."""

TOUCH = 1e-6
"""Pixels. A cell border that enters a pixel by less than this does not count as passing through it."""


class Errors(NamedTuple):
    """Differences from the truth, in 1/255."""

    mae: float
    rmse: float
    max: float


def errors(image: ArrayLike, truth: ArrayLike) -> Errors:
    """Errors over the pixels that the shape touches in the picture or in the truth; 0 if there are none.

    Parameters
    ----------
    image, truth : array
        Coverage, 0..1, of the same shape.

    Examples
    --------
    >>> [round(error, 1) for error in errors([0.0, 0.2, 1.0], [0.0, 0.0, 1.0])]
    [25.5, 36.1, 51.0]
    """
    image, truth = np.asarray(image, np.float64), np.asarray(truth, np.float64)
    off = LEVELS * np.abs(image - truth)[np.maximum(image, truth) > TRUTH]
    if not len(off):
        return Errors(0.0, 0.0, 0.0)
    return Errors(float(off.mean()), float(np.sqrt((off**2).mean())), float(off.max()))


def ink_sd(images: Sequence[ArrayLike], truths: Sequence[ArrayLike]) -> float:
    """Flicker: standard deviation, over shifted views, of a picture's total coverage relative to the exact, in percent.

    Parameters
    ----------
    images, truths : sequence of arrays
        At least four pictures, with different sub-pixel shifts, and their exact coverage (not empty).

    Examples
    --------
    >>> round(ink_sd([[0.9], [1.1]], [[1.0], [1.0]]), 9)
    10.0
    """
    ratios = [
        np.sum(image, dtype=np.float64) / np.sum(truth, dtype=np.float64)
        for image, truth in zip(images, truths, strict=True)
    ]
    return float(100.0 * np.std(ratios))


def outline_distance(drawing: "Drawing", truth: "Drawing", side: int = 1024) -> float:
    """Mean distance of a drawing's outline from the true one: the area between them divided by the true length.

    Parameters
    ----------
    drawing, truth : Drawing
    side : int
        Pixels along a side of the exact pictures from which area and length are measured.

    Returns
    -------
    float
        In unit-square units; NaN if the truth has no outline.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> square = [Drawing.polygon([(a, a), (1 - a, a), (1 - a, 1 - a), (a, 1 - a)]) for a in (0.25, 0.245)]
    >>> round(outline_distance(square[1], square[0]), 3)
    0.005
    """
    from vexture.renderers.exact import render_exact

    found, true = (np.float64(render_exact(shape, (side, side))) for shape in (drawing, truth))
    length = np.hypot(*np.gradient(true)).sum() / side  # coverage falls by 1 across an outline in any direction
    return float(np.abs(found - true).sum() / side**2 / length) if length else float("nan")


def cell_border_pixels(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    side: NDArray[np.float64],
    view: NDArray[np.float64],
    size: tuple[int, int],
) -> NDArray[np.bool_]:
    """Pixels through which a border of the quad-tree's leaves passes.

    A pixel is a convex quadrilateral in the unit square, so it lies inside one leaf if its four corners do.

    Parameters
    ----------
    x, y, side : (n,) float64 arrays
        Lower left corner and side of every leaf; together the leaves tile the unit square.
    view : (3, 3) float64 array
        From pixel coordinates to the unit square.
    size : tuple of int
        Width and height of the image in pixels.

    Returns
    -------
    (height, width) bool array
        True where the pixel's corners lie in different leaves, or some, but not all, outside the unit square.

    Examples
    --------
    >>> halves, view = np.array([0.0, 0.5]), np.diag([1 / 3, 1 / 3, 1.0])
    >>> x, y = (axis.ravel() for axis in np.meshgrid(halves, halves))
    >>> cell_border_pixels(x, y, np.full(4, 0.5), view, (3, 3)).astype(int)
    array([[0, 1, 0],
           [1, 1, 1],
           [0, 1, 0]])
    """
    left, top = np.meshgrid(np.arange(size[0]), np.arange(size[1]))
    corners = [(TOUCH, TOUCH), (1.0 - TOUCH, TOUCH), (TOUCH, 1.0 - TOUCH), (1.0 - TOUCH, 1.0 - TOUCH)]
    cells = []
    for right, down in corners:
        u, v, w = np.einsum("ij,jyx->iyx", view, np.stack([left + right, top + down, np.ones(left.shape)]))
        cells.append(cell_at(x, y, side, u / w, v / w))
    differ: NDArray[np.bool_] = np.any([cell != cells[0] for cell in cells[1:]], axis=0)
    return differ


def cell_at(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    side: NDArray[np.float64],
    u: NDArray[np.float64],
    v: NDArray[np.float64],
) -> NDArray[np.int64]:
    """Rank, in Morton order, of the leaf that holds each point (u, v); -1 outside the unit square.

    In Morton order each leaf is one interval, and a point's leaf is the last that does not begin after the point
    (Morton 1966; Gargantini, "An effective way to represent quadtrees", 1982).
    """
    depth = int(np.rint(-np.log2(side.min())))
    inside = (u >= 0.0) & (u < 1.0) & (v >= 0.0) & (v < 1.0)
    points = morton(np.where(inside, u, 0.0), np.where(inside, v, 0.0), depth)
    return np.where(inside, np.searchsorted(np.sort(morton(x, y, depth)), points, "right") - 1, -1)


def morton(x: NDArray[np.float64], y: NDArray[np.float64], depth: int) -> NDArray[np.int64]:
    """Morton code of the cell of depth `depth` (at most 31) that holds a point: the interleaved bits of its place."""
    column, row = (np.floor(np.ldexp(axis, depth)).astype(np.int64) for axis in (x, y))
    code = np.zeros(column.shape, np.int64)
    for bit in range(depth):
        code |= ((column >> bit & 1) << 2 * bit) | ((row >> bit & 1) << 2 * bit + 1)
    return code


def border_ratio(image: ArrayLike, truth: ArrayLike, border: NDArray[np.bool_]) -> float:
    """Ratio of the mean error of edge pixels (0 < truth < 1) on cell borders to that of the other edge pixels.

    Parameters
    ----------
    image, truth : array
        Coverage, 0..1, of the same shape.
    border : bool array
        Result of `cell_border_pixels`, of the same shape.

    Returns
    -------
    float
        1 where borders do not show; NaN if no edge pixel is on a border, or the others are absent or without error.

    Examples
    --------
    >>> round(border_ratio([0.5, 0.6], [0.3, 0.5], np.array([True, False])), 6)
    2.0
    """
    image, truth = np.asarray(image, np.float64), np.asarray(truth, np.float64)
    edge = (truth > TRUTH) & (truth < 1.0 - TRUTH)
    on, off = np.abs(image - truth)[edge & border], np.abs(image - truth)[edge & ~border]
    if not len(on) or not off.any():
        return float("nan")
    return float(on.mean() / off.mean())
