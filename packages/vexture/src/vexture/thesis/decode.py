"""Decoder of a pair of the thesis's textures to a tree (FORMAT.md, part A)."""

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.area import leaf_area
from vexture.thesis import layout
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellKind, CellTree


def edge_point(index: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points, (..., 2), at the edge indices, (...), of the thesis's Table 4.1; index 1 is the same point as 0.

    One coordinate of each point is exactly 0 or 1. This is the inverse of `vexture.bezier.area.edge_indices`.

    Examples
    --------
    >>> edge_point(np.array([0.125, 0.375, 0.625, 0.875]))
    array([[0.5, 1. ], [1. , 0.5], [0.5, 0. ], [0. , 0.5]])
    """
    position = index % 1.0 * 4.0
    side = position.astype(np.intp)
    along = position - side
    x = np.choose(side, [along, 1.0, 1.0 - along, 0.0])
    y = np.choose(side, [1.0, 1.0 - along, 0.0, along])
    return np.stack([x, y], axis=-1)


def decode(texture: ThesisTexture) -> CellTree:
    """Decode a pair of textures to a tree, with `deviation` and `unresolved` 0.

    The texture stores the coverage of quads only. Constant cells get 0 or 1, divided cells the stored coverage of
    their quad, and cells with a curve the exact area of their filled part. The four values of a quad are then scaled
    towards 0 or 1 until their mean is the quad's stored coverage, which was measured before quantisation.

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
    corner = np.zeros(len(stored), np.bool_)
    corner[ref[kind == CellKind.CORNER]] = True
    inner = stored[:, :, 1:].swapaxes(1, 2)
    curves = np.empty((len(stored), 4, 2))
    curves[:, [0, 3]] = edge_point(stored[:, :, 0])
    curves[:, 1:3] = layout.CONTROL_MIN + inner * (layout.CONTROL_MAX - layout.CONTROL_MIN)
    curves[corner, 1:3] = inner[corner, :1]

    of_quad = texture.quads[:, 0, 2] / texture.maximum
    coverage = (kind == CellKind.FULL).astype(np.float64)
    is_quad = kind == CellKind.QUAD
    coverage[is_quad] = of_quad[ref[is_quad]]
    is_curve = (kind == CellKind.CURVE) | (kind == CellKind.CORNER)
    coverage[is_curve] = [leaf_area(curves[curve], corner[curve]) for curve in ref[is_curve]]
    return CellTree(kind, ref, _with_mean(coverage, of_quad), curves, deviation=0.0, unresolved=0)


def _with_mean(coverage: NDArray[np.float64], means: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scale each row towards 0 or 1 until it has its mean of `means`; values in 0..1 stay in that range."""
    mean = coverage.mean(axis=1)
    down, up = mean > means, mean < means
    coverage[down] *= (means[down] / mean[down])[:, None]
    coverage[up] = 1.0 - (1.0 - coverage[up]) * ((1.0 - means[up]) / (1.0 - mean[up]))[:, None]
    return coverage
