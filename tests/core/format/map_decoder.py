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
from picture_decoder import check_picture, check_pixels, picture_color

KINDS = [0, 4, 2, 128, *(8 * n + more for n in range(1, 16) for more in (0, 1, 4, 5))]  # D.2
# Arrays [quad - root, cell k]: the quad below less the root, or -1; the leaf's first curve, of those of the map; how
# many it has; its base paint; whether only its mean is known; the mean colour. Then for each curve the points in units
# of the lattice, the paints on its left and on its right; the colours of the paints; the programs of some of them, each
# a list of operations: kind, texels, first stop or texel of pixels; offset and colour of all stops; texels of pixels.
# Colours are sRGB, 0..1, premultiplied but for those of stops: red, green, blue, opacity.
Map = namedtuple("Map", "child first count base mean_only mean curves left right paints programs stops pixels")


def part(words: np.ndarray, first: int, count: int) -> np.ndarray:
    """Return the indices of a part's texels (D.1)."""
    need(0 <= first <= first + count <= len(words), "a part beyond the texture")
    return np.arange(first, first + count)


def read_programs(words: np.ndarray, first: int, parts: list[int], runs: dict) -> dict[int, list[list]]:
    """Return the operations of each program, as lists of texels of one operation each (D.6)."""
    count, stops, number_of_pixels = parts
    at, programs, pictures = first, {}, set()
    first_pixel = first + count + stops
    pixels = words[first_pixel : first_pixel + number_of_pixels]
    for paint, (begin, length) in runs.items():
        need(begin == at and 1 <= length <= 64, "programs follow one another")
        at += length
        need(at <= first + count, "a program beyond its part")
        programs[paint], row, opened = [], begin, 0
        while row < at:
            kind, rest = divmod(int(words[row, 3]), 1 << 29)
            size = {0: 3, 1: 1, 2: 1, 3: 2, 4: 3, 5: 1, 6: 1}.get(kind, 0)
            texels = words[row : row + size].astype(np.uint32)
            need(size and row + size <= at, "operation")
            place = row + (rest & 0x7FFFF) - first - count
            if kind == 0:
                picture = check_picture(texels, first_pixel - row, pixels)
                pictures.add(picture)
                place = picture.first
            else:
                need((texels[1:, 3] == 7 << 29).all(), "operation")
                check_operation(kind, rest, texels, first + count - row, first + count + stops - row, words[row:])
            opened += (kind == 5) - (kind == 6)
            need(0 <= opened <= 3, "groups")
            programs[paint].append((kind, texels, place))
            row += size
        need(opened == 0, "a group is not ended")
        number = [int(texels[0, 3]) >> 19 & 255 for kind, texels, _ in programs[paint] if 2 <= kind <= 4]
        need(sum(number) <= 255, "stops of a program")
    need(at == first + count, "operations of no program")
    check_pixels(pixels, pictures)
    return programs


def check_operation(kind: int, rest: int, texels: np.ndarray, low: int, high: int, words: np.ndarray) -> None:
    """Refuse what D.6 does not allow; stops lie in words[low:high]."""
    numbers = texels[:, :3].copy().view(np.float32)
    if 2 <= kind <= 4:
        first, count, spread = rest & 0x7FFFF, rest >> 19 & 255, rest >> 27
        need(np.isfinite(numbers).all() and spread <= 2, "gradient")
        need(kind < 4 or (not np.signbit(numbers[2, :2]).any() and texels[2, 2] == 0), "focal circle")
        need(low <= first and count > 0 and first + count <= high, "stops elsewhere")
        offsets = words[first : first + count, 0].astype(np.uint32).view(np.float32)
        need((np.diff(offsets) >= 0).all(), "order of stops")
        return
    need(rest == 0 and texels[0, 2] == 0, "a word that is not 0")
    halves = np.array([word >> shift & 65535 for word in texels[0, :2].tolist() for shift in (0, 16)])
    need(kind != 1 or (halves[:3] <= halves[3]).all(), "a colour above its opacity")
    need(kind != 5 or not texels[0, :2].any(), "a word that is not 0")
    need(kind != 6 or (texels[0, 0] <= 65535 and int(texels[0, 1]) in {*range(17), 33, 34}), "group")


def read_stops(words: np.ndarray) -> np.ndarray:
    """Return the offset and colour of each stop (D.6)."""
    offsets = words[:, 0].astype(np.uint32).view(np.float32)
    need(((offsets >= 0) & (offsets <= 1)).all() and not words[:, 3].any(), "stop")
    return np.column_stack([offsets, (words[:, 1:3, None] >> np.array([0, 16]) & 65535).reshape(-1, 4) / 65535])


def ramp_place(kind: int, numbers: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return t of a gradient at each point, or NaN (D.6)."""
    u, v = (numbers[k, 0] * x + numbers[k, 1] * y + numbers[k, 2] for k in (0, min(1, len(numbers) - 1)))
    if kind < 4:
        return u if kind == 2 else np.hypot(u, v)
    fx, fr = numbers[2, :2].tolist()
    a, b, c = fx**2 - (1 - fr) ** 2, fx * (u - fx) - fr * (1 - fr), (u - fx) ** 2 + v**2 - fr**2
    with np.errstate(all="ignore"):
        root = np.sqrt(b * b - a * c)
        roots = np.array([(-b - root) / a, (-b + root) / a] if a else [-c / (2 * b)] * 2)
        return np.fmax(*np.where(fr * (1 - roots) + roots >= 0, roots, np.nan))


def gradient_color(kind: int, texels: np.ndarray, stops: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the premultiplied colour of a gradient at each point (D.6)."""
    t = ramp_place(kind, texels[:, :3].copy().view(np.float32).astype(float), x, y)
    spread, nowhere = int(texels[0, 3]) >> 27 & 3, np.isnan(t)
    t = np.nan_to_num(t)
    t = [np.clip(t, 0, 1), 1 - abs(1 - (t - 2 * np.floor(t / 2))), t - np.floor(t)][spread]
    above = np.searchsorted(stops[:, 0], t, side="right")
    low, high = np.maximum(above - 1, 0), np.minimum(above, len(stops) - 1)
    way = np.where(low < high, stops[high, 0] - stops[low, 0], 1)
    share = np.where(low < high, (t - stops[low, 0]) / way, 0)[:, None]
    color = stops[low, 1:] + share * (stops[high, 1:] - stops[low, 1:])
    color[:, :3] *= color[:, 3:]
    return np.where(nowhere[:, None], 0, color)


def whole(b: np.ndarray, s: np.ndarray, mode: int) -> np.ndarray:
    """Return what modes that look at whole colours make of two (the W3C's Lum, Sat, SetSat, SetLum and ClipColor)."""
    weights = [[0.3], [0.59], [0.11]]
    if mode in (12, 13):
        c, other = (s, b) if mode == 12 else (b, s)
        with np.errstate(all="ignore"):
            c = np.nan_to_num((c - c.min(1, keepdims=True)) / np.ptp(c, axis=1, keepdims=True))
        c = c * np.ptp(other, axis=1, keepdims=True)
    else:
        c = s if mode == 14 else b
    wanted = (s if mode == 15 else b) @ weights
    c = c + wanted - c @ weights
    low, high = c.min(1, keepdims=True), c.max(1, keepdims=True)
    with np.errstate(all="ignore"):
        c = np.where(low < 0, wanted + (c - wanted) * wanted / (wanted - low), c)
        return np.where(high > 1, wanted + (c - wanted) * (1 - wanted) / (high - wanted), c)


def blend(below: np.ndarray, above: np.ndarray, mode: int) -> np.ndarray:
    """Return one premultiplied colour over another, or masked by it (D.6, and the formulas of the W3C)."""
    if mode in (33, 34):
        return below * (above[:, 3:] if mode == 33 else above[:, :3] @ [[0.2125], [0.7154], [0.0721]])
    if mode == 16:
        return np.minimum(below + above, 1)
    ab, as_ = below[:, 3:], above[:, 3:]
    with np.errstate(all="ignore"):
        b, s = (np.nan_to_num(np.minimum(color[:, :3] / color[:, 3:], 1)) for color in (below, above))
        hard = [np.where(q <= 0.5, 2 * p * q, 1 - 2 * (1 - p) * (1 - q)) for p, q in ((s, b), (b, s))]
        dodge = np.where(b == 0, 0, np.where(s >= 1, 1, np.minimum(b / (1 - s), 1)))
        burn = np.where(b >= 1, 1, np.where(s == 0, 0, 1 - np.minimum((1 - b) / s, 1)))
        root = np.where(b <= 0.25, ((16 * b - 12) * b + 4) * b, np.sqrt(b))
        soft = b + (2 * s - 1) * np.where(s <= 0.5, b - b * b, root - b)
    table = [s, b * s, b + s - b * s, hard[0], np.minimum(b, s), np.maximum(b, s), dodge, burn, hard[1], soft]
    table += [abs(b - s), b + s - 2 * b * s]
    mixed = table[mode] if mode < len(table) else whole(b, s, mode)
    color = above[:, :3] * (1 - ab) + below[:, :3] * (1 - as_) + as_ * ab * mixed
    return np.column_stack([color, as_ + ab * (1 - as_)])


def run(program: list, planar: Map, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the colour of a program at each point (D.6)."""
    color, kept = np.zeros((len(x), 4)), []
    for kind, texels, first in program:
        if kind == 5:
            kept.append(color)
            color = np.zeros_like(color)
        elif kind == 6:
            color = blend(kept.pop(), color * int(texels[0, 0]) / 65535, int(texels[0, 1]))
        elif kind == 1:
            solid = np.array([word >> shift & 65535 for word in texels[0, :2].tolist() for shift in (0, 16)]) / 65535
            color = blend(color, np.broadcast_to(solid, color.shape), 0)
        elif kind == 0:
            color = blend(color, picture_color(texels, planar.pixels[first:], x, y), 0)
        else:
            count = int(texels[0, 3]) >> 19 & 255
            color = blend(color, gradient_color(kind, texels, planar.stops[first : first + count], x, y), 0)
    return color


def read_map_cells(words: np.ndarray) -> tuple[np.ndarray, ...]:
    """As `read_cells`, with the first texel of curves of each cell and the number of these texels (D.2)."""
    cells, child, _, n = read_cells(words)
    texels = np.where(cells & 1, (n + 1) // 2, n)
    return cells, child, words[:, [1]] + np.cumsum(texels, axis=1) - texels, texels


def read_curves(words: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Return the points of the curves of a map, by their numbers (D.2)."""
    (cells, _, first, _), (*_, count), found = read_map_cells(words), read_cells(words), []
    for quad in np.sort(quads):
        need(words[quad, 3] == len(found), "the number of a quad's first curve")
        for cell, texel, n in zip(cells[quad], first[quad], count[quad], strict=True):
            if not n or not cell & 1:
                found += list(read_points(words[texel : texel + n]))
                continue
            ends = words[texel : texel + (n + 1) // 2].reshape(-1, 2)
            need(n % 2 == 0 or not ends[n].any(), "half a texel that is not 0")
            for p0, p3 in np.stack([ends & 65535, ends >> 16], axis=-1)[:n]:
                found.append(np.array([p0, (2 * p0 + p3 + 1) // 3, (p0 + 2 * p3 + 1) // 3, p3]))
    points = np.array(found, int).reshape(-1, 4, 2)
    need((points[:, [0, 3]] <= 32768).all(), "an end of a curve")
    need((points[:, 0, 1] <= points[:, 3, 1]).all(), "a curve that goes down")
    return points


def read_map(words: np.ndarray, root: int) -> tuple[Map, np.ndarray]:
    """Return the map with this root quad, and the indices of the texels of its parts (D.1 to D.6)."""
    need(1 < root < len(words), "no head")
    p, cells, sides, paints = words[root - 1].tolist()
    first_program, operations, stops, pixels = words[root - 2].tolist()
    need(operations > 0 or first_program == stops == pixels == 0, "head")
    need(1 <= p <= 1 << 24, "number of paints")
    quads, curves = trace(words, [root], KINDS, read_map_cells)
    c, n, t = min(curves, default=0), len(quads), len(curves)
    need((np.sort(quads) == np.arange(root, root + n)).all(), "quads are not consecutive")
    need((np.sort(curves) == np.arange(c, c + t)).all(), "curves are not consecutive")
    points = read_curves(words, quads)
    m = len(points)

    bits, s = (8, 4) if p <= 256 else (16, 2) if p <= 65536 else (32, 1)

    def numbers(texels: np.ndarray) -> np.ndarray:
        return words[texels].reshape(-1, 1) >> np.arange(0, 32, bits) & (1 << bits) - 1

    j = np.arange(n)
    at_cells = part(words, cells, n + (n + s - 1) // s)
    mean = words[cells + 1 + j + j // s, :, None] >> np.array([0, 8, 16, 24]) & 255
    base = numbers(cells + (s + 1) * np.arange((n + s - 1) // s)).reshape(-1, 4)[:n]
    at_sides = part(words, sides, (m + 2 * s - 1) // (2 * s)) if m else np.arange(0)
    left, right = numbers(at_sides).reshape(-1, 2)[:m].T
    need(max(base.max(), left.max(initial=0), right.max(initial=0)) < p, "a paint beyond the table")
    at_paints = part(words, paints, (p + 1) // 2)
    pairs = words[at_paints].reshape(-1, 2)[:p]
    is_program = (pairs[:, 1] >> 16 == 0) & (pairs[:, 0] != 0)
    colors = np.where(is_program[:, None], 0, (pairs[:, :, None] >> np.array([0, 16]) & 65535).reshape(-1, 4))
    at_programs = part(words, first_program, operations + stops + pixels)
    runs = {int(j): pairs[j].tolist() for j in np.flatnonzero(is_program)}
    programs = read_programs(words, first_program, [operations, stops, pixels], runs)
    need(all((color[..., :3] <= color[..., 3:]).all() for color in (mean, colors)), "a colour above its opacity")

    kind, child, _, n_curves = (array[root : root + n] for array in read_cells(words))
    first = words[root : root + n, [3]] + np.cumsum(n_curves, axis=1) - n_curves
    need(not base[(kind == 128) | (kind == 2)].any(), "a base paint where there is none")
    used = np.concatenate([[root - 2, root - 1], quads, curves, at_cells, at_sides, at_paints, at_programs])
    arrays = np.where(child < 0, -1, child - root), first, n_curves
    faces = points, left, right, colors / 65535, programs
    at_stops, at_pixels = at_programs[operations : operations + stops], at_programs[operations + stops :]
    return Map(*arrays, base, kind == 2, mean / 255, *faces, read_stops(words[at_stops]), words[at_pixels]), used


@refusing()
def read_style(root: dict, planar: Map) -> tuple[list[dict], list[list[int]]]:
    """Return the elements of a map, each with its place in the style, and the stacks of its paints (D.10)."""
    elements, groups, stacks = (root["style"][key] for key in ("elements", "groups", "stacks"))
    need(all(-1 <= group["outer"] < k and 0 <= group["opacity"] <= 1 for k, group in enumerate(groups)), "groups")
    need(all(-1 <= element.get("group", -1) < len(groups) for element in elements), "the group of an element")
    need(len(stacks) == len(planar.paints), "as many stacks as paints")
    need(all(0 <= place < len(elements) for stack in stacks for place in stack), "an element beyond the list")
    return elements, stacks


def composite(elements: list[dict], stack: list[int]) -> np.ndarray:
    """Return the colour of a stack in which no element is in a group (D.10)."""
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
    need(version in ("2", "3") and any(is_map), "version")
    need(not any("paint" in root for root, yes in zip(roots, is_map, strict=True) if yes), "a map with a paint")
    shapes, used = read_shapes(words, [root for root, yes in zip(roots, is_map, strict=True) if not yes])
    maps = {q: read_map(words, q) for q in {r["quad"] for r, yes in zip(roots, is_map, strict=True) if yes}}
    has_pictures = any(len(planar.pixels) for planar, _ in maps.values())
    need(version == ("3" if has_pictures else "2"), "version of pictures")
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
    """Return points, paints and how often each is counted there, if not 0 (D.7). Where only a mean is known, none."""
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
    """Return the paint at each point (D.7), or -1: outside, where only a mean is known, and in slivers."""
    point, paint, count = counts(planar, x, y)
    alone = (np.bincount(point, minlength=np.size(x))[point] == 1) & (count == 1)
    answer = np.full(np.size(x), -1)
    answer[point[alone]] = paint[alone]
    return answer


def color_at(planar: Map, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the colour at each point; in slivers what the counts add up to (D.7, D.8)."""
    square, quad, k, *_ = locate(planar.child, 0, x, y)
    color = np.where((square & planar.mean_only[quad, k])[:, None], planar.mean[quad, k], 0)
    point, paint, count = counts(planar, x, y)
    colors = planar.paints[paint]
    for j, program in planar.programs.items():
        at = np.flatnonzero(paint == j)
        colors[at] = run(program, planar, np.asarray(x)[point[at]], np.asarray(y)[point[at]])
    np.add.at(color, point, count[:, None] * colors)
    return color


def map_picture(planar: Map, size: int, samples: int = 6) -> np.ndarray:
    """Return size x size pixels [row, column, channel], the top row first, by samples x samples points in each."""
    colors = color_at(planar, *sample_points(size, samples))
    return colors.reshape(size, samples, size, samples, 4).mean(axis=(1, 3))
