"""From the roots of a packed texture down to its leaves, all quads of a depth at a time.

Nothing is believed: a walk over texels of a stranger stays within them, meets each once, and ends.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.errors import FormatError
from vexture.layout import CELL_BITS, COUNT_SHIFT, MOST_CURVES, MOST_DEPTH, QUAD_FLAG, WINDING_OFFSET

__all__ = ["WalkLevel", "walk"]

REMEDY = "convert the drawing again"


class WalkLevel(NamedTuple):
    """The quads of one depth, in the order of their parents and of the cells of those.

    Attributes
    ----------
    quads : (n,) int64 array
        Index of each quad's texel.
    tree : (n,) int64 array
        Which of the roots, without repetition in order of their quads, each belongs to.
    is_quad : (n, 4) bool array
    counts : (n, 4) int64 array
        Number of curves of each leaf.
    windings : (n, 4) int64 array
        Corner winding of each leaf with curves; 0 elsewhere.
    coverages : (n, 4) int64 array
        Coverage byte of each cell.
    curves : (m,) int64 array
        Index of each curve's texel, in the order of the quads and their cells.
    """

    quads: NDArray[np.int64]
    tree: NDArray[np.int64]
    is_quad: NDArray[np.bool_]
    counts: NDArray[np.int64]
    windings: NDArray[np.int64]
    coverages: NDArray[np.int64]
    curves: NDArray[np.int64]


def walk(flat: NDArray[np.uint32], roots: NDArray[np.int64]) -> list[WalkLevel]:
    """Walk the trees of some roots; those that are the same quad are one.

    Parameters
    ----------
    flat : (n, 4) uint32 array
        The texels.
    roots : (m,) int64 array
        Index of each root's quad.

    Raises
    ------
    FormatError
        If this is not a forest, or a cell says what no cell may say.
    """
    quads = np.unique(roots)
    if quads[0] < 0 or quads[-1] >= len(flat):
        raise FormatError(f"a root is quad {quads[-1]} of {len(flat)} texels; {REMEDY}")
    met = np.zeros(len(flat), np.bool_)
    met[quads] = True
    tree = np.arange(len(quads))
    levels: list[WalkLevel] = []
    while len(quads):
        if len(levels) == MOST_DEPTH:
            raise FormatError(f"quad {quads[0]} lies at depth {MOST_DEPTH}; the limit is {MOST_DEPTH - 1}; {REMEDY}")
        is_quad, count, winding, coverage = _cells(flat, quads)
        below = _below(flat[:, 0], quads, is_quad.sum(axis=1), met, "quad")
        curves = _below(flat[:, 1], quads, count.sum(axis=1), met, "curve")
        levels.append(WalkLevel(quads, tree, is_quad, count, winding, coverage, curves))
        quads, tree = below, np.repeat(tree, is_quad.sum(axis=1))
    return levels


def _cells(
    flat: NDArray[np.uint32], quads: NDArray[np.int64]
) -> tuple[NDArray[np.bool_], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Read what the cells of quads are: whether quads, curves, corner winding, coverage."""
    shift = CELL_BITS * np.arange(4)
    last = (1 << CELL_BITS) - 1
    cells = (flat[quads, 2].astype(np.int64)[:, None] >> shift) & last
    coverage = (flat[quads, 3].astype(np.int64)[:, None] >> shift) & last
    is_quad = cells >= QUAD_FLAG
    count = np.where(is_quad, 0, cells >> COUNT_SHIFT & MOST_CURVES)
    winding = np.where(is_quad, 0, cells & ((1 << COUNT_SHIFT) - 1))
    wrong = np.where(is_quad, cells != QUAD_FLAG, (count > 0) != (winding > 0))
    if wrong.any():
        place, cell = np.argwhere(wrong)[0]
        raise FormatError(f"quad {quads[place]}, cell {cell} is {cells[place, cell]}, which says nothing; {REMEDY}")
    return is_quad, count, np.where(count > 0, winding - WINDING_OFFSET, 0), coverage


def _below(
    first: NDArray[np.uint32], quads: NDArray[np.int64], counts: NDArray[np.int64], met: NDArray[np.bool_], what: str
) -> NDArray[np.int64]:
    """Texels to which quads refer, `counts` to each from its `first`; they are now met."""
    some = counts > 0
    start, counts = first[quads[some]].astype(np.int64), counts[some]
    wrong = (start <= quads[some]) | (start + counts > len(met))
    if wrong.any():
        place = wrong.argmax()
        raise FormatError(
            f"quad {quads[some][place]} has {counts[place]} {what}s from texel {start[place]}; they must lie after it "
            f"and within {len(met)} texels; {REMEDY}"
        )
    before = np.cumsum(counts) - counts
    found: NDArray[np.int64] = np.arange(counts.sum()) + np.repeat(start - before, counts)
    order = np.sort(found)
    again = met[order]
    again[1:] |= order[1:] == order[:-1]
    if again.any():
        raise FormatError(f"texel {order[again.argmax()]} is referred to twice, as a {what} now; {REMEDY}")
    met[found] = True
    return found
