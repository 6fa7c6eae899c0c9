"""The stroke of a path: the one entry of the kernels that outline strokes.

Only + - * / and square roots are used, so that all machines compute the same numbers.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.chain import empty_chain
from vexture.bezier.dashes import append_dashes
from vexture.bezier.joins import StrokeStyle
from vexture.bezier.outlines import StrokeOutlines, append_stroke

FITTED: Final = 0.1
REDUCED: Final = 0.86
"""Shares of the tolerance for parallel curves and arcs, and for the few cubics that replace them. The rest is for what
both miss between the points at which they measure."""

SHORTEST: Final = 1 / 64
"""Share of the tolerance. Shorter steps have no direction that means something."""

FLOATS: Final = 1e-13
"""Least tolerance, as a share of the coordinates and the width: a few roundings of float64."""


@kernel(ahead=True)
def stroke_path(
    cubics: NDArray[np.float64],
    ends: NDArray[np.int64],
    closed: NDArray[np.bool_],
    style: NDArray[np.float64],
    dashes: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Contours of the stroke of a path, to fill by the non-zero rule: their cubics (m, 4, 2), and how many each has.

    `ends` (k,) says where each subpath ends in the cubics (n, 4, 2), and `closed` (k,) whether it does. The style (6,)
    is the width, the cap and the join (`vexture.bezier.joins`), the longest miter in widths, the tolerance, and the
    place in the pattern of dashes at which each subpath starts. `dashes` (2 d,) are lengths of dashes and gaps; none
    for a solid line.

    Examples
    --------
    >>> import numpy as np
    >>> from vexture.bezier.convert import line_cubics
    >>> line = line_cubics(np.array([[0.0, 0.0]]), np.array([[9.0, 0.0]]))
    >>> style = np.array([2.0, 0.0, 0.0, 4.0, 1e-4, 0.0])
    >>> contours, lengths = stroke_path(line, np.array([1]), np.array([False]), style, np.array([4.0, 1.0]))
    >>> lengths, np.ptp(contours[:4], axis=(0, 1))
    (array([4, 4]), array([4., 2.]))
    """
    size = style[0]
    for i in range(len(cubics)):
        for k in range(4):
            size = max(size, max(abs(cubics[i, k, 0]), abs(cubics[i, k, 1])))
    tolerance = max(style[4], size * FLOATS)
    kind = StrokeStyle(style[0] / 2.0, int(style[1]), int(style[2]), style[3], FITTED * tolerance, SHORTEST * tolerance)
    tolerance *= REDUCED
    outlines = StrokeOutlines(
        empty_chain(4 * len(cubics) + 16), np.empty(2 * len(ends), np.int64), np.zeros(1, np.int64)
    )
    first = 0
    for i in range(len(ends)):
        path = cubics[first : ends[i]]
        if len(dashes) > 0:
            outlines = append_dashes(outlines, path, closed[i], dashes, style[5], kind, tolerance)
        else:
            outlines = append_stroke(outlines, path, closed[i], kind, tolerance)
        first = ends[i]
    return outlines.chain.cubics[: outlines.chain.length[0]], outlines.lengths[: outlines.number[0]]
