"""Build the tree as the thesis does (4.2.1 to 4.2.3): the baseline of the evaluation.

The outline is sampled. One cubic is fitted to a cell's samples, or the cell is divided. Corners are approximated by
division, crossings and overlaps are not resolved, and the coverage is that of the straight line from P0 to P3.
"""

from dataclasses import dataclass
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.tolerance import GRAIN
from vexture.bezier.area import area_right_of
from vexture.drawing.drawing import Drawing
from vexture.thesis.accuracy import Accuracy, cell_tolerance
from vexture.thesis.layout import CONTROL_MAX, CONTROL_MIN
from vexture.thesis.leaf import SHORTEST_CHORD, snap_to_edge
from vexture.thesis.tree import CellKind, CellTree
from vexture.tree.winding import inside

SAMPLES_ACROSS = 256
"""Initial density: number of samples on a line across the unit square."""

DENSER = 3
"""Factor on the density of a segment that crosses a cell without a sample in it (thesis 4.2.2)."""

FINE = 1 / 9
"""Share of a cell's width. A shorter chord in the cell cuts a corner of it and needs no denser samples."""

BESIDE = 1e-3
"""Distance from a chord at which inside and outside are tested, as a share of the chord's length."""

Polyline = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class _Run:
    """Consecutive samples of the outline in a cell: points, and the source segment of each."""

    points: Polyline
    segment: NDArray[np.int64]
    sampled: NDArray[np.bool_]  # False for a point interpolated on a cell's edge


def _outline(drawing: Drawing, cubics: NDArray[np.float64], density: NDArray[np.int64]) -> list[_Run]:
    """Sample the outline: one closed run for each contour."""
    samples = []
    for cubic, n in zip(cubics, density, strict=True):
        t = (np.arange(n) / n)[:, None]  # includes the cubic's start, not its end
        s = 1.0 - t
        points = s * s * (s * cubic[0] + 3 * t * cubic[1]) + t * t * (3 * s * cubic[2] + t * cubic[3])
        samples.append(np.rint(points / GRAIN) * GRAIN)
    runs, first = [], 0
    for path in drawing.paths:
        for contour in path.contours:
            segments = np.arange(first, first + len(contour))
            first += len(contour)
            points = np.concatenate([*(samples[s] for s in segments), samples[segments[0]][:1]])
            owner = np.append(np.repeat(segments, density[segments]), segments[-1])
            runs.append(_Run(points, owner, np.ones(len(points), bool)))
    return runs


def _halves(run: _Run, axis: int, line: float) -> tuple[list[_Run], list[_Run]]:
    """Cut a run into the parts below and above a line; cut points are interpolated exactly on the line."""
    side = run.points[:, axis] >= line
    cuts = np.flatnonzero(side[1:] != side[:-1])
    parts: tuple[list[_Run], list[_Run]] = ([], [])
    first, entry = 0, None
    for cut in [*cuts, None]:
        last = len(side) if cut is None else int(cut) + 1
        points, segment, sampled = run.points[first:last], run.segment[first:last], run.sampled[first:last]
        where = parts[int(side[first])]
        if entry is not None:
            points, segment = np.vstack([entry[None], points]), np.append(run.segment[first - 1], segment)
            sampled = np.append(False, sampled)
        if cut is not None:
            a, b = run.points[last - 1], run.points[last]
            entry = a + (b - a) * ((line - a[axis]) / (b[axis] - a[axis]))
            entry[axis] = line
            points, segment = np.vstack([points, entry[None]]), np.append(segment, run.segment[last - 1])
            sampled = np.append(sampled, False)
        if len(points) > 1 and (points != points[0]).any():
            where.append(_Run(points, segment, sampled))
        first = last
    return parts


def _join_runs(runs: list[_Run]) -> list[_Run]:
    """Join runs of a cell that meet at the start of a contour."""
    out = list(runs)
    while True:
        pair = next(((a, b) for a, b in permutations(out, 2) if _continues(a, b)), None)
        if pair is None:
            return out
        first, second = pair
        out = [run for run in out if run is not first and run is not second]
        out.append(
            _Run(
                np.vstack([first.points, second.points[1:]]),
                np.append(first.segment, second.segment[1:]),
                np.append(first.sampled, second.sampled[1:]),
            )
        )


def _continues(a: _Run, b: _Run) -> bool:
    """Return whether run b starts at the sample where run a ends."""
    return bool(a.sampled[-1] and b.sampled[0] and (a.points[-1] == b.points[0]).all())


def _fit(points: Polyline) -> tuple[NDArray[np.float64], float]:
    """Fit a cubic to points by least squares at chord-length parameters; return it and the largest squared distance."""
    step = np.hypot(*np.diff(points, axis=0).T)
    t = np.append(0.0, np.cumsum(step)) / step.sum()
    s = 1.0 - t
    inner = np.column_stack((3 * s * s * t, 3 * s * t * t))
    ends = np.outer(s**3, points[0]) + np.outer(t**3, points[-1])
    if len(points) > 3:
        control = np.linalg.lstsq(inner, points - ends, rcond=None)[0]
    else:
        control = points[0] + np.outer([1 / 3, 2 / 3], points[-1] - points[0])
    off = ends + inner @ control - points
    return np.stack([points[0], *control, points[-1]]), float((off**2).sum(axis=1).max())


@kernel
def inside_outline(
    points: NDArray[np.float64], chords: NDArray[np.float64], owner: NDArray[np.int64], rules: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """Return whether points (n, 2) are inside any path, given the chords (m, 2, 2) of the outline and their paths."""
    out = np.zeros(len(points), np.bool_)
    windings = np.empty(len(rules), np.int64)
    for i in range(len(points)):
        windings[:] = 0
        x, y = points[i, 0], points[i, 1]
        for k in range(len(chords)):
            x0, y0, x1, y1 = chords[k, 0, 0], chords[k, 0, 1], chords[k, 1, 0], chords[k, 1, 1]
            if min(y0, y1) <= y < max(y0, y1) and x0 + (y - y0) / (y1 - y0) * (x1 - x0) < x:
                windings[owner[k]] += -1 if y1 > y0 else 1
        for path in range(len(rules)):
            out[i] = out[i] or inside(windings[path], rules[path])
    return out


@dataclass(slots=True)
class _Found:
    """A leaf before its filled side is known."""

    quad: int
    cell: int
    curve: NDArray[np.float64] | None  # cell-local; None for a constant cell
    probe: NDArray[np.float64]  # (2, 2): a point on its right and one on its left, in unit-square units


def _longest(runs: list[_Run]) -> _Run:
    """Run with the longest chord."""
    return max(runs, key=lambda run: float(np.hypot(*(run.points[-1] - run.points[0]))))


def _from_edge_to_edge(run: _Run, origin: NDArray[np.float64], size: float) -> bool:
    """Return whether both ends of a run lie on the edge of a cell."""
    ends = run.points[[0, -1]]
    return bool(((ends == origin) | (ends == origin + size)).any(axis=1).all())


def _leaf(
    runs: list[_Run], origin: NDArray[np.float64], size: float, tolerance: float, at_limit: bool
) -> tuple[NDArray[np.float64] | None, float] | None:
    """Cell-local curve of a cell, or None if constant, and its distance from the samples; None to divide the cell."""
    if not runs:
        return None, 0.0
    if len(runs) == 1 and _from_edge_to_edge(runs[0], origin, size):
        curve, squared = _fit((runs[0].points - origin) / size)
        in_range = ((curve[1:3] >= CONTROL_MIN) & (curve[1:3] <= CONTROL_MAX)).all()
        apart = np.hypot(*(curve[3] - curve[0])) >= SHORTEST_CHORD
        if squared <= (tolerance / size) ** 2 and in_range and apart:
            return curve, float(np.sqrt(squared))
    if not at_limit:
        return None
    longest = _longest(runs)
    a, b = (longest.points[0] - origin) / size, (longest.points[-1] - origin) / size
    if not _from_edge_to_edge(longest, origin, size) or np.hypot(*(b - a)) < SHORTEST_CHORD:
        return None, float(np.sqrt(2.0))
    return a + np.outer(np.arange(4) / 3, b - a), float(np.sqrt(2.0))


def _too_coarse(runs: list[_Run], size: float) -> set[int]:
    """Segments that cross a cell in a long chord without a sample in the cell."""
    return {
        int(segment)
        for run in runs
        if not run.sampled.any() and np.hypot(*(run.points[-1] - run.points[0])) > FINE * size
        for segment in run.segment
    }


def _probe(runs: list[_Run], origin: NDArray[np.float64], size: float) -> NDArray[np.float64]:
    """Points on the right and left of the longest chord in a cell; the cell's centre twice if there is no chord."""
    if not runs:
        return origin + np.full((2, 2), 0.5) * size
    points = _longest(runs).points
    step = np.diff(points, axis=0)
    k = int(np.argmax((step**2).sum(axis=1)))
    across = np.array([step[k, 1], -step[k, 0]]) * BESIDE
    middle = 0.5 * (points[k] + points[k + 1])
    return np.stack([middle + across, middle - across])


def _divide(
    outline: list[_Run], accuracy: Accuracy, max_depth: int
) -> tuple[list[list[int]], list[_Found], set[int], float, int]:
    """Divide the unit square breadth first.

    Returns four child quads or -1 for each quad, the leaves, the segments to sample more densely, the largest distance,
    and the number of unresolved cells.
    """
    quads: list[list[int]] = [[-1] * 4]
    leaves: list[_Found] = []
    coarse: set[int] = set()
    worst, unresolved = 0.0, 0
    queue = [(0, np.zeros(2), 1.0, outline)]
    for depth in range(1, max_depth + 1):
        following = []
        for quad, corner, width, runs in queue:
            size = 0.5 * width
            halves = [_halves(run, 0, corner[0] + size) for run in runs]
            for cell in range(4):
                column = [part for half in halves for part in half[cell & 1]]
                mine = _join_runs([p for part in column for p in _halves(part, 1, corner[1] + size)[cell >> 1]])
                origin = corner + size * np.array([cell & 1, cell >> 1])
                coarse |= _too_coarse(mine, size)
                limit = cell_tolerance(accuracy, size)
                leaf = _leaf(mine, origin, size, limit, depth == max_depth)
                if leaf is None:
                    quads[quad][cell] = len(quads)
                    following.append((len(quads), origin, size, mine))
                    quads.append([-1] * 4)
                    continue
                leaves.append(_Found(quad, cell, leaf[0], _probe(mine, origin, size)))
                unresolved += leaf[1] * size > limit
                worst = max(worst, leaf[1] * size)
        queue = following
    return quads, leaves, coarse, worst, unresolved


def _finish(
    quads: list[list[int]], leaves: list[_Found], filled: NDArray[np.bool_], worst: float, unresolved: int
) -> CellTree:
    """Set the filled side of each leaf and its straight-line area (thesis, Figure 4.3); return the tree."""
    ref = np.array(quads, np.int32)
    kind = np.where(ref >= 0, CellKind.QUAD, CellKind.EMPTY).astype(np.uint8)
    coverage = np.zeros(ref.shape)
    curves: list[NDArray[np.float64]] = []
    for leaf, (right, left) in zip(leaves, filled, strict=True):
        where = (leaf.quad, leaf.cell)
        if leaf.curve is None or right == left:
            kind[where], coverage[where] = (CellKind.FULL, 1.0) if right else (CellKind.EMPTY, 0.0)
            continue
        curve = leaf.curve if right else leaf.curve[::-1].copy()
        snap_to_edge(curve[0])
        snap_to_edge(curve[3])
        kind[where], ref[where] = CellKind.CURVE, len(curves)
        line_x_dy = 0.5 * (curve[0, 0] + curve[3, 0]) * (curve[3, 1] - curve[0, 1])
        coverage[where] = min(max(area_right_of(curve[0], curve[3], line_x_dy), 0.0), 1.0)
        curves.append(curve)
    for quad in range(len(ref) - 1, -1, -1):
        for cell in np.flatnonzero(kind[quad] == CellKind.QUAD):
            coverage[quad, cell] = coverage[ref[quad, cell]].mean()
    stacked = np.stack(curves) if curves else np.empty((0, 4, 2))
    return CellTree(kind, ref, coverage, stacked, worst, unresolved)


def build_sampled(
    drawing: Drawing,
    cubics: NDArray[np.float64],
    owner: NDArray[np.int64],
    rules: NDArray[np.int64],
    accuracy: Accuracy,
    max_depth: int,
) -> CellTree:
    """Build the quad-tree of a drawing in normal form by sampling and fitting, as the thesis does.

    `cubics`, `owner` and `rules` come from `vexture.tree.cubics.gather`. A fit is accepted if the distance of every
    sample is within the accuracy. Cells of depth `max_depth` are not divided further.
    """
    extent = np.hypot(*np.diff(cubics, axis=1).transpose(2, 0, 1)).sum(axis=1)
    density = np.maximum(np.ceil(extent * SAMPLES_ACROSS).astype(np.int64), 3)
    densest = DENSER * 2**max_depth
    while True:
        outline = _outline(drawing, cubics, density)
        quads, leaves, coarse, worst, unresolved = _divide(outline, accuracy, max_depth)
        again = [s for s in coarse if density[s] < densest * max(extent[s], 2.0**-max_depth)]
        if not again:
            break
        density[again] *= DENSER
    chords = np.concatenate([np.stack([run.points[:-1], run.points[1:]], axis=1) for run in outline])
    chord_owner = np.concatenate([owner[run.segment[:-1]] for run in outline])
    probes = np.concatenate([leaf.probe for leaf in leaves])
    filled = inside_outline(probes, chords, chord_owner, rules).reshape(-1, 2)
    return _finish(quads, leaves, filled, worst, unresolved)
