"""Strokes of shapes as outlines to fill, computed by the kernel `vexture.bezier.stroke`."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.tolerance import ROUND
from vexture.bezier.arc_length import path_length
from vexture.bezier.joins import ARCS, BEVEL, BUTT, MITER, MITER_CLIP, ROUND_CAP, ROUND_JOIN, SQUARE
from vexture.bezier.stroke import stroke_path
from vexture.svg.outline import ShapeOutline

MOST_DASHES: Final = 100_000
"""Most dashes in one stroke: more of them are a solid line."""

MOST_COUNTED: Final = 1e15
"""Most dashes that are counted: numbers up to here are exact."""

CAPS: Final = {"butt": BUTT, "round": ROUND_CAP, "square": SQUARE}
JOINS: Final = {"miter": MITER, "round": ROUND_JOIN, "bevel": BEVEL, "miter-clip": MITER_CLIP, "arcs": ARCS}


@dataclass(frozen=True, slots=True)
class Stroke:
    """Style of a stroke, in the units of its path."""

    width: float
    cap: str = "butt"  # a key of `CAPS`
    join: str = "miter"  # a key of `JOINS`
    miter_limit: float = 4.0  # longest miter, in stroke widths
    dashes: tuple[float, ...] = ()  # alternating lengths of dashes and gaps, an even number; empty for a solid line
    dash_offset: float = 0.0  # position in the pattern at which the line starts


def dash_count(outlines: list[ShapeOutline], stroke: Stroke) -> int:
    """Return the number of dashes in the stroke of outlines, at most 1e15; 0 for a solid line.

    Examples
    --------
    >>> line = ShapeOutline.polygon(np.array([[0.0, 0.0], [10.0, 0.0]]), closed=False)
    >>> dash_count([line], Stroke(1.0, dashes=(2.0, 0.5))), dash_count([line], Stroke(1.0, dashes=(1e-99, 0.0)))
    (4, 1000000000000000)
    """
    if not stroke.dashes:
        return 0
    whole = float(sum(path_length(outline.cubics) for outline in outlines))
    return int(min(MOST_COUNTED, whole / sum(stroke.dashes) * len(stroke.dashes) / 2))


def stroke_contours(outlines: list[ShapeOutline], stroke: Stroke, size: float) -> list[NDArray[np.float64]]:
    """Return the contours of the stroke of outlines, to fill by the nonzero rule.

    `size` is the drawing's size in the units of the outlines, and sets the accuracy. The time and the memory are
    proportional to the number of dashes, which a caller limits.

    Examples
    --------
    >>> line = ShapeOutline.polygon(np.array([[0.0, 0.0], [10.0, 0.0]]), closed=False)
    >>> (contour,) = stroke_contours([line], Stroke(2.0), 10.0)
    >>> np.ptp(contour[:, 0], axis=0).round(6)
    array([10.,  2.])
    """
    cubics = np.concatenate([outline.cubics for outline in outlines])
    ends = np.cumsum([len(outline.cubics) for outline in outlines])
    closed = np.array([outline.closed for outline in outlines])
    style = (stroke.width, CAPS[stroke.cap], JOINS[stroke.join], stroke.miter_limit, ROUND * size, stroke.dash_offset)
    found, counts = stroke_path(cubics, ends, closed, np.array(style, np.float64), np.array(stroke.dashes, np.float64))
    return np.split(found, np.cumsum(counts)[:-1]) if len(counts) else []
