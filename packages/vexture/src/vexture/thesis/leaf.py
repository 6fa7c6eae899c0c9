"""The thesis's leaf: full, empty, or divided from edge to edge by one cubic or one straight corner.

A leaf is, in this order of preference (thesis 6.2.1 and 6.1.2): an exact part of one cubic of the source, two straight
runs that meet in a corner, or a cubic that is fitted to one chain within the tolerance. The filled side is on the right
of the direction from P0 to P3.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.area import area_right_of, integral_x_dy, leaf_area, loop_area
from vexture.bezier.fit import fit_cubic
from vexture.bezier.roots import cubic_at
from vexture.bezier.split import copy_curve, subcubic
from vexture.thesis.boundary_chain import JOIN, Chain, filled_sides, on_edge, to_cell, touches_edge
from vexture.thesis.layout import CONTROL_MAX, CONTROL_MIN
from vexture.thesis.subdivide import LevelCell
from vexture.thesis.tree import CellKind

CURVE, QUAD, CORNER, FULL, EMPTY = (int(kind) for kind in CellKind)  # plain integers, as kernels need
NO_LEAF = -1

SHORTEST_CHORD = 16.0 * JOIN
"""Cell-local units. A shorter chord gives a curve's basis no reliable direction."""

SLIVER = 1e-9
"""Share of the cell's area. A curve that cuts off less follows the cell's edge."""

MAX_SAMPLES, SAMPLES_PER_PART = 64, 8
"""Most samples of a chain for a fit, and the samples on each part of a short chain."""


class ThesisLeaf(NamedTuple):
    """Possible content of a cell."""

    kind: int  # a `CellKind` other than QUAD, or `NO_LEAF`
    curve: NDArray[np.float64]  # (4, 2): P0 P1 P2 P3 in the cell's unit square; for a corner P1 = P2 = the corner
    coverage: float  # part of the cell that the drawing fills; the part beside the curve may differ
    distance: float  # largest distance of the drawing's outline from the curve, in cell-local units
    resolved: bool  # False for an approximation beyond the tolerance, at the depth limit


@kernel
def no_leaf() -> ThesisLeaf:
    """Result of an attempt that failed."""
    return ThesisLeaf(NO_LEAF, np.zeros((4, 2)), 0.0, 0.0, True)


@kernel
def _constant_leaf(is_full: bool) -> ThesisLeaf:
    """Full or empty leaf of a cell without a boundary."""
    return ThesisLeaf(FULL if is_full else EMPTY, np.zeros((4, 2)), 1.0 if is_full else 0.0, 0.0, True)


@kernel
def nearest_constant(area: float) -> ThesisLeaf:
    """Full or empty leaf as a last resort: its distance from an outline in the cell is at most the cell's diagonal."""
    return ThesisLeaf(FULL if area > 0.5 else EMPTY, np.zeros((4, 2)), area, np.sqrt(2.0), False)


@kernel
def snap_to_edge(point: NDArray[np.float64]) -> None:
    """Move a point to the nearest side of the unit square, exactly."""
    x, y = min(max(point[0], 0.0), 1.0), min(max(point[1], 0.0), 1.0)
    if min(x, 1.0 - x) <= min(y, 1.0 - y):
        x = 0.0 if x <= 1.0 - x else 1.0
    else:
        y = 0.0 if y <= 1.0 - y else 1.0
    point[0], point[1] = x, y


@kernel
def _expressible(curve: NDArray[np.float64]) -> bool:
    """Return whether the format can store a curve: inner control points in range, chord long enough."""
    for k in (1, 2):
        for axis in range(2):
            if not CONTROL_MIN <= curve[k, axis] <= CONTROL_MAX:
                return False
    return np.hypot(curve[3, 0] - curve[0, 0], curve[3, 1] - curve[0, 1]) >= SHORTEST_CHORD


@kernel
def own_leaf(cell: LevelCell, cubics: NDArray[np.float64], rules: NDArray[np.int64]) -> ThesisLeaf:
    """Leaf of a cell that a single cubic of one path crosses once from edge to edge: the exact part of the cubic.

    Nothing is quantised or resolved. A cubic that crosses itself in the cell is accepted only under the even-odd rule,
    because the shader counts crossings. `cubics` (m, 4, 2) belong to the source; `rules` has each path's `FillRule`.
    """
    points, _, segment, span = cell.pieces
    last, rule = len(points) - 1, rules[cell.present[0, 0]]
    for i in range(1, last + 1):
        if segment[i] != segment[0] or span[i, 0] != span[i - 1, 1]:
            return no_leaf()
    local = to_cell(cell)
    curve = np.empty((4, 2))
    subcubic(cubics[segment[0]], span[0, 0], span[last, 1], curve)
    for axis, corner in ((0, cell.x0), (1, cell.y0)):
        curve[0, axis], curve[3, axis] = local[0, 0, axis], local[last, 3, axis]
        for k in (1, 2):
            curve[k, axis] = (curve[k, axis] - corner) / cell.size
    if not (touches_edge(curve[0]) and touches_edge(curve[3]) and _expressible(curve)):
        return no_leaf()
    if rule == 0 and last > 0 and loop_area(curve) != 0.0:
        return no_leaf()
    signed_area = area_right_of(curve[0], curve[3], integral_x_dy(curve))
    right, left = filled_sides(cell, local, rule, signed_area)
    area = leaf_area(curve, False)
    if right == left or area >= 1.0 - SLIVER:
        return _constant_leaf(right)
    if area <= SLIVER:
        return _constant_leaf(left)
    if right:
        return ThesisLeaf(CURVE, curve, area, 0.0, True)
    backwards = np.empty((4, 2))
    subcubic(curve, 1.0, 0.0, backwards)
    return ThesisLeaf(CURVE, backwards, leaf_area(backwards, False), 0.0, True)


@kernel
def _own_chain(chain: Chain, cubics: NDArray[np.float64], cell: LevelCell) -> ThesisLeaf:
    """Leaf of a chain with consecutive parts of one cubic of the source: the exact part of that cubic."""
    n = len(chain.segment)
    segment = chain.segment[0]
    if segment < 0:
        return no_leaf()
    for k in range(1, n):
        if chain.segment[k] != segment or abs(chain.span[k, 0] - chain.span[k - 1, 1]) > 1e-9:
            return no_leaf()
    curve = np.empty((4, 2))
    subcubic(cubics[segment], chain.span[0, 0], chain.span[n - 1, 1], curve)
    for k in range(4):
        curve[k, 0], curve[k, 1] = (curve[k, 0] - cell.x0) / cell.size, (curve[k, 1] - cell.y0) / cell.size
    for end in (0, 3):
        snap_to_edge(curve[end])
    if not _expressible(curve) or (n > 1 and loop_area(curve) != 0.0):
        return no_leaf()
    return ThesisLeaf(CURVE, curve, 0.0, 0.0, True)


@kernel
def _off_line(curves: NDArray[np.float64], a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Largest distance of the control points of a run from the segment between two points."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = np.hypot(dx, dy)
    worst = 0.0
    for curve in curves:
        for k in range(4):
            px, py = curve[k, 0] - a[0], curve[k, 1] - a[1]
            along = min(max((px * dx + py * dy) / (length * length), 0.0), 1.0) if length > 0.0 else 0.0
            worst = max(worst, np.hypot(px - along * dx, py - along * dy))
    return worst


@kernel
def _corner(chain: Chain, tolerance: float) -> ThesisLeaf:
    """Leaf of a chain that consists of two straight runs, which meet at a joint inside the cell."""
    n = len(chain.curves)
    best, worst = 0, np.inf
    for joint in range(1, n):
        corner = chain.curves[joint, 0]
        off = max(
            _off_line(chain.curves[:joint], chain.curves[0, 0], corner),
            _off_line(chain.curves[joint:], corner, chain.curves[n - 1, 3]),
        )
        if off < worst:
            best, worst = joint, off
    if worst > tolerance:
        return no_leaf()
    curve = np.empty((4, 2))
    for axis in range(2):
        curve[0, axis], curve[3, axis] = chain.curves[0, 0, axis], chain.curves[n - 1, 3, axis]
        curve[1, axis] = min(max(chain.curves[best, 0, axis], 0.0), 1.0)
        curve[2, axis] = curve[1, axis]
    return ThesisLeaf(CORNER, curve, 0.0, worst, True)


@kernel
def _sample(chain: Chain, per_part: int) -> NDArray[np.float64]:
    """Sample points along a chain, including its joints."""
    n = len(chain.curves)
    out = np.empty((n * per_part + 1, 2))
    for k in range(n):
        c = chain.curves[k]
        for m in range(per_part):
            for axis in range(2):
                out[k * per_part + m, axis] = cubic_at(c[0, axis], c[1, axis], c[2, axis], c[3, axis], m / per_part)
    out[n * per_part, 0], out[n * per_part, 1] = chain.curves[n - 1, 3, 0], chain.curves[n - 1, 3, 1]
    return out


@kernel
def _fit(chain: Chain, tolerance: float) -> ThesisLeaf:
    """Leaf of a chain that one cubic approximates within the tolerance."""
    per_part = min(max(MAX_SAMPLES // len(chain.curves), 2), SAMPLES_PER_PART)
    curve = np.empty((4, 2))
    distance = fit_cubic(_sample(chain, per_part), tolerance, curve)
    if distance > tolerance or not _expressible(curve):
        return no_leaf()
    return ThesisLeaf(CURVE, curve, 0.0, distance, True)


@kernel
def chain_leaf(chain: Chain, cubics: NDArray[np.float64], cell: LevelCell, tolerance: float) -> ThesisLeaf:
    """Leaf that describes a cell's chain within a tolerance in cell-local units, or `NO_LEAF`."""
    if chain.chains == 0:
        return _constant_leaf(chain.area > 0.5)
    if chain.chains != 1:
        return no_leaf()
    start, stop = chain.curves[0, 0], chain.curves[len(chain.curves) - 1, 3]
    if not (on_edge(start[0], start[1]) and on_edge(stop[0], stop[1])):
        return no_leaf()
    snap_to_edge(start)
    snap_to_edge(stop)
    if np.hypot(stop[0] - start[0], stop[1] - start[1]) < SHORTEST_CHORD:
        return no_leaf()
    leaf = _own_chain(chain, cubics, cell)
    if leaf.kind == NO_LEAF:
        leaf = _corner(chain, tolerance)
    if leaf.kind == NO_LEAF:
        leaf = _fit(chain, tolerance)
    return ThesisLeaf(leaf.kind, leaf.curve, chain.area, leaf.distance, True)


@kernel
def limit_leaf(chain: Chain) -> ThesisLeaf:
    """Leaf of a cell at the depth limit: the straight line or constant whose area is nearest to the chain's.

    A line connects two points at which the boundary meets the cell's edge.
    """
    area = chain.area
    best = nearest_constant(area)
    error = min(area, 1.0 - area)
    line = np.empty((4, 2))
    for i in range(len(chain.curves)):
        for j in range(len(chain.curves)):
            a, b = chain.curves[i, 0], chain.curves[j, 3]
            if not (on_edge(a[0], a[1]) and on_edge(b[0], b[1])):
                continue
            for k in range(4):
                for axis in range(2):
                    line[k, axis] = a[axis] + (b[axis] - a[axis]) * (k / 3.0)
            snap_to_edge(line[0])
            snap_to_edge(line[3])
            if not _expressible(line):
                continue
            off = abs(area_right_of(line[0], line[3], integral_x_dy(line)) - area)
            if off < error:
                error = off
                chosen = np.empty((4, 2))
                copy_curve(line, chosen)
                best = ThesisLeaf(CURVE, chosen, area, _off_line(chain.curves, chosen[0], chosen[3]), False)
    return best
