"""Fit few cubics to a closed chain of points: smooth where the chain is smooth, with corners where it turns.

The chain is sampled evenly (`_sample_contour`), corners are restored (`_restore_corners`), stairs of a raster are
measured (`_stairs`), and the samples are smoothed (`smooth_chain`). Then each cubic replaces as many samples as the
tolerance allows (`fit_samples`).
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.bezier.convert import line_cubics
from vexture.bezier.fit import chord_parameters, project
from vexture.bezier.split import copy_curve

ROUNDS = 14
"""Most rounds of smoothing; each gives more weight to the samples that smoothing moved too far."""

OVERLAP = 64
"""Samples by which the closed chain is extended at both ends: more than bending reaches."""


@kernel
def _smooth(
    points: NDArray[np.float64], weight: NDArray[np.float64], bending: NDArray[np.float64], out: NDArray[np.float64]
) -> None:
    """Write the closed chain that is near the points and bends little; banded least squares, solved by L D L^T."""
    n = len(points)
    m = n + 2 * OVERLAP
    a0, a1, a2 = np.zeros(m), np.zeros(m), np.zeros(m)
    b = np.zeros((m, 2))
    for i in range(m):
        k = (i - OVERLAP) % n
        a0[i] += weight[k]
        b[i, 0], b[i, 1] = weight[k] * points[k, 0], weight[k] * points[k, 1]
        if 0 < i < m - 1:
            bend = bending[k]
            a0[i - 1] += bend
            a0[i] += 4.0 * bend
            a0[i + 1] += bend
            a1[i] -= 2.0 * bend  # row i, column i - 1
            a1[i + 1] -= 2.0 * bend
            a2[i + 1] += bend
    for i in range(m):
        if i > 1:
            a2[i] /= a0[i - 2]
            a1[i] -= a2[i] * a0[i - 2] * a1[i - 1]
        if i > 0:
            a1[i] /= a0[i - 1]
            a0[i] -= a1[i] * a1[i] * a0[i - 1]
        if i > 1:
            a0[i] -= a2[i] * a2[i] * a0[i - 2]
        for axis in range(2):
            if i > 0:
                b[i, axis] -= a1[i] * b[i - 1, axis]
            if i > 1:
                b[i, axis] -= a2[i] * b[i - 2, axis]
    for i in range(m - 1, -1, -1):
        for axis in range(2):
            b[i, axis] /= a0[i]
            if i < m - 1:
                b[i, axis] -= a1[i + 1] * b[i + 1, axis]
            if i < m - 2:
                b[i, axis] -= a2[i + 2] * b[i + 2, axis]
    for k in range(n):
        out[k, 0], out[k, 1] = b[k + OVERLAP, 0], b[k + OVERLAP, 1]


@kernel
def smooth_chain(
    points: NDArray[np.float64],
    corner: NDArray[np.bool_],
    bending: NDArray[np.float64],
    reach: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Smooth a closed chain of samples (n, 2) so that it bends little; each sample moves by at most its `reach` (n,).

    Samples where `corner` (n,) is True do not move, and the chain may bend there. `bending` (n,) is the weight of
    bending elsewhere.
    """
    n = len(points)
    weight, bend = np.ones(n), bending.copy()
    for i in range(n):
        if corner[i]:
            weight[i], bend[i] = 1e9, 0.0
    out = np.empty((n, 2))
    for _ in range(ROUNDS):
        _smooth(points, weight, bend, out)
        moved = False
        for i in range(n):
            far = np.hypot(out[i, 0] - points[i, 0], out[i, 1] - points[i, 1]) / reach[i]
            if far > 1.0:
                weight[i] *= min(far * far, 16.0)
                moved = True
        if not moved:
            break
    for i in range(n):
        far = np.hypot(out[i, 0] - points[i, 0], out[i, 1] - points[i, 1])
        share = 0.0 if corner[i] else min(1.0, reach[i] / far) if far > 0.0 else 1.0
        for axis in range(2):
            out[i, axis] = points[i, axis] + share * (out[i, axis] - points[i, axis])
    return out


CORNER = 55.0
"""Degrees. Two straight stretches that meet at a larger angle form a corner."""

BENDING = 1500.0, 15.0
"""Weights of bending (squared second differences): on stairs, to remove waves shorter than about 20 samples, and in
smooth parts, to remove waves shorter than about 6."""

SMOOTH = 0.25
"""Share of the tolerance by which smooth parts may move."""

ROUGH = 30.0, 70.0
"""Degrees of turning back and forth within `JOG` samples: smooth below the first, stairs above the second."""

JOG = 2
"""Samples on either side that contain both turns of a stair."""

SPREAD = 16
"""Samples on either side of a stair that belong to the staircase."""

SHRINKING = 0.005
"""Largest share by which bending may shrink a circle of the chain's area; limits the weight of bending."""

REACH = 8
"""Samples on either side that identify a corner; the nearest two may cut the corner off."""

STRAIGHTEST = 0.35
"""Share of the tolerance: largest distance of the samples on either side of a corner from a straight line."""

FITTING = 0.2
"""Share of the tolerance for the fit of cubics; smoothing gets the rest."""

FEWEST = 16
"""Least number of samples of a chain."""

MOST_ALONE, MOST_BETWEEN = 2**16, 256
"""Most samples of a chain: a constant, plus a number for each point. Only needles would need more."""

MOST = 256
"""Most samples that one cubic may replace."""

ONE_SIDED = 4
"""Samples that determine the direction beside a corner: the nearest one may belong to the corner itself."""

STEPS = 6
"""Most rounds of projection and least squares for one cubic."""


@kernel
def _tangent(points: NDArray[np.float64], at: int, before: int, after: int, out: NDArray[np.float64]) -> None:
    """Write the unit direction of the chain at a sample, from the samples `before` and `after` it."""
    n = len(points)
    a, b = points[(at - before) % n], points[(at + after) % n]
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = np.hypot(dx, dy)
    out[0], out[1] = (dx / length, dy / length) if length > 0.0 else (1.0, 0.0)


@kernel
def _fit_span(
    points: NDArray[np.float64],
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    tolerance: float,
    curve: NDArray[np.float64],
) -> float:
    """Write the cubic nearest to the points, with given unit tangents at its ends; return its distance."""
    n = len(points)
    p0, p3 = points[0], points[n - 1]
    x, y, squares = points[:, 0].copy(), points[:, 1].copy(), np.empty(n)
    t = np.empty(n)
    length = chord_parameters(points, t)
    first, last = length / 3.0, length / 3.0
    worst = np.inf
    for step in range(STEPS):
        if n > 2:
            a11, a12, a22, b1, b2 = 0.0, 0.0, 0.0, 0.0, 0.0
            along = start[0] * end[0] + start[1] * end[1]
            for i in range(1, n - 1):
                u, s = t[i], 1.0 - t[i]
                w0, w1, w2, w3 = s * s * s, 3.0 * s * s * u, 3.0 * s * u * u, u * u * u
                off_x = points[i, 0] - (w0 + w1) * p0[0] - (w2 + w3) * p3[0]
                off_y = points[i, 1] - (w0 + w1) * p0[1] - (w2 + w3) * p3[1]
                a11 += w1 * w1
                a12 -= w1 * w2 * along
                a22 += w2 * w2
                b1 += w1 * (off_x * start[0] + off_y * start[1])
                b2 -= w2 * (off_x * end[0] + off_y * end[1])
            determinant = a11 * a22 - a12 * a12
            if determinant > 1e-12 * a11 * a22:
                first, last = (b1 * a22 - b2 * a12) / determinant, (a11 * b2 - a12 * b1) / determinant
            if not (0.05 * length < first < length and 0.05 * length < last < length):
                first, last = length / 3.0, length / 3.0
        for axis in range(2):
            curve[0, axis], curve[3, axis] = p0[axis], p3[axis]
            curve[1, axis], curve[2, axis] = p0[axis] + first * start[axis], p3[axis] - last * end[axis]
        worst = project(x, y, t, curve, squares)
        if worst <= tolerance or (step == 2 and worst > 8.0 * tolerance > 0.0):
            break
    return worst


@kernel
def fit_samples(points: NDArray[np.float64], corner: NDArray[np.bool_], tolerance: float) -> NDArray[np.float64]:
    """Fit few cubics (m, 4, 2) to the samples (n, 2) of a closed chain; each is as long as the tolerance allows.

    Consecutive cubics have the same direction at their common point, except at corners.
    """
    n = len(points)
    begin, flattest = 0, np.inf
    for i in range(n):
        a, b, c = points[i - 1], points[i], points[(i + 1) % n]
        bent = abs(a[0] - 2.0 * b[0] + c[0]) + abs(a[1] - 2.0 * b[1] + c[1])
        if corner[i]:
            bent = -1.0
        if bent < flattest:
            begin, flattest = i, bent
    ring = np.empty((n + 1, 2))
    sharp = np.empty(n + 1, np.bool_)
    for i in range(n + 1):
        k = (begin + i) % n
        ring[i, 0], ring[i, 1], sharp[i] = points[k, 0], points[k, 1], corner[k]
    out = np.empty((n, 4, 2))
    count, at = 0, 0
    start, end = np.empty(2), np.empty(2)
    curve, best = np.empty((4, 2)), np.empty((4, 2))
    while at < n:
        limit = at + 1
        while limit < n and limit - at < MOST and not sharp[limit]:
            limit += 1
        _tangent(points, begin + at, 0 if sharp[at] else 1, min(ONE_SIDED, limit - at) if sharp[at] else 1, start)
        good, bad, step = at, limit + 1, 4
        while bad - good > 1:  # doubling, then bisection
            trial = min(at + step, limit) if bad > limit else (good + bad) // 2
            step *= 2
            _tangent(
                points, begin + trial, min(ONE_SIDED, trial - at) if sharp[trial] else 1, 0 if sharp[trial] else 1, end
            )
            if _fit_span(ring[at : trial + 1], start, end, tolerance, curve) <= tolerance or trial == at + 1:
                good = trial
                copy_curve(curve, best)
                if trial == limit:
                    break
            else:
                bad = trial
        copy_curve(best, out[count])
        if good > at + 1:  # refit as near as possible, rather than just within the tolerance
            _tangent(
                points, begin + good, min(ONE_SIDED, good - at) if sharp[good] else 1, 0 if sharp[good] else 1, end
            )
            if _fit_span(ring[at : good + 1], start, end, 0.0, curve) <= tolerance:
                copy_curve(curve, out[count])
        count += 1
        at = good
    return out[:count].copy()


def fit_closed(
    points: NDArray[np.float64],
    tolerance: float,
    corner: float = CORNER,
    fixed: NDArray[np.bool_] | None = None,
) -> NDArray[np.float64]:
    """Fit few cubics (m, 4, 2) to a closed chain of points (n, 2), within a tolerance in the units of the points.

    Stairs are smoothed: with a tolerance of half a cell or more, no trace of a raster's cells is left. Smooth parts are
    followed within a fraction of the tolerance. Two straight stretches that meet at more than `corner` degrees are
    extended to a corner. `fixed` (n,) marks points to keep as corners. At all other points, consecutive cubics have the
    same direction. A chain that is small compared to the tolerance becomes a small oval of about the same area.

    The first point is not repeated at the end. Each cubic starts, bit for bit, at the end of the previous one. A chain
    that encloses no area gives no cubics.
    """
    new = (points != np.roll(points, 1, axis=0)).any(axis=1)
    is_fixed = np.zeros(len(points), np.bool_) if fixed is None else fixed
    points, is_fixed = points[new], is_fixed[new]
    size = abs(_area(points - points[:1]))
    if len(points) < 3 or size == 0.0:
        return np.empty((0, 4, 2))
    length = float(np.hypot(*(points - np.roll(points, 1, axis=0)).T).sum())
    radius = float(np.sqrt(size / np.pi))
    tolerance = min(tolerance, radius / 2.0, size / length)
    allowed = MOST_ALONE + MOST_BETWEEN * len(points)
    samples, sharp = _sample_contour(points, is_fixed, max(min(tolerance, length / FEWEST), length / allowed))
    if len(samples) < 3:
        return line_cubics(points, np.roll(points, -1, axis=0))
    samples, sharp = _restore_corners(samples, sharp, tolerance, corner)
    stairs = _stairs(samples, sharp)
    most = SHRINKING * (radius * len(samples) / length) ** 4
    bending = np.minimum(most, BENDING[1] * (BENDING[0] / BENDING[1]) ** stairs)
    reach = (1.0 - FITTING) * tolerance * (SMOOTH + (1.0 - SMOOTH) * stairs)
    cubics = fit_samples(smooth_chain(samples, sharp, bending, reach), sharp, FITTING * tolerance)
    cubics[:, 0] = np.roll(cubics[:, 3], 1, axis=0)
    return cubics


def _sample_contour(
    points: NDArray[np.float64], fixed: NDArray[np.bool_], step: float
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Sample a contour at equal distances between its fixed points; mark the samples at fixed points."""
    first = int(np.argmax(fixed))
    closed = np.roll(points, -first, axis=0)
    stops = np.append(np.flatnonzero(np.roll(fixed, -first)), len(points))
    closed = np.concatenate([closed, closed[:1]])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))])
    if stops[0] != 0:
        stops = np.concatenate([[0], stops])
    places = [
        np.linspace(along[a], along[b], max(1, round((along[b] - along[a]) / step)), endpoint=False)
        for a, b in pairwise(stops)
    ]
    sharp = np.zeros(sum(map(len, places)), np.bool_)
    if fixed.any():
        sharp[np.cumsum([0, *map(len, places[:-1])])] = True
    joined = np.concatenate(places)
    return np.column_stack([np.interp(joined, along, closed[:, axis]) for axis in range(2)]), sharp


def _restore_corners(
    points: NDArray[np.float64], sharp: NDArray[np.bool_], tolerance: float, corner: float
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Move samples between two straight stretches to the corner of these; mark the samples that are corners."""
    n = len(points)
    points, sharp = points.copy(), sharp.copy()
    if n < 4 * REACH:
        return points, sharp
    ahead, behind = np.roll(points, -REACH, axis=0) - points, points - np.roll(points, REACH, axis=0)
    turn = np.abs(np.degrees(np.arctan2(_cross(behind, ahead), (behind * ahead).sum(axis=1))))
    taken = sharp.copy()
    for at in np.argsort(-turn, kind="stable")[: int((turn > corner).sum())]:
        around = np.arange(at - REACH, at + REACH + 1) % n
        if taken[around].any():
            continue
        after, before = points[around[REACH + 2 :]], points[around[: REACH - 1]]
        if max(_bulge(after), _bulge(before)) > STRAIGHTEST * tolerance:
            continue
        along, back = after[-1] - after[0], before[0] - before[-1]
        angle = _cross(along, back)
        place = after[0] + along * _cross(before[-1] - after[0], back) / angle if angle != 0.0 else points[at]
        if np.hypot(*(place - points[at])) <= tolerance:
            points[at], sharp[at], taken[at] = place, True, True
            for near in (at - 1, (at + 1) % n):  # the samples that cut the corner off
                points[near] = place + (points[2 * near - at - (n if 2 * near - at >= n else 0)] - place) / 2.0
    return points, sharp


def _bulge(side: NDArray[np.float64]) -> float:
    """Largest distance of points from the line through the first and the last."""
    chord = side[-1] - side[0]
    length = np.hypot(*chord)
    return float(np.abs(_cross(side - side[0], chord)).max() / length) if length > 0.0 else np.inf


def _stairs(points: NDArray[np.float64], sharp: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Degree, 0..1, to which the neighbourhood of each sample turns back and forth, as stairs do and curves do not."""
    step = np.roll(points, -1, axis=0) - points
    before = np.roll(step, 1, axis=0)
    turn = np.degrees(np.arctan2(_cross(before, step), (before * step).sum(axis=1)))
    turn[sharp] = 0.0
    near = range(-JOG, JOG + 1)
    rough = sum(np.roll(np.abs(turn), k) for k in near) - np.abs(sum(np.roll(turn, k) for k in near))
    share = np.clip((rough - ROUGH[0]) / (ROUGH[1] - ROUGH[0]), 0.0, 1.0)
    far = min(SPREAD, len(points) // 2)
    spread = np.lib.stride_tricks.sliding_window_view(np.pad(share, far, mode="wrap"), 2 * far + 1)
    found: NDArray[np.float64] = spread.max(axis=1)
    return found


def _cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _area(points: NDArray[np.float64]) -> float:
    return 0.5 * float(_cross(points, np.roll(points, -1, axis=0)).sum())
