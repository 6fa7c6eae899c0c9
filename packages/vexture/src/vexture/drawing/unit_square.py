"""Contours in the unit square: clipping to a drawing's box, and removal of contours that enclose nothing."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.tolerance import CLOSED
from vexture.bezier.convert import line_cubics, straight

FARTHEST: Final = 1e9
"""Farthest coordinate in unit-square units. Beyond it, float64 cannot resolve 1e-6 within the drawing."""


def clip_contours(
    joined: NDArray[np.float64], ends: NDArray[np.intp], low: NDArray[np.float64], high: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Clip contours to a box; they come and return as all cubics in one array, and the index after each contour."""
    reach = np.abs(joined).max()
    if not reach <= FARTHEST:
        raise SourceError(
            f"a coordinate is {reach:.3g} times the size of the drawing away; the limit is {FARTHEST:g}; "
            "correct the coordinate or the view box"
        )
    beyond = np.maximum(low - joined, joined - high).max(axis=(1, 2))
    if beyond.max() > CLOSED:
        from vexture.bezier.clip import clip_contour  # compiled code, which most drawings never need

        starts = np.concatenate([[0], ends[:-1]])
        outside = np.maximum.reduceat(beyond, starts) > CLOSED
        contours = np.split(joined, ends[:-1])
        for k in np.flatnonzero(outside):
            contours[k] = clip_contour(contours[k], low, high)
        joined, ends = np.concatenate(contours), np.cumsum([len(contour) for contour in contours])
    joined[:, ::3] = np.clip(joined[:, ::3], low, high)
    return joined, ends


def tidy_contours(joined: NDArray[np.float64], ends: NDArray[np.intp]) -> dict[int, NDArray[np.float64]]:
    """Return the contours that enclose an area, by index: no cubics of zero length, closed bit for bit, exact lines.

    The parameters are the results of `clip_contours`.
    """
    keep = np.abs(joined - joined[:, :1]).max(axis=(1, 2)) > CLOSED
    joined, owner = joined[keep], np.searchsorted(ends, np.flatnonzero(keep), side="right")
    start = np.flatnonzero(np.diff(owner, prepend=-1))
    end = np.append(start[1:], len(joined))[: len(start)]
    previous = np.arange(-1, len(joined) - 1)
    previous[start] = end - 1
    joined[:, 0] = joined[previous, 3]
    lines = straight(joined)
    joined[lines] = line_cubics(joined[lines, 0], joined[lines, 3])
    bent = np.append(0, np.cumsum(~lines))
    encloses = (end - start > 2) | (bent[end] > bent[start])  # two straight sides enclose nothing
    return {int(owner[s]): joined[s:e] for s, e in zip(start[encloses], end[encloses], strict=True)}
