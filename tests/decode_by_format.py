"""Decoder of a texture from its pixels alone, by FORMAT.md: its leaves, and inside or outside at points.

It shares no code with the package but the arrays of the texture.
"""

from typing import NamedTuple

import numpy as np

CHORDS = 256
CHORD_SAGITTA = 1e-4  # cell sides: |B''| <= 6 |(5.75, 5.75)| for control points in the format's range, / (8 CHORDS^2)
HEIGHTS = 128
AREA_ERROR = 2.0 / HEIGHTS
FULL, EMPTY = 0, 1  # rows of the curve texture
PIXEL_OF_CELL = (2, 3, 0, 1)


class Leaf(NamedTuple):
    """A cell that is not a quad: lower left corner, side, depth, row of the curve texture, whether it is a corner."""

    x: float
    y: float
    side: float
    depth: int
    row: int
    is_corner: bool

    @property
    def is_constant(self):
        return self.row in (FULL, EMPTY)


class Walk(NamedTuple):
    """Rows in the order in which a walk meets the references to them; all leaves; quads and leaves by their quad."""

    quads: list
    curves: list
    leaves: list
    children: dict
    leaves_of: dict


def walk(texture):
    """Walk the tree breadth first."""
    pixels = texture.quads / texture.maximum
    met, curves, leaves, children, leaves_of = [0], [], [], {}, {}
    squares = [(0.0, 0.0, 1.0, 0)]
    for row, (x, y, side, depth) in zip(met, squares, strict=True):  # both grow while they are walked
        children[row], leaves_of[row] = [], []
        for cell, pixel in enumerate(PIXEL_OF_CELL):
            red, green, _ = pixels[row, pixel]
            half = side / 2
            square = x + half * (cell & 1), y + half * (cell >> 1), half, depth + 1
            if red > 0.75:
                met.append(round(green * (len(texture.quads) - 1)))
                squares.append(square)
                children[row].append(met[-1])
                assert len(met) <= len(texture.quads), "a quad is met twice"
                continue
            leaf = Leaf(*square, round(green * (len(texture.curves) - 1)), bool(red > 0.25))
            leaves.append(leaf)
            leaves_of[row].append(leaf)
            if not leaf.is_constant:
                curves.append(leaf.row)
    return Walk(met, curves, leaves, children, leaves_of)


def on_edge(index):
    s = 4.0 * index
    f = s - np.floor(s)
    return np.array([(f, 1.0), (1.0, 1.0 - f), (1.0 - f, 0.0), (0.0, f)][int(s) % 4])


def line(texture, leaf):
    """Points along a leaf's curve or corner, from P0 to P3, in its cell's own unit square."""
    (e0, ax, bx), (e3, ay, by) = texture.curves[leaf.row] / texture.maximum
    p0, p3 = on_edge(e0), on_edge(e3)
    if leaf.is_corner:
        return np.array([p0, (ax, ay), p3])
    p1, p2 = (-1.25 + 3.5 * np.array(p) for p in ((ax, ay), (bx, by)))
    t = np.linspace(0.0, 1.0, CHORDS + 1)[:, None]
    s = 1.0 - t
    return s**3 * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t**3 * p3


def outline(texture, leaf):
    """The closed line that bounds what is filled: from P0 to P3, and clockwise along the cell's edge back to P0."""
    first, last = texture.curves[leaf.row, 1, 0] / texture.maximum, texture.curves[leaf.row, 0, 0] / texture.maximum
    last += last <= first
    corners = [on_edge(k / 4 % 1) for k in range(1, 8) if first < k / 4 < last]
    return np.concatenate([line(texture, leaf), np.reshape(corners, (-1, 2))])


def area(texture, leaf):
    """Filled part of a leaf by the even-odd rule, within `AREA_ERROR`: the mean over heights."""
    if leaf.is_constant:
        return float(leaf.row == FULL)
    a = outline(texture, leaf)
    b = np.roll(a, -1, axis=0)
    total = 0.0
    for y in (np.arange(HEIGHTS) + 0.5) / HEIGHTS:
        meets = (a[:, 1] <= y) != (b[:, 1] <= y)
        (x0, y0), (x1, y1) = a[meets].T, b[meets].T
        x = np.sort(x0 + (y - y0) / (y1 - y0) * (x1 - x0))
        total += (x[1::2] - x[::2]).sum()
    return total / HEIGHTS


def inside(texture, leaf, points):
    """Whether points of the unit square, (n, 2), that lie in a leaf are filled."""
    if leaf.is_constant:
        return np.full(len(points), leaf.row == FULL)
    x, y = ((points - (leaf.x, leaf.y)) / leaf.side).T[:, :, None]
    a = outline(texture, leaf)
    b = np.roll(a, -1, axis=0)
    straddle = (a[:, 1] <= y) != (b[:, 1] <= y)
    with np.errstate(all="ignore"):
        at = a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return (straddle & (at < x)).sum(axis=1) % 2 == 1


def leaf_at(leaves, points):
    """Index of the leaf that holds each point, (n,)."""
    squares = np.array([leaf[:3] for leaf in leaves])
    found = np.full(len(points), -1)
    for k, (x, y, side) in enumerate(squares):
        found[((points >= (x, y)) & (points < (x + side, y + side))).all(axis=1)] = k
    return found
