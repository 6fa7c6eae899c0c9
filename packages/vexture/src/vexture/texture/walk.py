"""Walk a packed texture from its roots to its leaves, all quads of one depth at a time.

Untrusted texels are validated: a walk stays within them, visits each at most once, and ends.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base import layout
from vexture.base.errors import FormatError
from vexture.texture.curves import texels_in

REMEDY: Final = "convert the drawing again"

HALVES: Final = np.array([(0, 0), (1, 0), (0, 1), (1, 1)])
"""Position of each cell in its quad."""


class WalkLevel(NamedTuple):
    """The n quads of one depth, ordered by their parents, then by the parents' cells."""

    quads: NDArray[np.int64]  # (n,): index of each quad's texel
    tree: NDArray[np.int64]  # (n,): root of each, as an index into the distinct roots in order of their quads
    is_quad: NDArray[np.bool_]  # (n, 4)
    counts: NDArray[np.int64]  # (n, 4): curves of each leaf
    windings: NDArray[np.int64]  # (n, 4): corner winding of each leaf with curves, else 0; in maps, the cell's low bits
    coverages: NDArray[np.int64]  # (n, 4): coverage byte of each cell
    curves: NDArray[np.int64]  # (m,): index of each texel of curves, ordered by quads, then by cells


def walk(flat: NDArray[np.uint32], roots: NDArray[np.int64], of_maps: bool = False) -> list[WalkLevel]:
    """Walk the trees of some roots, which are indices of quads; equal roots are one tree.

    The roots are silhouettes, or planar maps if `of_maps`; cells of maps have neither windings nor coverages.
    Raises a `FormatError` if the texels (n, 4) are not a forest, or a cell has a value that FORMAT.md does not allow.
    """
    quads = np.unique(roots)
    if not len(quads):
        return []
    if quads[0] < 0 or quads[-1] >= len(flat):
        raise FormatError(f"a root is quad {quads[-1]} of {len(flat)} texels; {REMEDY}")
    met = np.zeros(len(flat), np.bool_)
    met[quads] = True
    tree = np.arange(len(quads))
    levels: list[WalkLevel] = []
    while len(quads):
        depth, deepest = len(levels), layout.MOST_DEPTH - 1
        if depth > deepest:
            raise FormatError(f"quad {quads[0]} lies at depth {depth}; the limit is {deepest}; {REMEDY}")
        is_quad, count, winding, coverage = _cells(flat, quads, of_maps)
        below = _below(flat[:, 0], quads, is_quad.sum(axis=1), met, "quad")
        texels = texels_in(count, (winding & layout.STRAIGHT > 0) & of_maps).sum(axis=1)
        curves = _below(flat[:, 1], quads, texels, met, "curve")
        levels.append(WalkLevel(quads, tree, is_quad, count, winding, coverage, curves))
        quads, tree = below, np.repeat(tree, is_quad.sum(axis=1))
    return levels


def _cells(
    flat: NDArray[np.uint32], quads: NDArray[np.int64], of_maps: bool
) -> tuple[NDArray[np.bool_], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Fields of the cells of quads, (n, 4) each: is it a quad, number of curves, corner winding, coverage."""
    shift = layout.CELL_BITS * np.arange(4)
    last = (1 << layout.CELL_BITS) - 1
    cells = (flat[quads, 2].astype(np.int64)[:, None] >> shift) & last
    coverage = (flat[quads, 3].astype(np.int64)[:, None] >> shift) & last
    is_quad = cells >= layout.QUAD_FLAG
    count = np.where(is_quad, 0, cells >> layout.COUNT_SHIFT & layout.MOST_CURVES)
    winding = np.where(is_quad, 0, cells & ((1 << layout.COUNT_SHIFT) - 1))
    allowed = layout.HOLDS_PROGRAM | np.where(count > 0, layout.STRAIGHT, 0)
    is_map_leaf = (winding & ~allowed == 0) | (cells == layout.IS_MEAN)
    leaf_is_wrong = ~is_map_leaf if of_maps else (count > 0) != (winding > 0)
    wrong = np.where(is_quad, cells != layout.QUAD_FLAG, leaf_is_wrong)
    if wrong.any():
        place, cell = np.argwhere(wrong)[0]
        raise FormatError(f"quad {quads[place]}, cell {cell} is {cells[place, cell]}, which is no valid cell; {REMEDY}")
    return is_quad, count, winding if of_maps else np.where(count > 0, winding - layout.WINDING_OFFSET, 0), coverage


def _below(
    first: NDArray[np.uint32], quads: NDArray[np.int64], counts: NDArray[np.int64], met: NDArray[np.bool_], noun: str
) -> NDArray[np.int64]:
    """Indices of the texels that quads refer to: `counts` texels from `first` for each; marks them in `met`."""
    some = counts > 0
    start, counts = first[quads[some]].astype(np.int64), counts[some]
    wrong = (start <= quads[some]) | (start + counts > len(met))
    if wrong.any():
        place = wrong.argmax()
        raise FormatError(
            f"quad {quads[some][place]} has {counts[place]} {noun}s from texel {start[place]}; they must lie after it "
            f"and within {len(met)} texels; {REMEDY}"
        )
    before = np.cumsum(counts) - counts
    found: NDArray[np.int64] = np.arange(counts.sum()) + np.repeat(start - before, counts)
    order = np.sort(found)
    again = met[order]
    again[1:] |= order[1:] == order[:-1]
    if again.any():
        raise FormatError(f"texel {order[again.argmax()]} is referred to twice, as a {noun} now; {REMEDY}")
    met[found] = True
    return found


def check_ends(ends: NDArray[np.int32], texels: NDArray[np.int64]) -> None:
    """Raise a `FormatError` where an end of a curve, (n, 2, 2), lies outside its leaf; `texels` (n,) are its texels."""
    most = ends.max(axis=(1, 2), initial=0)
    if len(most) and most.max() > layout.LATTICE:
        raise FormatError(
            f"curve {texels[most.argmax()]} has an end at {most.max()}; the limit is {layout.LATTICE:.0f}; {REMEDY}"
        )
