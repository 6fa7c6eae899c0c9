"""A decoder of planar maps, part D, written from FORMAT.md alone."""

from collections import namedtuple

import numpy as np
from decoder import (
    Texture,
    check_used,
    locate,
    need,
    read_cells,
    read_ktx2,
    read_points,
    read_shapes,
    refusing,
    sample_points,
    trace,
)

KINDS = [0, 2, 128, *(8 * n for n in range(1, 16))]  # D.2
# Arrays [quad - root, cell k]: the quad below less the root, or -1; the leaf's first curve, of those of the map; how
# many it has; its base paint; whether only its mean is known; the mean colour. Then for each curve the points in units
# of the lattice, the paints on its left and on its right; and the colours of the paints. Colours are sRGB, 0..1,
# premultiplied: red, green, blue, opacity.
Map = namedtuple("Map", "child first count base mean_only mean curves left right paints")


def part(words: np.ndarray, first: int, count: int) -> np.ndarray:
    """Return the indices of a part's texels (D.1)."""
    need(0 <= first <= first + count <= len(words), "a part beyond the texture")
    return np.arange(first, first + count)


def read_map(words: np.ndarray, root: int) -> tuple[Map, np.ndarray]:
    """Return the map with this root quad, and the indices of the texels of its parts (D.1 to D.5)."""
    need(0 < root < len(words), "no head")
    p, cells, sides, paints = words[root - 1].tolist()
    need(1 <= p <= 65536, "number of paints")
    quads, curves = trace(words, [root], KINDS)
    c, n, m = min(curves, default=0), len(quads), len(curves)
    need((np.sort(quads) == np.arange(root, root + n)).all(), "quads are not consecutive")
    need((np.sort(curves) == np.arange(c, c + m)).all(), "curves are not consecutive")
    points = read_points(words[c : c + m])
    need(not words[quads, 3].any() and (points[:, 0, 1] <= points[:, 3, 1]).all(), "word 3 or a curve that goes down")

    at_cells = part(words, cells, 2 * n)
    mean = words[at_cells[::2], :, None] >> np.array([0, 8, 16, 24]) & 255
    base = words[at_cells[1::2]]
    at_sides = part(words, sides + c // 4, (c + m - 1) // 4 - c // 4 + 1) if m else np.arange(0)
    left, right = (words[at_sides].reshape(-1)[c % 4 :][:m] >> shift & 65535 for shift in (0, 16))
    need(max(base.max(), left.max(initial=0), right.max(initial=0)) < p, "a paint beyond the table")
    at_paints = part(words, paints, (p + 1) // 2)
    colors = (words[at_paints, :, None] >> np.array([0, 16]) & 65535).reshape(-1, 4)[:p]
    need(all((color[..., :3] <= color[..., 3:]).all() for color in (mean, colors)), "a colour above its opacity")

    kind, child, first, n_curves = (array[root : root + n] for array in read_cells(words))
    need(not base[(kind == 128) | (kind == 2)].any(), "a base paint where there is none")
    used = np.concatenate([[root - 1], quads, curves, at_cells, at_sides, at_paints])
    arrays = np.where(child < 0, -1, child - root), np.where(n_curves > 0, first - c, 0), n_curves
    return Map(*arrays, base, kind == 2, mean / 255, points, left, right, colors / 65535), used


@refusing()
def read_style(root: dict, planar: Map) -> tuple[list[dict], list[list[int]]]:
    """Return the elements of a map, each with its place in the style, and the stacks of its paints (D.9)."""
    elements, groups, stacks = (root["style"][key] for key in ("elements", "groups", "stacks"))
    need(all(-1 <= group["outer"] < k and 0 <= group["opacity"] <= 1 for k, group in enumerate(groups)), "groups")
    need(all(-1 <= element.get("group", -1) < len(groups) for element in elements), "the group of an element")
    need(len(stacks) == len(planar.paints), "as many stacks as paints")
    need(all(0 <= place < len(elements) for stack in stacks for place in stack), "an element beyond the list")
    return elements, stacks


def composited(elements: list[dict], stack: list[int]) -> np.ndarray:
    """Return the colour of a stack in which no element is in a group (D.9)."""
    color = np.zeros(4)
    for place in stack:
        need("group" not in elements[place], "no group, as this decoder composites none")
        opacity = elements[place].get("opacity", 1)
        color = opacity * np.array([*elements[place]["color"], 1]) + (1 - opacity) * color
    return color


@refusing()
def read_maps(data: bytes) -> tuple[list[dict], Texture, list[Map | None]]:
    """Read a KTX2 file: its roots; its shapes, of part B; for each root the map, or None for a shape (D)."""
    version, roots, words = read_ktx2(data)
    is_map = [root.get("map", False) for root in roots]
    need(all(isinstance(yes, bool) for yes in is_map), "map is true or false")
    need(version == "2" and any(is_map), "version")
    need(not any("paint" in root for root, yes in zip(roots, is_map, strict=True) if yes), "a map with a paint")
    shapes, used = read_shapes(words, [root for root, yes in zip(roots, is_map, strict=True) if not yes])
    maps = {q: read_map(words, q) for q in {r["quad"] for r, yes in zip(roots, is_map, strict=True) if yes}}
    check_used(words, np.concatenate([used, *(indices for _, indices in maps.values())]))
    return roots, shapes, [maps[r["quad"]][0] if yes else None for r, yes in zip(roots, is_map, strict=True)]


def at_height(curves: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the x of each monotone curve at its y, which it meets: by bisection."""
    low, high = np.zeros(len(y)), np.ones(len(y))
    p0, p1, p2, p3 = np.moveaxis(curves, 1, 0)[..., None]  # each [curve, axis, 1]

    def at(t: np.ndarray, axis: int) -> np.ndarray:
        s = 1 - t
        ends = s**3 * p0[:, axis, 0] + t**3 * p3[:, axis, 0]
        return ends + 3 * s * t * (s * p1[:, axis, 0] + t * p2[:, axis, 0])

    for _ in range(40):
        middle = (low + high) / 2
        below = at(middle, 1) <= y
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return at(low, 0)


def counts(planar: Map, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return points, paints and how often each is counted there, if not 0 (D.6). Where only a mean is known, none."""
    square, quad, k, x, y = locate(planar.child, 0, x, y)
    square &= ~planar.mean_only[quad, k]
    x, y, number = 32768 * x, 32768 * y, np.where(square, planar.count[quad, k], 0)
    start = np.flatnonzero(square)
    events = [(start, planar.base[quad[start], k[start]], np.ones(len(start), int))]
    for i in range(number.max(initial=0)):
        at = np.flatnonzero(number > i)
        curve = planar.first[quad[at], k[at]] + i
        (x0, y0), (x3, y3) = planar.curves[curve, 0].T, planar.curves[curve, 3].T
        more = 1 * ((x0 == 0) & (y0 <= y[at])) - ((x3 == 0) & (y3 <= y[at]))
        meets = np.flatnonzero((y0 <= y[at]) & (y[at] < y3))
        more[meets] -= at_height(planar.curves[curve[meets]], y[at[meets]]) <= x[at[meets]]
        events += [(at, planar.left[curve], more), (at, planar.right[curve], -more)]
    point, paint, more = (np.concatenate(column) for column in zip(*events, strict=True))
    keys, place = np.unique(point * len(planar.paints) + paint, return_inverse=True)
    count = np.bincount(place, more, minlength=len(keys)).astype(int)
    return *np.divmod(keys[count != 0], len(planar.paints)), count[count != 0]


def paint_at(planar: Map, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the paint at each point (D.6), or -1: outside, where only a mean is known, and in slivers."""
    point, paint, count = counts(planar, x, y)
    alone = (np.bincount(point, minlength=np.size(x))[point] == 1) & (count == 1)
    answer = np.full(np.size(x), -1)
    answer[point[alone]] = paint[alone]
    return answer


def color_at(planar: Map, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the colour at each point; in slivers what the counts add up to (D.6, D.7)."""
    square, quad, k, *_ = locate(planar.child, 0, x, y)
    color = np.where((square & planar.mean_only[quad, k])[:, None], planar.mean[quad, k], 0)
    point, paint, count = counts(planar, x, y)
    np.add.at(color, point, count[:, None] * planar.paints[paint])
    return color


def map_picture(planar: Map, size: int, samples: int = 6) -> np.ndarray:
    """Return size x size pixels [row, column, channel], the top row first, by samples x samples points in each."""
    colors = color_at(planar, *sample_points(size, samples))
    return colors.reshape(size, samples, size, samples, 4).mean(axis=(1, 3))
