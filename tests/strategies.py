"""Random valid inputs for property tests."""

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from vexture.base.layout import LATTICE, MOST_CURVES
from vexture.bezier.area import leaf_area
from vexture.thesis.decode import edge_point
from vexture.thesis.layout import CONTROL_MAX, CONTROL_MIN
from vexture.thesis.tree import CellKind, CellTree
from vexture.tree.tree import Tree

LEAVES = [CellKind.CURVE, CellKind.CORNER, CellKind.FULL, CellKind.EMPTY]
SAMPLES = np.linspace(0.0, 1.0, 65)[:, None]


def on_cubic(curve: NDArray[np.float64], t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points of a cubic, (n, 2), at parameters t, (n, 1)."""
    s = 1.0 - t
    return s**3 * curve[0] + 3.0 * s * s * t * curve[1] + 3.0 * s * t * t * curve[2] + t**3 * curve[3]


@st.composite
def edge_ends(draw: st.DrawFn) -> tuple[float, float]:
    """Edge indices of P0 and P3: anywhere, at corners of the cell, or nearly the same."""
    anywhere = st.floats(0.0, 1.0, exclude_max=True) | st.sampled_from([0.0, 0.125, 0.25, 0.5, 0.75])
    start = draw(anywhere)
    near = st.sampled_from([1e-9, -1e-9, 1e-5, -1e-5, 1e-3, -1e-3]).map(lambda step: (start + step) % 1.0)
    end = draw((anywhere | near).filter(lambda index: 1e-10 < abs(index - start) < 1.0 - 1e-10))
    return start, end


@st.composite
def edge_cubics(draw: st.DrawFn) -> NDArray[np.float64]:
    """Cubics from edge to edge that stay in their cell and in the format's range: arches, S-curves, cusps, loops."""
    ends = edge_point(np.array(draw(edge_ends())))
    inner = np.array([[draw(st.floats(CONTROL_MIN, CONTROL_MAX)) for _ in range(2)] for _ in range(2)])
    chord = ends[0] + (ends[1] - ends[0]) * np.array([[1.0], [2.0]]) / 3.0
    for part in (1.0, 0.75, 0.5, 0.25, 0.1, 0.0):  # of the way from the straight line
        curve = np.stack([ends[0], *(chord + part * (inner - chord)), ends[1]])
        points = on_cubic(curve, SAMPLES)
        if points.min() >= -1e-12 and points.max() <= 1.0 + 1e-12:
            break
    return curve


@st.composite
def edge_corners(draw: st.DrawFn) -> NDArray[np.float64]:
    """Straight corners: P0, the corner twice, P3."""
    ends = edge_point(np.array(draw(edge_ends())))
    corner = np.array([draw(st.floats(0.0, 1.0)) for _ in range(2)])
    return np.stack([ends[0], corner, corner, ends[1]])


@st.composite
def cell_trees(draw: st.DrawFn, max_depth: int = 5, max_quads: int = 24) -> CellTree:
    """Valid trees, numbered as `CellTree` says; the coverage of their leaves is exact."""
    kinds: list[list[CellKind]] = []
    refs: list[list[int]] = []
    curves: list[NDArray[np.float64]] = []
    depths = [0]
    for depth in depths:  # grows while it is walked: breadth first
        kinds.append([])
        refs.append([])
        for _ in range(4):
            may_split = depth < max_depth and len(depths) < max_quads
            kind = draw(st.sampled_from([CellKind.QUAD, *LEAVES] if may_split else LEAVES))
            ref = -1
            if kind == CellKind.QUAD:
                ref = len(depths)
                depths.append(depth + 1)
            elif kind in (CellKind.CURVE, CellKind.CORNER):
                ref = len(curves)
                curves.append(draw(edge_cubics() if kind == CellKind.CURVE else edge_corners()))
            kinds[-1].append(kind)
            refs[-1].append(ref)
    kind, ref = np.array(kinds, np.uint8), np.array(refs, np.int32)
    return CellTree(kind, ref, _coverage(kind, ref, curves), np.array(curves).reshape(-1, 4, 2), 0.0, 0)


def _coverage(
    kind: NDArray[np.uint8], ref: NDArray[np.int32], curves: list[NDArray[np.float64]]
) -> NDArray[np.float64]:
    coverage = np.zeros(kind.shape)
    for quad in reversed(range(len(kind))):
        for cell in range(4):
            match kind[quad, cell]:
                case CellKind.FULL:
                    coverage[quad, cell] = 1.0
                case CellKind.QUAD:
                    coverage[quad, cell] = coverage[ref[quad, cell]].mean()
                case CellKind.CURVE | CellKind.CORNER as leaf:
                    coverage[quad, cell] = leaf_area(curves[ref[quad, cell]], bool(leaf == CellKind.CORNER))
    return coverage


@st.composite
def packed_trees(draw: st.DrawFn, max_depth: int = 5, max_quads: int = 24) -> Tree:
    """Valid packed trees, numbered as `Tree` says; their pieces lie anywhere and bound nothing."""
    depths = [0]
    cells: list[tuple[bool, int, int]] = []
    for depth in depths:  # grows while it is walked: breadth first
        for _ in range(4):
            may_split = depth < max_depth and len(depths) < max_quads
            count = draw(st.sampled_from([0, 0, 1, 2, 4, MOST_CURVES]))
            is_quad = may_split and draw(st.booleans())
            cells.append((True, 0, 0) if is_quad else (False, count, draw(st.integers(-3, 3)) if count else 0))
            depths += [depth + 1] * is_quad
    is_quad, count, winding = (np.array(column).reshape(-1, 4) for column in zip(*cells, strict=True))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    curves = random.integers(0, LATTICE, (count.sum(), 4, 2), endpoint=True)
    curves[:, 1:3] = random.integers(-LATTICE / 2, 3 * LATTICE / 2, (count.sum(), 2, 2))
    quads_in, curves_in = is_quad.sum(axis=1), count.sum(axis=1)
    return Tree(
        is_quad,
        count.astype(np.uint8),
        winding.astype(np.int8),
        (1 + np.cumsum(quads_in) - quads_in).astype(np.int32),
        (np.cumsum(curves_in) - curves_in).astype(np.int32),
        random.random(is_quad.shape),
        curves.astype(np.int32),
        0.0,
        0,
    )
