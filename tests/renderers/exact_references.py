"""Truths written without the renderer's ideas: no chords, no slabs, no sweep."""

import numpy as np

from vexture.drawing import FillRule

SCANLINES = 1 << 14


def convex_coverage(corners, size):
    """Part of each pixel inside a convex polygon in pixel coordinates: half-plane clipping and the shoelace formula."""
    image = np.zeros(size[::-1])
    centre = np.mean(corners, axis=0)
    for row, column in np.ndindex(*image.shape):
        part = list(np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) + np.array([column, row], float))
        for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            normal = np.array([a[1] - b[1], b[0] - a[0]])
            normal *= np.sign(normal @ (centre - a))
            before, part = part, []
            for p, q in zip(before, before[1:] + before[:1], strict=True):
                p_in, q_in = normal @ (p - a), normal @ (q - a)
                if p_in >= 0:
                    part.append(p)
                if (p_in >= 0) != (q_in >= 0):
                    part.append(p + p_in / (p_in - q_in) * (q - p))
        twice = sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(part, part[1:] + part[:1], strict=True))
        image[row, column] = abs(twice) / 2
    return image


def crossings(cubic, heights):
    """Where a cubic (pixel coordinates) meets horizontal lines: number of the line, x, direction."""
    x, y = cubic.T
    slope = np.polynomial.Polynomial([y[1] - y[0], 2 * (y[2] - 2 * y[1] + y[0]), y[3] - y[0] + 3 * (y[1] - y[2])])
    roots = slope.trim(1e-12 * np.abs(slope.coef).max()).roots()
    turns = [t.real for t in roots if abs(t.imag) < 1e-12 and 0 < t.real < 1]
    parts = []

    def bernstein(p, t):
        return (1 - t) ** 3 * p[0] + 3 * (1 - t) ** 2 * t * p[1] + 3 * (1 - t) * t**2 * p[2] + t**3 * p[3]

    cuts = [0.0, *sorted(turns), 1.0]
    ends = [y[0], *(bernstein(y, t) for t in sorted(turns)), y[3]]
    for k in range(len(cuts) - 1):
        rising = ends[k + 1] > ends[k]
        line = np.flatnonzero((min(ends[k : k + 2]) <= heights) & (heights < max(ends[k : k + 2])))
        low, high = np.full(len(line), cuts[k]), np.full(len(line), cuts[k + 1])
        for _ in range(48):
            middle = 0.5 * (low + high)
            beyond = (bernstein(y, middle) > heights[line]) == rising
            low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
        parts.append((line, bernstein(x, 0.5 * (low + high)), np.full(len(line), 1 if rising else -1)))
    return [np.concatenate(column) for column in zip(*parts, strict=True)]


def coverage_of_row(drawing, to_pixel, width, row, scanlines=SCANLINES):
    """Coverage of one row of pixels, (width,), in an affine view; `to_pixel` is (2, 3).

    Exact crossings along very many scanlines, averaged: midpoint quadrature in y, to which a horizontal edge inside a
    pixel costs at most half a scanline.
    """
    heights = row + (np.arange(scanlines) + 0.5) / scanlines
    found = []
    for number, path in enumerate(drawing.paths):
        for contour in path.contours:
            for cubic in contour @ to_pixel[:, :2].T + to_pixel[:, 2]:
                line, x, direction = crossings(cubic, heights)
                found.append((line, x, direction, np.full(len(line), number)))
    line, x, direction, number = [np.concatenate(column) for column in zip(*found, strict=True)]
    order = np.lexsort((x, line))
    line, x, direction, number = line[order], x[order], direction[order], number[order]
    inside = np.zeros(len(line), bool)
    for k, path in enumerate(drawing.paths):
        winding = np.cumsum(np.where(number == k, direction, 0))  # contours are closed: 0 at the end of each line
        inside |= (winding % 2 == 1) if path.fill_rule == FillRule.EVENODD else (winding != 0)
    begin, end = x[:-1][inside[:-1]], x[1:][inside[:-1]]
    columns = np.arange(width)
    covered = [np.clip(end - c, 0, 1).sum() - np.clip(begin - c, 0, 1).sum() for c in columns]
    return np.array(covered) / scanlines
