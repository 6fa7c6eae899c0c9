"""Strokes of shapes as outlines to fill, computed by the kernel `vexture.bezier.stroke`."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.tolerance import ROUND
from vexture.bezier.arc_length import path_length
from vexture.bezier.joins import ARCS, BEVEL, BUTT, MITER, MITER_CLIP, ROUND_CAP, ROUND_JOIN, SQUARE
from vexture.bezier.stroke import stroke_path
from vexture.svg.outline import ShapeOutline

MOST_DASHES: Final = 100_000
"""Most dashes in one path."""

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


def stroke_contours(outlines: list[ShapeOutline], stroke: Stroke, size: float) -> list[NDArray[np.float64]]:
    """Return the contours of the stroke of outlines, to fill by the nonzero rule.

    `size` is the drawing's size in the units of the outlines, and sets the accuracy. Raise a `SourceError` if there are
    too many dashes.

    Examples
    --------
    >>> line = ShapeOutline.polygon(np.array([[0.0, 0.0], [10.0, 0.0]]), closed=False)
    >>> (contour,) = stroke_contours([line], Stroke(2.0), 10.0)
    >>> np.ptp(contour[:, 0], axis=0).round(6)
    array([10.,  2.])
    """
    cubics = np.concatenate([outline.cubics for outline in outlines])
    if stroke.dashes:
        dashes = path_length(cubics) / sum(stroke.dashes) * len(stroke.dashes) / 2
        if not dashes <= MOST_DASHES:
            raise SourceError(
                f"a stroke has {dashes:.3g} dashes; the limit is {MOST_DASHES:,}; lengthen stroke-dasharray"
            )
    ends = np.cumsum([len(outline.cubics) for outline in outlines])
    closed = np.array([outline.closed for outline in outlines])
    style = (stroke.width, CAPS[stroke.cap], JOINS[stroke.join], stroke.miter_limit, ROUND * size, stroke.dash_offset)
    found, counts = stroke_path(cubics, ends, closed, np.array(style, np.float64), np.array(stroke.dashes, np.float64))
    return np.split(found, np.cumsum(counts)[:-1]) if len(counts) else []
