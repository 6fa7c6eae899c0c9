"""Encode a `CellTree` as the thesis's pair of textures (FORMAT.md, part A)."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError, ParameterError
from vexture.bezier.area import edge_indices
from vexture.thesis import layout
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellKind, CellTree


def encode(
    tree: CellTree,
    bits: int = 16,
    *,
    to_source: NDArray[np.float64],
    name: str,
    crs: str | None = None,
) -> ThesisTexture:
    """Encode a tree as a pair of textures with 8 or 16 bits per channel.

    Raises a `LimitError` if a list is too long for the bits, or if the format cannot express a point.

    Examples
    --------
    >>> cells = np.full((1, 4), CellKind.EMPTY, np.uint8)
    >>> empty = CellTree(cells, np.full((1, 4), -1, np.int32), np.zeros((1, 4)), np.zeros((0, 4, 2)), 0.0, 0)
    >>> encode(empty, 8, to_source=np.eye(2, 3), name="empty").quads[0, 0]
    array([  0, 255,   0], dtype=uint8)
    """
    if bits not in layout.LIST_LIMIT:
        raise ParameterError(f"`bits` is {bits!r}; it must be 8 or 16")
    if not np.isfinite(to_source).all():
        raise LimitError(f"{name}: the transform to source units is not finite; scale the drawing down")
    rows = len(tree.kind), layout.CONSTANT_ROWS + len(tree.curves)
    for count, what in zip(rows, ("quads", "curves"), strict=True):
        if count > layout.LIST_LIMIT[bits]:
            remedy = "a larger `tolerance` or a smaller `max_depth`"
            raise LimitError(
                f"{name}: {count} {what}; {bits} bits hold {layout.LIST_LIMIT[bits]}; "
                f"use {'`bits` 16, ' if bits == 8 else ''}{remedy}"
            )
    dtype = np.dtype(f"uint{bits}")
    return ThesisTexture(_quad_pixels(tree, dtype), _curve_pixels(tree, dtype, name), to_source, name, crs)


def _quad_pixels(tree: CellTree, dtype: np.dtype[Any]) -> NDArray[Any]:
    maximum = np.iinfo(dtype).max
    red = np.full(len(CellKind), layout.KIND_CURVE)
    red[CellKind.QUAD], red[CellKind.CORNER] = layout.KIND_QUAD, layout.KIND_CORNER
    row = tree.ref + np.where(tree.kind == CellKind.QUAD, 0, layout.CONSTANT_ROWS)
    row[tree.kind == CellKind.FULL] = layout.FULL_ROW
    row[tree.kind == CellKind.EMPTY] = layout.EMPTY_ROW
    last = np.where(tree.kind == CellKind.QUAD, max(len(tree.kind) - 1, 1), layout.CONSTANT_ROWS + len(tree.curves) - 1)
    coverage = np.broadcast_to(tree.quad_coverage[:, None].clip(0.0, 1.0), row.shape)
    pixels = np.stack([red[tree.kind], row / last, coverage], axis=2)
    quantised: NDArray[Any] = np.rint(pixels[:, layout.CELL_ORDER] * maximum).astype(dtype)
    return quantised


def _curve_pixels(tree: CellTree, dtype: np.dtype[Any], name: str) -> NDArray[Any]:
    maximum = int(np.iinfo(dtype).max)
    corner = np.zeros(len(tree.curves), np.bool_)
    corner[tree.ref[tree.kind == CellKind.CORNER]] = True
    low = np.where(corner, 0.0, layout.CONTROL_MIN)[:, None, None]
    span = np.where(corner, 1.0, layout.CONTROL_MAX - layout.CONTROL_MIN)[:, None, None]
    ends, inner = tree.curves[:, [0, 3]], tree.curves[:, 1:3]
    rounded = np.rint((inner - low) / span * maximum)
    expressible = _on_edge(ends, 2.0 / maximum) & ((rounded >= 0.0) & (rounded <= maximum)).all(axis=(1, 2))
    if not expressible.all():
        curve = expressible.argmin()
        raise LimitError(
            f"{name}: curve {curve}, ends {ends[curve].tolist()}, inner points {inner[curve].tolist()}; ends must lie "
            f"on the cell's edge, inner points in {low[curve].item()} to {(low + span)[curve].item()}; split it"
        )
    index = edge_indices(ends.reshape(-1, 2)).reshape(-1, 2)
    (x1, y1), (x2, y2) = np.moveaxis(inner - ends[:, :1], 0, 2)
    pixels = np.zeros((layout.CONSTANT_ROWS + len(tree.curves), layout.CURVE_WIDTH, 3), dtype)
    written = pixels[layout.CONSTANT_ROWS :]
    written[:, :, 0] = quantised_ends(index, x1 * y2 < x2 * y1, maximum)
    written[:, :, 1:] = rounded.swapaxes(1, 2)  # a pixel holds an axis, a channel a point
    written[corner, :, 2] = 0
    return pixels


def quantised_ends(index: NDArray[np.float64], clockwise: NDArray[np.bool_], steps: int) -> NDArray[np.int64]:
    """Round edge indices of P0 and P3, (n, 2), to whole steps around the cell; distinct in each row.

    The order of P0 and P3 around the cell determines the filled side: the edge from P3 clockwise to P0 bounds the
    filled part. If both round to the same step, the end with the smaller error moves to the next step in the direction
    that preserves this order. No end is then off by more than one step. `clockwise` (n,) is True for curves that turn
    clockwise; it decides the order if P0 and P3 are the same point.

    Examples
    --------
    >>> quantised_ends(np.array([[0.502, 0.5], [0.5, 0.502]]), np.array([True, True]), 100)
    array([[51, 50], [50, 51]])
    """
    exact = index * steps
    nearest = np.rint(exact)
    whole = nearest.astype(np.int64) % steps
    for i in np.flatnonzero(whole[:, 0] == whole[:, 1]):
        walk = (exact[i, 0] - exact[i, 1]) % steps  # clockwise from P3 to P0
        first = clockwise[i] if walk == 0.0 else walk < 0.5 * steps
        direction = 1 if first else -1  # of P0 as seen from P3
        moved = exact[i] - nearest[i]
        if direction * (moved[0] + moved[1]) >= 0.0:
            whole[i, 0] += direction
        else:
            whole[i, 1] -= direction
    return whole % steps


def _on_edge(ends: NDArray[np.float64], half_step: float) -> NDArray[np.bool_]:
    """Return which curves have both ends (n, 2, 2) on the edge of their cell, within half a step; (n,)."""
    off = np.minimum(abs(ends), abs(1.0 - ends)).min(axis=2)
    near = (off <= half_step) & (abs(ends - 0.5) <= 0.5 + half_step).all(axis=2)
    both: NDArray[np.bool_] = near.all(axis=1)
    return both


def quantisation_step(bits: int) -> float:
    """Largest distance by which quantisation moves an outline, as a share of its cell.

    Inner control points move by at most half a step in x and in y, and ends by less. No point of a cubic moves
    farther than its control points.

    Examples
    --------
    >>> round(quantisation_step(8), 4)
    0.0097
    """
    step = (layout.CONTROL_MAX - layout.CONTROL_MIN) / int(2**bits - 1)
    return step * math.sqrt(0.5)
