"""The thesis encoding (FORMAT.md, part A): a `CellTree` to a pair of textures and back."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.area import edge_indices, leaf_area
from vexture.errors import LimitError, ParameterError
from vexture.thesis import layout
from vexture.thesis.edge import edge_point, quantised_ends
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellKind, CellTree

__all__ = ["decode", "encode", "quantisation_step"]


def encode(
    tree: CellTree,
    bits: int = 16,
    *,
    to_source: NDArray[np.float64],
    name: str,
    crs: str | None = None,
) -> ThesisTexture:
    """Pair of textures of a tree.

    Parameters
    ----------
    tree : CellTree
        Numbered as its docstring says.
    bits : int
        Bits per channel, 8 or 16.
    to_source : (2, 3) float64 array
        Affine map from the unit square to the units of the source.
    name : str
        Names the shape in messages and files.
    crs : str or None
        Coordinate reference system of the source units.

    Raises
    ------
    LimitError
        If a list is too long for the bits, or a point lies where the format cannot say it.

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
    corner = _is_corner(tree.kind, tree.ref, len(tree.curves))
    low, span = _control_range(corner)
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
    written[:, :, 1:] = rounded.swapaxes(1, 2)  # pixels are axes, channels points
    written[corner, :, 2] = 0
    return pixels


def _on_edge(ends: NDArray[np.float64], half_step: float) -> NDArray[np.bool_]:
    """Which curves, (n,), have both ends, (n, 2, 2), on the edge of their cell but for half a step of rounding."""
    off = np.minimum(abs(ends), abs(1.0 - ends)).min(axis=2)
    near = (off <= half_step) & (abs(ends - 0.5) <= 0.5 + half_step).all(axis=2)
    both: NDArray[np.bool_] = near.all(axis=1)
    return both


def _is_corner(kind: NDArray[np.uint8], ref: NDArray[np.int32], count: int) -> NDArray[np.bool_]:
    """Which of the curves are corners, (count,)."""
    corner = np.zeros(count, np.bool_)
    corner[ref[kind == CellKind.CORNER]] = True
    return corner


def _control_range(corner: NDArray[np.bool_]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lowest value and span of the inner points' coordinates, (n, 1, 1) each: a corner lies in its cell."""
    low = np.where(corner, 0.0, layout.CONTROL_MIN)[:, None, None]
    return low, np.where(corner, 1.0, layout.CONTROL_MAX - layout.CONTROL_MIN)[:, None, None]


def decode(texture: ThesisTexture) -> CellTree:
    """Tree of a pair of textures, with `deviation` and `unresolved` 0.

    The texture holds the coverage of quads only. Those of the cells are 1 and 0 where they are constant, what the
    texture says where they are quads, and the exact area of the curve where they are curves; then they are scaled
    towards 0 or 1 until their mean is what the texture says of the quad (it was measured before quantisation).

    Raises
    ------
    FormatError
        If the pixels contradict FORMAT.md.

    Examples
    --------
    >>> pixels = np.zeros((1, 4, 3), np.uint8)
    >>> decode(ThesisTexture(pixels, np.zeros((2, 2, 3), np.uint8))).kind  # 3 is CellKind.FULL
    array([[3, 3, 3, 3]], dtype=uint8)
    """
    texture.check()
    kind, ref = texture.cells()
    stored = texture.curves[layout.CONSTANT_ROWS :] / texture.maximum
    corner = _is_corner(kind, ref, len(stored))
    low, span = _control_range(corner)
    curves = np.empty((len(stored), 4, 2))
    curves[:, [0, 3]] = edge_point(stored[:, :, 0])
    curves[:, 1:3] = low + stored[:, :, 1:].swapaxes(1, 2) * span
    curves[corner, 2] = curves[corner, 1]

    of_quad = texture.quads[:, 0, 2] / texture.maximum
    coverage = (kind == CellKind.FULL).astype(np.float64)
    is_quad = kind == CellKind.QUAD
    coverage[is_quad] = of_quad[ref[is_quad]]
    is_curve = (kind == CellKind.CURVE) | (kind == CellKind.CORNER)
    coverage[is_curve] = [leaf_area(curves[curve], corner[curve]) for curve in ref[is_curve]]
    return CellTree(kind, ref, _with_mean(coverage, of_quad), curves, deviation=0.0, unresolved=0)


def _with_mean(coverage: NDArray[np.float64], wanted: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scale each row towards 0 or towards 1, whichever gives it the mean that is wanted; 0..1 stays 0..1."""
    mean = coverage.mean(axis=1)
    down, up = mean > wanted, mean < wanted
    coverage[down] *= (wanted[down] / mean[down])[:, None]
    coverage[up] = 1.0 - (1.0 - coverage[up]) * ((1.0 - wanted[up]) / (1.0 - mean[up]))[:, None]
    return coverage


def quantisation_step(bits: int) -> float:
    """Largest distance by which quantisation moves an outline, as a share of its cell.

    Inner control points move by at most half a step in x and in y, ends by less, and no point of a cubic moves
    farther than its control points.

    Examples
    --------
    >>> round(quantisation_step(8), 4)
    0.0097
    """
    step = (layout.CONTROL_MAX - layout.CONTROL_MIN) / int(2**bits - 1)
    return step * math.sqrt(0.5)
