"""The part of a drawing that a view from nearby shows, as a drawing of its own, as exact as the view needs."""

from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.tolerance import UNSEEN
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Affine
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix

SHARE: Final = 0.04
"""Pixels. Largest distance of an outline that shows nowhere; `UNSEEN` is this in a picture of 2,000 pixels."""

MARGIN: Final = 2.0
"""Pixels around the view, so that the cut sides of what it shows lie in no pixel."""

FLIP: Final[Affine] = ((1.0, 0.0, 0.0), (0.0, -1.0, 1.0))
"""From the unit square to itself, y up and y down."""


class CloseUp(NamedTuple):
    """The part of a drawing that a view shows.

    Parameters
    ----------
    drawing : Drawing
    view : (3, 3) array
        From pixels to the drawing's unit square.
    precision : float or None
        What the texture of the drawing needs; None is what it has without any.
    """

    drawing: Drawing
    view: NDArray[np.float64]
    precision: float | None = None


def close_up(drawing: Drawing, size: Size, view: ViewLike) -> CloseUp:
    """Return the part of a drawing that an image of a size shows, if the usual texture is too coarse for its view.

    Views in perspective keep the drawing: no one box is near enough to all of their pixels.

    Examples
    --------
    >>> square = Drawing.polygon([(0.5, 0.5), (0.75, 0.5), (0.75, 0.75), (0.5, 0.75)])
    >>> whole = close_up(square, 500, None)
    >>> whole.drawing is square, whole.precision
    (True, None)
    >>> part = close_up(square, 500, [[1e-7, 0, 0.5], [0, -1e-7, 0.5]])
    >>> part.drawing.paths[0].box.round(3).tolist(), part.precision
    ([[0.004, 0.996], [1.0, 1.0]], None)
    """
    width, height = size_of(size)
    matrix = view_matrix(view, size)
    if (matrix[2, :2] != 0.0).any():
        return CloseUp(drawing, matrix)
    matrix = matrix / matrix[2, 2]
    pixel = float(np.linalg.svd(matrix[:2, :2], compute_uv=False)[-1])
    if pixel >= UNSEEN / SHARE:
        return CloseUp(drawing, matrix)
    across, down = ((-MARGIN, side + MARGIN) for side in (width, height))
    ends = np.array([(x, y, 1.0) for x in across for y in down]) @ matrix[:2].T
    low, high = np.clip(ends.min(axis=0), 0.0, 1.0), np.clip(ends.max(axis=0), 0.0, 1.0)
    if (high <= low).any():
        return CloseUp(replace(drawing, paths=(), groups=()), matrix)
    part = _part(drawing, low, high)
    to_whole = np.vstack([FLIP, (0.0, 0.0, 1.0)]) @ np.vstack([part.to_source, (0.0, 0.0, 1.0)])
    side = float((high - low).max())
    precision = SHARE * pixel / side if pixel / side < UNSEEN / SHARE else None
    to_source = (np.vstack([drawing.to_source, (0.0, 0.0, 1.0)]) @ to_whole)[:2]
    part = replace(part, to_source=to_source, crs=drawing.crs, notes=drawing.notes)
    return CloseUp(part, np.linalg.solve(to_whole, matrix), precision)


def _part(drawing: Drawing, low: NDArray[np.float64], high: NDArray[np.float64]) -> Drawing:
    """Part of a drawing in a box of the unit square, scaled up; `to_source` leads to the unit square with y down."""
    flipped = (
        replace(
            path,
            contours=tuple(contour * (1.0, -1.0) + (0.0, 1.0) for contour in path.contours),
            paint=path.paint.after(FLIP),
        )
        for path in drawing.paths
    )
    box = (float(low[0]), float(1.0 - high[1]), float(high[0] - low[0]), float(high[1] - low[1]))
    return Drawing.from_source(flipped, box, drawing.name, drawing.groups)
