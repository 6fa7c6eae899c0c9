"""Random drawings that are as degenerate as drawings get, and a brute-force answer to what is inside.

Ends on cell lines, shared borders in both directions, repeated and nearly repeated contours, tangencies, slivers,
T-junctions, many paths through one point. Everything is drawn from a seeded generator.
"""

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing, FillRule, Path

QUARTER = 0.5522847498307936  # control length of a quarter circle


def line(a, b):
    a, b = np.asarray(a, float), np.asarray(b, float)
    return np.array([a, a + (b - a) / 3, a + (b - a) * 2 / 3, b])


def polygon(points):
    points = np.asarray(points, float)
    return np.array([line(points[i - 1], points[i]) for i in range(len(points))])


def circle(center, radius):
    k = QUARTER
    ring = [
        (1, 0),
        (1, k),
        (k, 1),
        (0, 1),
        (-k, 1),
        (-1, k),
        (-1, 0),
        (-1, -k),
        (-k, -1),
        (0, -1),
        (k, -1),
        (1, -k),
        (1, 0),
    ]
    points = np.array(ring) * radius + center
    points[-1] = points[0]
    return np.array([points[3 * i : 3 * i + 4] for i in range(4)])


def star(spikes, step, center=(0.5, 0.5), radius=0.45, turn=0.1):
    angle = turn + 2 * np.pi * step * np.arange(spikes) / spikes
    return polygon(np.column_stack((np.cos(angle), np.sin(angle))) * radius + center)


def backwards(contour):
    return contour[::-1, ::-1].copy()


def closed(points, controls):
    """Contour through points with free inner control points, (n, 2) and (n, 2, 2)."""
    following = np.roll(points, -1, axis=0)
    return np.stack([points, controls[:, 0], controls[:, 1], following], axis=1)


def _on_grid(rng, n, steps):
    return closed(rng.integers(0, steps + 1, (n, 2)) / steps, rng.integers(0, steps + 1, (n, 2, 2)) / steps)


def _random_cubics(rng, n):
    return closed(rng.random((n, 2)) * 0.9 + 0.05, rng.random((n, 2, 2)) * 0.96 + 0.02)


def _shift_contour(rng, contour):
    return np.clip(contour + rng.normal(size=2) * 10.0 ** -rng.integers(3, 14), 0, 1)


def _jitter_contour(rng, contour):
    moved = np.clip(contour + rng.normal(size=contour.shape) * 10.0 ** -rng.integers(3, 14), 0, 1)
    moved[:, 3] = np.roll(moved[:, 0], -1, axis=0)
    return moved


def _bar(rng):
    y, height = rng.random() * 0.9, 10.0 ** -rng.integers(2, 10)
    bar = polygon([(0.1, y), (0.9, y + height * rng.random()), (0.9, y + height), (0.1, y + height * rng.random())])
    return bar[:, :, ::-1].copy() if rng.random() < 0.5 else bar


def contours(rng):
    """One to five contours of one kind."""
    kind, steps = rng.integers(0, 7), rng.choice([8, 16, 64, 7, 1000])
    base = _random_cubics(rng, rng.integers(2, 7))
    out = []
    for _ in range(rng.integers(1, 6)):
        n = rng.integers(2, 7)
        match kind:
            case 0:
                contour = polygon(rng.integers(0, steps + 1, (n + 1, 2)) / steps)
            case 1:
                contour = _on_grid(rng, n, steps)
            case 2:
                contour = _random_cubics(rng, n)
            case 3:
                contour = circle(rng.integers(3, 6, 2) / 8, rng.integers(1, 4) / 8)
            case 4:
                contour = _shift_contour(rng, base)
            case 5:
                contour = _jitter_contour(rng, base)
            case _:
                contour = _bar(rng)
        contour = contour[(contour != contour[:, :1]).any(axis=(1, 2))]  # no cubic that is one point
        if len(contour):
            out.append(backwards(contour) if rng.random() < 0.4 else contour)
    return out


def drawing(seed: int) -> Drawing:
    """Degenerate drawing: one path of all contours, or a path for each."""
    rng = np.random.default_rng(seed)
    found = contours(rng)
    if rng.random() < 0.3 and found:
        return Drawing((Path(tuple(found), FillRule(int(rng.integers(0, 2)))),))
    return Drawing(tuple(Path((contour,), FillRule(int(rng.integers(0, 2)))) for contour in found))


def _free(rng):
    points = rng.uniform(0.05, 0.95, (rng.integers(2, 6), 2))
    return closed(points, rng.uniform(0.02, 0.98, (len(points), 2, 2)))


def _cusps(rng):
    """Cubics that turn back in a point, or in a loop or a bend as small as rounding."""
    points = rng.uniform(0.2, 0.8, (rng.integers(2, 5), 2))
    chord = np.roll(points, -1, axis=0) - points
    tips = points + chord * 0.5 + chord[:, ::-1] * rng.uniform(-0.2, 0.2, 2)
    controls = np.stack([tips + chord / 2, tips - chord / 2], axis=1)
    return np.clip(closed(points, controls + _nearly(rng, controls.shape)), 0.0, 1.0)


def _flat(rng):
    """A sliver: all points nearly on one line, which may be level, upright or a diagonal."""
    along = rng.uniform(0.05, 0.95, (rng.integers(2, 6), 3, 1))
    line = np.array([(0.0, rng.random()), (1.0, rng.random())])
    if rng.random() < 0.7:
        line[1, 1] = rng.choice([line[0, 1], 1.0])
        line[0, 1] = line[1, 1] if line[1, 1] < 1.0 else 0.0
    line = line[:, ::-1] if rng.random() < 0.5 else line
    points = line[0] + along * (line[1] - line[0]) + _nearly(rng, (len(along), 3, 2))
    return np.clip(closed(points[:, 0], points[:, 1:]), 0.0, 1.0)


def _on_cells(rng):
    """Ends and controls on the lines and corners of cells, or nearly."""
    steps = 2 ** rng.integers(1, 9)
    contour = _on_grid(rng, rng.integers(2, 6), steps)
    if rng.random() < 0.5:  # straight edges, many of them along lines
        contour = polygon(contour[:, 0])
    moved = np.clip(contour + _nearly(rng, contour.shape), 0.0, 1.0)
    moved[:, 3] = np.roll(moved[:, 0], -1, axis=0)
    return moved


def _through_a_corner(rng):
    """A fan of edges through one corner of cells, or nearly through it."""
    corner = rng.integers(1, 8, 2) / 8
    points = np.clip(corner + rng.uniform(-0.5, 0.5, (rng.integers(2, 5), 2)), 0.02, 0.98)
    fan = np.insert(points, range(1, len(points) + 1), corner, axis=0)
    return polygon(np.clip(fan + _nearly(rng, fan.shape), 0.0, 1.0))


def _nearly(rng, shape):
    """Shifts of 1e-12 to 1e-6, or none."""
    return rng.uniform(-1.0, 1.0, shape) * rng.choice([0.0, 0.0, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6])


OUTLINES = {"free": _free, "cusps": _cusps, "flat": _flat, "cells": _on_cells, "corner": _through_a_corner}


def roll_contour(contour, copy):
    """Start a contour elsewhere; every other copy is reversed."""
    turned = np.roll(contour, copy, axis=0)
    return turned if copy % 2 == 0 else backwards(turned)


def move_points(contour, distance, rng):
    """Move each vertex and control point of a contour."""
    contour = contour.copy()
    contour[:, 0] += rng.uniform(-distance, distance, (len(contour), 2))
    contour[:, 3] = np.roll(contour[:, 0], -1, axis=0)
    contour[:, 1:3] += rng.uniform(-distance, distance, (len(contour), 2, 2))
    return np.clip(contour, 0.0, 1.0)


def heap(seed, counts, distance, rule, kind="free"):
    """Copies of outlines of one kind, so many of each, at most so far apart, from any start and either way round."""
    rng = np.random.default_rng(seed)
    contours = []
    for copies in counts:
        contour = OUTLINES[kind](rng)
        for copy in range(copies):
            start = rng.integers(len(contour))
            turned = np.roll(contour if rng.random() < 0.6 else backwards(contour), start, axis=0)
            contours.append(move_points(turned, distance, rng) if copy else contour)
    return Drawing((Path(tuple(contours), rule),) if seed % 2 else tuple(Path((each,), rule) for each in contours))


def polyline(cubic: NDArray[np.float64], chords: int) -> NDArray[np.float64]:
    t = np.linspace(0, 1, chords + 1)[:, None]
    s = 1 - t
    out = s**3 * cubic[0] + 3 * s * s * t * cubic[1] + 3 * s * t * t * cubic[2] + t**3 * cubic[3]
    out[0], out[-1] = cubic[0], cubic[3]
    return out


def path_windings(of: Drawing, points, chords=256):
    """Winding number of each path at points, (paths, n), and the points' distance from the nearest outline.

    By chords: the caller must keep clear of the outline by more than a chord's sagitta.
    """
    cubics = [np.concatenate([np.empty((0, 4, 2)), *path.contours]) for path in of.paths]
    windings, distances = zip(*(cubic_windings(each, points, chords) for each in cubics), strict=True)
    return np.array(windings), np.min(distances, axis=0)


def cubic_windings(cubics, points, chords=256):
    """Winding number of closed contours at points, and the points' distance from them; see `path_windings`."""
    windings, distance = np.zeros(len(points), int), np.full(len(points), np.inf)
    x, y = points[:, :1], points[:, 1:]
    for cubic in cubics:
        q = polyline(cubic, chords)
        a, b = q[:-1], q[1:]
        up, down = (a[:, 1] <= y) & (y < b[:, 1]), (b[:, 1] <= y) & (y < a[:, 1])
        with np.errstate(all="ignore"):
            at = a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
        left = at < x
        windings += (down & left).sum(axis=1) - (up & left).sum(axis=1)
        step = b - a
        length = np.maximum((step**2).sum(axis=1), 1e-300)
        t = np.clip(((x - a[:, 0]) * step[:, 0] + (y - a[:, 1]) * step[:, 1]) / length, 0, 1)
        off = np.hypot(x - a[:, 0] - t * step[:, 0], y - a[:, 1] - t * step[:, 1])
        distance = np.minimum(distance, off.min(axis=1))
    return windings, distance


def silhouette(of: Drawing, windings):
    """Whether points are inside, from `path_windings`."""
    inside = np.zeros(windings.shape[1], bool)
    for path, w in zip(of.paths, windings, strict=True):
        inside |= (w & 1 != 0) if path.fill_rule == FillRule.EVENODD else w != 0
    return inside


def points_near(of: Drawing, rng, count):
    """Random points: half anywhere, half at 10^-5.5 to 10^-2 from an outline."""
    anywhere = rng.random((count // 2, 2))
    cubics = np.concatenate([contour for path in of.paths for contour in path.contours])
    chosen, t = cubics[rng.integers(0, len(cubics), count - count // 2)], rng.random((count - count // 2, 1))
    s = 1 - t
    on = s**3 * chosen[:, 0] + 3 * s * s * t * chosen[:, 1] + 3 * s * t * t * chosen[:, 2] + t**3 * chosen[:, 3]
    angle, off = rng.random(len(on)) * 2 * np.pi, 10.0 ** rng.uniform(-5.5, -2, len(on))
    near = on + off[:, None] * np.column_stack((np.cos(angle), np.sin(angle)))
    points = np.concatenate([anywhere, near])
    return points[((points > 0) & (points < 1)).all(axis=1)]
