"""Close-ups of a drawing: along its outline, and at its sharpest corner."""

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.points import points_at
from vexture.renderers.view import window
from vexture_evidence.measures.metrics import TRUTH

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing

CANDIDATES: Final = 4
"""Candidates for each requested point: where paths overlap, parts of their outlines lie inside the silhouette."""

CORNERS: Final = 32
"""Corners that are tried, the sharpest first."""

NEAR: Final = 1e-3
"""Unit-square units; side of the square around a point whose coverage tells if the silhouette's border passes there."""

STEP: Final = 1e-9
"""Unit-square units; a control point nearer than this to an end does not define the direction there."""


def closeup(size: tuple[int, int], place: NDArray[np.float64], magnification: float) -> NDArray[np.float64]:
    """View of a part of the unit square around a place, (3, 3).

    Parameters
    ----------
    size : tuple of int
        Width and height of the image in pixels.
    place : (2,) array
        The middle, in the unit square.
    magnification : float
        How many times larger than in a picture of the same size that shows the whole unit square.

    Examples
    --------
    >>> closeup((8, 8), np.array([0.5, 0.5]), 2.0)[0] + 0.0
    array([0.0625, 0.    , 0.25  ])
    """
    part = 1.0 / magnification
    return window(float(place[0]) - part / 2, float(place[1]) - part / 2, part, part).matrix(size)


def outline_places(drawing: "Drawing", count: int) -> NDArray[np.float64]:
    """Points at even distances along the outline, (at most `count`, 2).

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> outline_places(Drawing.polygon([(0, 0), (0.5, 0), (0.5, 0.5), (0, 0.5)]), 2).round(3)
    array([[0.5  , 0.125],
           [0.   , 0.375]])
    """
    cubics = all_cubics(drawing)
    if not len(cubics):
        return np.zeros((0, 2))
    ends = np.cumsum(np.linalg.norm(np.diff(cubics, axis=1), axis=2).sum(axis=1))
    at = ends[-1] * (np.arange(CANDIDATES * count) + 0.5) / (CANDIDATES * count)
    owner = np.searchsorted(ends, at)
    length = np.diff(ends, prepend=0.0)[owner]
    points = points_at(cubics[owner], (at - ends[owner]) / length + 1.0)
    seen = [point for point in points if on_border(drawing, point)]
    taken = min(count, len(seen))
    return np.array([seen[int((number + 0.5) * len(seen) / taken)] for number in range(taken)]).reshape(-1, 2)


def sharpest_corner(drawing: "Drawing") -> NDArray[np.float64]:
    """Point where the silhouette's border turns most between two curves, (2,); the middle if the drawing is empty.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> sharpest_corner(Drawing.polygon([(0, 0), (0.5, 0), (0.5, 0.5), (0.4, 0.1)]))
    array([0.5, 0.5])
    """
    places, turns = [], []
    for contour in (contour for path in drawing.paths for contour in path.contours):
        back, out = directions(contour[:, ::-1]), directions(contour)
        turns.append((back * np.roll(out, -1, axis=0)).sum(axis=1))  # 1 where it turns back, -1 where it is straight
        places.append(contour[:, 3])
    if not places:
        return np.array([0.5, 0.5])
    order = np.argsort(-np.concatenate(turns), kind="stable")[:CORNERS]
    corners = np.concatenate(places)[order]
    return next((corner for corner in corners if on_border(drawing, corner)), corners[0])


def directions(cubics: NDArray[np.float64]) -> NDArray[np.float64]:
    """Unit vectors in which cubics leave their first points."""
    steps = cubics[:, 1:] - cubics[:, :1]
    lengths = np.linalg.norm(steps, axis=2)
    first = np.argmax(lengths > STEP, axis=1)
    row = np.arange(len(cubics))
    found: NDArray[np.float64] = steps[row, first] / np.maximum(lengths[row, first], STEP)[:, None]
    return found


def all_cubics(drawing: "Drawing") -> NDArray[np.float64]:
    """All cubics, (n, 4, 2)."""
    contours = [contour for path in drawing.paths for contour in path.contours]
    return np.concatenate(contours) if contours else np.zeros((0, 4, 2))


def on_border(drawing: "Drawing", place: NDArray[np.float64]) -> bool:
    """Whether a small square around a place is neither empty nor full."""
    from vexture.renderers.exact import render_exact

    coverage = render_exact(drawing, (1, 1), closeup((1, 1), place, 1.0 / NEAR))[0, 0]
    return bool(TRUTH < coverage < 1.0 - TRUTH)
