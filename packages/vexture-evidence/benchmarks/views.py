"""Views of a drawing for the benchmarks, with random sub-pixel shifts drawn from a seed."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing

MARGIN = 0.05
"""Of the box's larger side, left free on each side by `square_view`."""


class PictureView(NamedTuple):
    """A picture: its size and the map from its pixels to the unit square."""

    size: tuple[int, int]
    to_unit: NDArray[np.float64]


def em_size(drawing: Drawing) -> float:
    """Unit-square units in an em of a glyph; a drawing that is no glyph is one em wide."""
    return float(1.0 / drawing.to_source[0, 0]) if len(drawing.name) == 1 else 1.0


def box_of(drawing: Drawing) -> NDArray[np.float64]:
    """Lower left and upper right corner of the box around all control points, (2, 2)."""
    points = np.concatenate([contour.reshape(-1, 2) for path in drawing.paths for contour in path.contours])
    return np.stack([points.min(axis=0), points.max(axis=0)])


def views_with_shifts(
    drawing: Drawing, pixels: float, shifts: int, seed: int, *, turn: float = 0.0, stretch: float = 1.0
) -> Iterator[PictureView]:
    """Views of the whole drawing, alike but for their shifts.

    Parameters
    ----------
    drawing : Drawing
        The drawing in view.
    pixels : float
        Pixels in an em, along the direction that has more of them.
    shifts : int
        Number of views.
    seed : int
        Of the shifts, with the drawing's name: each lies within a pixel, both ways.
    turn : float
        Degrees by which pixels are turned.
    stretch : float
        A pixel's length over its width, in the drawing.

    Examples
    --------
    >>> square = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])
    >>> [view.size for view in views_with_shifts(square, 16, 2, seed=1)]
    [(10, 10), (10, 10)]
    """
    pixel = em_size(drawing) / pixels
    cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    steps = pixel * np.array([[cosine, -sine], [-sine, -cosine]]) * (1.0, stretch)
    low, high = box_of(drawing)
    corners = np.linalg.solve(steps, np.array([(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])]).T)
    size = tuple(int(extent) for extent in np.ceil(np.ptp(corners, axis=1)) + 2)
    rng = np.random.default_rng([seed, *drawing.name.encode()])
    for shift in rng.random((shifts, 2)):
        origin = steps @ (corners.min(axis=1) - 1.0 + shift)
        yield PictureView((size[0], size[1]), np.vstack([np.column_stack([steps, origin]), (0.0, 0.0, 1.0)]))


def square_view(drawing: Drawing, side: int, zoom: float = 1.0, at: tuple[float, float] | None = None) -> PictureView:
    """Square picture of the drawing's box with a margin, magnified around a point of the unit square (its centre)."""
    low, high = box_of(drawing)
    pixel = (1.0 + 2.0 * MARGIN) * float((high - low).max()) / side / zoom
    x, y = (low + high) / 2.0 if at is None else at
    half = 0.5 * side * pixel
    return PictureView((side, side), np.array([[pixel, 0.0, x - half], [0.0, -pixel, y + half], [0.0, 0.0, 1.0]]))


def tilted_view(drawing: Drawing, side: int) -> PictureView:
    """Square picture of the drawing on a plane that is turned by 30 degrees and leans back.

    The picture's lower edge sees 0.6 of the box, its upper edge three times as much.
    """
    low, high = box_of(drawing)
    reach = (1.0 + 2.0 * MARGIN) * float((high - low).max())
    cosine, sine = math.cos(math.radians(30.0)), math.sin(math.radians(30.0))
    lean = np.array([[0.6, 0.0, -0.3], [0.0, 0.9, -0.3], [0.0, 2.0 / 3.0, 1.0 / 3.0]])  # of (x, y down) in 0..1
    turn = np.array([[cosine, sine, 0.0], [sine, -cosine, 0.0], [0.0, 0.0, 1.0]])
    place = np.array([[reach, 0.0, (low[0] + high[0]) / 2], [0.0, reach, (low[1] + high[1]) / 2], [0.0, 0.0, 1.0]])
    return PictureView((side, side), place @ turn @ lean @ np.diag([1.0 / side, 1.0 / side, 1.0]))
