"""Truths written without the renderer's ideas: no chords, no slabs, no sweep."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import FillRule
from vexture.drawing.group import Blend, Mask

SCANLINES = 1 << 14
LUM = np.array([0.3, 0.59, 0.11])
"""The W3C's Lum."""


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


class Spans(NamedTuple):
    """What very many scanlines of one row of pixels find between two outlines."""

    begin: NDArray[np.float64]  # (n,): x, pixels
    end: NDArray[np.float64]  # (n,)
    inside: NDArray[np.bool_]  # (n, paths)


def spans_of_row(drawing, to_pixel, row, scanlines=SCANLINES):
    """All spans of a row, in an affine view; `to_pixel` is (2, 3)."""
    heights = row + (np.arange(scanlines) + 0.5) / scanlines
    found = []
    for number, path in enumerate(drawing.paths):
        for contour in path.contours:
            for cubic in contour @ to_pixel[:, :2].T + to_pixel[:, 2]:
                line, x, direction = crossings(cubic, heights)
                found.append((line, x, direction, np.full(len(line), number)))
    line, x, direction, number = [np.concatenate(column) for column in zip(*found, strict=True)]
    order = np.lexsort((x, line))
    x, direction, number = x[order], direction[order], number[order]
    inside = np.zeros((len(x), len(drawing.paths)), bool)
    for k, path in enumerate(drawing.paths):
        winding = np.cumsum(np.where(number == k, direction, 0))  # contours are closed: 0 at the end of each line
        inside[:, k] = (winding % 2 == 1) if path.fill_rule == FillRule.EVENODD else (winding != 0)
    return Spans(x[:-1], x[1:], inside[:-1])


def integrals(spans, values, width):
    """Sum over the spans of a value times the length in each pixel, (width, ...)."""
    columns = range(width)
    return np.array([(np.clip(spans.end - c, 0, 1) - np.clip(spans.begin - c, 0, 1)) @ values for c in columns])


def coverage_of_row(drawing, to_pixel, width, row, scanlines=SCANLINES):
    """Coverage of one row of pixels, (width,), in an affine view; `to_pixel` is (2, 3).

    Exact crossings along very many scanlines, averaged: midpoint quadrature in y, to which a horizontal edge inside a
    pixel costs at most half a scanline.
    """
    spans = spans_of_row(drawing, to_pixel, row, scanlines)
    return integrals(spans, spans.inside.any(axis=1), width) / scanlines


def colours_of_row(drawing, to_pixel, width, row, scanlines=SCANLINES):
    """Colours of one row of pixels, (width, 4), as `coverage_of_row`; each face by `composite`."""
    spans = spans_of_row(drawing, to_pixel, row, scanlines)
    numbers = spans.inside @ (1 << np.arange(len(drawing.paths)))
    _, some, which = np.unique(numbers, return_index=True, return_inverse=True)
    colours = np.array([composite(drawing, spans.inside[k]) for k in some]).reshape(-1, 4)
    return integrals(spans, colours[which], width) / scanlines


def composite(drawing, inside, group=-1):
    """Premultiplied colour of a group, or of the whole drawing, where some paths are inside: group by group."""
    colour, drawn = np.zeros(4), {-1}
    for path, is_inside in zip(drawing.paths, inside, strict=True):
        around = [-1, *drawing.around(path.group), -1]
        if group not in around:
            continue
        inner = around[around.index(group) + 1]  # the group in this one that the path is in, or -1
        if inner not in drawn and not drawing.groups[inner].mask:
            of_group = drawing.groups[inner]
            colour = mix_colours(of_group.opacity * composite(drawing, inside, inner), colour, of_group.blend)
        elif inner == -1 and is_inside:
            colour = mix_colours(np.multiply((*path.paint.color, 1.0), path.paint.opacity), colour, Blend.NORMAL)
        drawn.add(inner)
    for place, mask in enumerate(drawing.groups):
        if mask.mask and mask.outer == group:
            luminance = (0.2125, 0.7154, 0.0721, 0.0) if mask.mask is Mask.LUMINANCE else (0.0, 0.0, 0.0, 1.0)
            colour = colour * mask.opacity * np.dot(composite(drawing, inside, place), luminance)
    return colour


def mix_colours(source, backdrop, blend):
    """The W3C's compositing, of premultiplied colours."""
    if blend == Blend.PLUS_LIGHTER:
        return np.minimum(source + backdrop, 1.0)
    over, under = source[3], backdrop[3]
    if over == 0.0 or under == 0.0:
        return source + backdrop
    both = blend_colours(blend, np.minimum(backdrop[:3] / under, 1.0), np.minimum(source[:3] / over, 1.0))
    colour = (1 - under) * source[:3] + (1 - over) * backdrop[:3] + over * under * both
    return np.array([*colour, over + under - over * under])


def blend_colours(blend, cb, cs):
    """B(cb, cs) of straight colours, (3,), as the W3C writes it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        hard = [np.where(s <= 0.5, b * 2 * s, b + (2 * s - 1) - b * (2 * s - 1)) for b, s in ((cb, cs), (cs, cb))]
        light = np.where(cb <= 0.25, ((16 * cb - 12) * cb + 4) * cb, np.sqrt(cb))
        return {
            Blend.NORMAL: lambda: cs,
            Blend.MULTIPLY: lambda: cb * cs,
            Blend.SCREEN: lambda: 1 - (1 - cb) * (1 - cs),
            Blend.OVERLAY: lambda: hard[1],
            Blend.DARKEN: lambda: np.minimum(cb, cs),
            Blend.LIGHTEN: lambda: np.maximum(cb, cs),
            Blend.COLOR_DODGE: lambda: np.where(cb == 0, 0, np.where(cs == 1, 1, np.minimum(1, cb / (1 - cs)))),
            Blend.COLOR_BURN: lambda: np.where(cb == 1, 1, np.where(cs == 0, 0, 1 - np.minimum(1, (1 - cb) / cs))),
            Blend.HARD_LIGHT: lambda: hard[0],
            Blend.SOFT_LIGHT: lambda: np.where(
                cs <= 0.5, cb - (1 - 2 * cs) * cb * (1 - cb), cb + (2 * cs - 1) * (light - cb)
            ),
            Blend.DIFFERENCE: lambda: np.abs(cb - cs),
            Blend.EXCLUSION: lambda: cb + cs - 2 * cb * cs,
            Blend.HUE: lambda: set_lum(set_sat(cs, np.ptp(cb)), LUM @ cb),
            Blend.SATURATION: lambda: set_lum(set_sat(cb, np.ptp(cs)), LUM @ cb),
            Blend.COLOR: lambda: set_lum(cs, LUM @ cb),
            Blend.LUMINOSITY: lambda: set_lum(cb, LUM @ cs),
        }[blend]()


def set_sat(colour, saturation):
    least, middle, most = np.argsort(colour, kind="stable")
    result = np.zeros(3)
    if colour[most] > colour[least]:
        result[middle] = (colour[middle] - colour[least]) * saturation / (colour[most] - colour[least])
        result[most] = saturation
    return result


def set_lum(colour, luminosity):
    colour = colour + (luminosity - LUM @ colour)
    light = LUM @ colour
    if colour.min() < 0:
        colour = light + (colour - light) * light / (light - colour.min())
    if colour.max() > 1:
        colour = light + (colour - light) * (1 - light) / (colour.max() - light)
    return colour
