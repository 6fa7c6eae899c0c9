"""Chain of cubics, from edge to edge of a cell, that the boundary in the cell forms, if it is a single one.

`cell_chain` first resolves overlaps and crossings. `plain_chain` is for cells that one path crosses once: their pieces
need neither be quantised nor resolved.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import LATTICE
from vexture.bezier.area import area_right_of, integral_x_dy
from vexture.bezier.monotone import Pieces
from vexture.bezier.roots import solve_monotone
from vexture.bezier.split import copy_curve, subcubic
from vexture.thesis.subdivide import LevelCell
from vexture.tree.boundary import Boundary, cell_paths, quantise, resolve
from vexture.tree.winding import inside, winding_area

JOIN = 3.0 / LATTICE
"""Cell-local units. Closer ends are one point: runs that meet at a crossing may be two lattice units apart."""

LEFT_EDGE, RIGHT_EDGE = -1, -2
"""Ends of a connector that are points on the cell's edge rather than ends of parts."""


class Chain(NamedTuple):
    """Cubics of a cell's boundary, each with the filled side on its right."""

    curves: NDArray[np.float64]  # (n, 4, 2): in the cell's own unit square
    segment: NDArray[np.int64]  # (n,): cubic of the source that contains each; -1 for a horizontal connector
    span: NDArray[np.float64]  # (n, 2): parameter interval on that cubic, in the direction of travel
    chains: int  # 0: no boundary inside the cell; 1: one open chain, in order; 2: anything else
    area: float  # filled part of the cell


@kernel
def boundary_area(boundary: Boundary, parts: NDArray[np.float64]) -> float:
    """Filled part of the cell: the slabs that are inside at the left edge, corrected by the area right of each run.

    `parts` holds the runs of the boundary as cubics in the cell's unit square, with the filled side on the right.
    """
    area = 0.0
    for slab in range(len(boundary.left)):
        if boundary.left[slab] == 1:
            area += (boundary.heights[slab + 1] - boundary.heights[slab]) / LATTICE
    for part in parts:
        area += part[3, 1] - part[0, 1] - integral_x_dy(part)
    return min(max(area, 0.0), 1.0)


@kernel
def _run_parts(curves: NDArray[np.float64], pieces: Pieces, boundary: Boundary, room: int) -> Chain:
    """Convert runs to cubics in the cell's unit square, followed by room for connectors; the area is not set."""
    runs = len(boundary.run_piece)
    out, out_span = np.zeros((runs + room, 4, 2)), np.zeros((runs + room, 2))
    out_segment = np.empty(runs + room, np.int64)
    for r in range(runs, runs + room):
        out_segment[r] = -1
    for r in range(runs):
        i = boundary.run_piece[r]
        curve = curves[i]
        upwards = boundary.run_role[r] == 1  # the filled side is right of the upward direction
        start, stop = boundary.run_y[r, 0 if upwards else 1], boundary.run_y[r, 1 if upwards else 0]
        u0 = solve_monotone(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], start)
        u1 = solve_monotone(curve[0, 1], curve[1, 1], curve[2, 1], curve[3, 1], stop)
        subcubic(curve, u0, u1, out[r])
        out[r, 0, 1], out[r, 3, 1] = start, stop
        for k in range(4):
            out[r, k, 0] /= LATTICE
            out[r, k, 1] /= LATTICE
        out_segment[r] = pieces.segment[i]
        for end, u in ((0, u0), (1, u1)):
            t0, t1 = pieces.span[i, 0], pieces.span[i, 1]
            whole = t0 if u == 0.0 else t1  # equal, bit for bit, to the adjacent piece's parameter
            out_span[r, end] = whole if u == 0.0 or u == 1.0 else t0 + u * (t1 - t0)
    return Chain(out, out_segment, out_span, runs, 0.0)


@kernel
def _ends_at(parts: NDArray[np.float64], runs: int, y: float, ends: NDArray[np.int64]) -> int:
    """Write the runs' ends at a height, left to right, as 2 r (start of run r) or 2 r + 1 (end); return the number."""
    count = 0
    for r in range(runs):
        for which in range(2):
            if parts[r, 3 * which, 1] == y:
                x, k = parts[r, 3 * which, 0], count
                while k > 0 and parts[ends[k - 1] // 2, 3 * (ends[k - 1] & 1), 0] > x:
                    ends[k] = ends[k - 1]
                    k -= 1
                ends[k] = 2 * r + which
                count += 1
    return count


@kernel
def _end_x(parts: NDArray[np.float64], end: int) -> float:
    """Coordinate x of a run's end, or of an edge of the cell."""
    if end < 0:
        return 0.0 if end == LEFT_EDGE else 1.0
    return parts[end // 2, 3 * (end & 1), 0]


@kernel
def _connect(chain: Chain, parts: int, source: int, target: int, y: float, following: NDArray[np.int64]) -> int:
    """Connect one end to another at the same height; return the new number of parts.

    Ends that nearly meet are joined at their midpoint. Others are joined by a horizontal part, because horizontal
    pieces span no slab and the sweep drops them.
    """
    a, b = _end_x(chain.curves, source), _end_x(chain.curves, target)
    if abs(a - b) <= JOIN:
        x = a if source < 0 else b if target < 0 else 0.5 * (a + b)
        for end in (source, target):
            if end >= 0:
                chain.curves[end // 2, 3 * (end & 1), 0] = x
        if source >= 0 and target >= 0:
            following[source // 2] = target // 2
        return parts
    for k in range(4):
        chain.curves[parts, k, 0] = a + (b - a) * (k / 3.0)
        chain.curves[parts, k, 1] = y
    if source >= 0:
        following[source // 2] = parts
    if target >= 0:
        following[parts] = target // 2
    return parts + 1


@kernel
def _link_at(
    chain: Chain,
    runs: int,
    parts: int,
    y: float,
    below: int,
    above: int,
    following: NDArray[np.int64],
    ends: NDArray[np.int64],
) -> int:
    """Link all ends at one height; return the new number of parts.

    Along that height, the state just below (inside or outside) differs from the state just above exactly between the
    first and the second end from the left, the third and the fourth, and so on. The cell's left edge counts as an end
    if the states differ there; its right edge counts as one if the number of ends is odd then.
    """
    count = _ends_at(chain.curves, runs, y, ends)
    if below != above:
        for k in range(count, 0, -1):
            ends[k] = ends[k - 1]
        ends[0] = LEFT_EDGE
        count += 1
    if count % 2 == 1:
        ends[count] = RIGHT_EDGE
        count += 1
    k = 0
    while k + 1 < count:
        first = ends[k]
        m = k + 1  # a start must meet an end; curves that cross at a common point are in any order
        while m + 1 < count and first >= 0 and ends[m] >= 0 and (first & 1) == (ends[m] & 1):
            m += 1
        second = ends[m]
        ends[m] = ends[k + 1]
        if first == LEFT_EDGE and second == RIGHT_EDGE:
            forward = below == 1  # filled below: the filled side is on the right of the direction to the right
        else:
            forward = (first & 1) == 1 if first >= 0 else (second & 1) == 0
        if forward:
            parts = _connect(chain, parts, first, second, y, following)
        else:
            parts = _connect(chain, parts, second, first, y, following)
        k += 2
    return parts


@kernel
def on_edge(x: float, y: float) -> bool:
    """Return whether a point lies on the edge of the unit square, within `JOIN`."""
    return min(x, 1.0 - x, y, 1.0 - y) <= JOIN


@kernel
def _along_edge(curve: NDArray[np.float64]) -> bool:
    """Return whether a part of a chain follows the cell's edge, where it bounds nothing inside the cell."""
    for axis in range(2):
        for line in (0.0, 1.0):
            if abs(curve[0, axis] - line) <= JOIN and abs(curve[3, axis] - line) <= JOIN:
                return True
    return False


@kernel
def _travel(chain: Chain, parts: int, following: NDArray[np.int64], area: float) -> Chain:
    """Order the parts from the single start; drop those along the cell's edge at either end."""
    preceded = np.zeros(parts, np.bool_)
    for k in range(parts):
        if following[k] >= 0:
            preceded[following[k]] = True
    heads, head, beside = 0, -1, 0
    for k in range(parts):
        if not preceded[k] and following[k] < 0 and _along_edge(chain.curves[k]):
            beside += 1  # bounds nothing inside the cell
        elif not preceded[k]:
            heads, head = heads + 1, k
    order = np.empty(parts, np.int64)
    length = 0
    while heads == 1 and head >= 0:
        order[length] = head
        length += 1
        head = following[head]
    if heads != 1 or length + beside != parts:  # no chain, several chains, or an additional closed one
        none = heads == 0 and beside == parts
        return Chain(chain.curves[:parts], chain.segment[:parts], chain.span[:parts], 0 if none else 2, area)
    first, last = 0, length
    while first < last and _along_edge(chain.curves[order[first]]):
        first += 1
    while last > first and _along_edge(chain.curves[order[last - 1]]):
        last -= 1
    n = last - first
    out = Chain(np.empty((n, 4, 2)), np.empty(n, np.int64), np.empty((n, 2)), min(n, 1), area)
    for k in range(n):
        part = order[first + k]
        copy_curve(chain.curves[part], out.curves[k])
        out.segment[k] = chain.segment[part]
        out.span[k, 0], out.span[k, 1] = chain.span[part, 0], chain.span[part, 1]
    return out


@kernel
def cell_chain(cell: LevelCell, rules: NDArray[np.int64]) -> Chain:
    """Chain of a cell's boundary, with overlaps and crossings resolved; `rules` has the `FillRule` of each path."""
    pieces, present = cell.pieces, cell.present
    owner = np.empty(len(pieces.path), np.int64)
    corner, cell_rules = np.empty(len(present), np.int64), np.empty(len(present), np.int64)
    cell_paths(pieces.path, present, rules, owner, corner, cell_rules)
    curves = quantise(pieces.points, cell.x0, cell.y0, cell.size)
    boundary = resolve(curves, owner, np.ones(len(owner), np.int64), corner, cell_rules)
    runs, slabs = len(boundary.run_piece), len(boundary.left)
    chain = _run_parts(curves, pieces, boundary, 2 * runs + slabs + 2)
    area = boundary_area(boundary, chain.curves[:runs])
    following = np.empty(len(chain.curves), np.int64)
    for k in range(len(following)):
        following[k] = -1
    ends = np.empty(2 * runs + 2, np.int64)
    parts = runs
    for k in range(1, slabs):
        y = boundary.heights[k] / LATTICE
        parts = _link_at(chain, runs, parts, y, boundary.left[k - 1], boundary.left[k], following, ends)
    return _travel(chain, parts, following, area)


@kernel
def to_cell(cell: LevelCell) -> NDArray[np.float64]:
    """Pieces of a cell, (n, 4, 2), in its unit square; coordinates on its edge become exactly 0 or 1."""
    points = cell.pieces.points
    out = np.empty((len(points), 4, 2))
    for i in range(len(points)):
        for k in range(4):
            out[i, k, 0] = (points[i, k, 0] - cell.x0) / cell.size
            out[i, k, 1] = (points[i, k, 1] - cell.y0) / cell.size
    return out


@kernel(allocates=False)
def touches_edge(point: NDArray[np.float64]) -> bool:
    """Return whether a coordinate of a point is exactly 0 or 1."""
    return point[0] == 0.0 or point[0] == 1.0 or point[1] == 0.0 or point[1] == 1.0


@kernel
def filled_sides(cell: LevelCell, curves: NDArray[np.float64], rule: int, signed_area: float) -> tuple[bool, bool]:
    """Return whether the right and the left side of one chain from edge to edge are filled.

    The winding number is w on the right and w + 1 on the left, except in loops; w follows from its mean over the cell.
    `curves` holds the cell's pieces in its unit square, all of one path. `signed_area` is the area on the right of the
    chain, in which the sign of a loop depends on its direction.
    """
    w = int(np.rint(winding_area(curves, cell.present[0, 1], 1.0) - 1.0 + signed_area))
    return inside(w, rule), inside(w + 1, rule)


@kernel(allocates=False)
def _apart(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    """Return whether the bounding boxes of two monotone pieces share at most an edge."""
    for axis in range(2):
        if max(a[0, axis], a[3, axis]) <= min(b[0, axis], b[3, axis]):
            return True
        if max(b[0, axis], b[3, axis]) <= min(a[0, axis], a[3, axis]):
            return True
    return False


@kernel(allocates=False)
def _is_plain(curves: NDArray[np.float64]) -> bool:
    """Return whether monotone pieces form one open chain between edges that cannot cross itself or follow an edge."""
    n = len(curves)
    for axis in range(2):
        for i in range(n):
            if curves[i, 0, axis] == curves[i, 3, axis] and (curves[i, 0, axis] == 0.0 or curves[i, 0, axis] == 1.0):
                return False
            if i > 0 and curves[i, 0, axis] != curves[i - 1, 3, axis]:
                return False
    if not (touches_edge(curves[0, 0]) and touches_edge(curves[n - 1, 3])):
        return False
    if curves[0, 0, 0] == curves[n - 1, 3, 0] and curves[0, 0, 1] == curves[n - 1, 3, 1]:  # closed
        return False
    for i in range(n):
        for j in range(i):
            if not _apart(curves[i], curves[j]):
                return False
    return True


@kernel
def plain_chain(cell: LevelCell, rules: NDArray[np.int64]) -> Chain:
    """Chain of a cell with one path if nothing in it needs to be resolved; else `chains` is 2 and the area not set."""
    curves = to_cell(cell)
    n, segment, span = len(curves), cell.pieces.segment, cell.pieces.span
    if not _is_plain(curves):
        return Chain(curves, segment, span, 2, 0.0)
    x_dy = 0.0
    for curve in curves:
        x_dy += integral_x_dy(curve)
    area = area_right_of(curves[0, 0], curves[n - 1, 3], x_dy)
    right, left = filled_sides(cell, curves, rules[cell.present[0, 0]], area)
    if right == left:
        return Chain(curves, segment, span, 0, 1.0 if right else 0.0)
    if right:
        return Chain(curves, segment, span, 1, area)
    turned = Chain(np.empty((n, 4, 2)), np.empty(n, np.int64), np.empty((n, 2)), 1, 1.0 - area)
    for i in range(n):
        subcubic(curves[n - 1 - i], 1.0, 0.0, turned.curves[i])
        turned.segment[i] = segment[n - 1 - i]
        turned.span[i, 0], turned.span[i, 1] = span[n - 1 - i, 1], span[n - 1 - i, 0]
    return turned
