"""Reading a planar map point by point, and a brute-force answer to what colour is there."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import degenerate
from degenerate import path_windings
from vexture.base.layout import LATTICE, MOST_HALF_PAINTS
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Gradient, Paint, Spread
from vexture.texture.encode import encode
from vexture.texture.planar import decode_map
from vexture.texture.texture import Texture
from vexture.tree.crossings import x_at
from vexture.tree.planar.map import PlanarMap


def cell_at(planar: PlanarMap, point) -> tuple[int, int, NDArray[np.float64]]:
    """The quad and cell of the leaf that holds a point, and the point in lattice units of the leaf."""
    x, y = point
    quad = 0
    while True:
        k = int(x >= 0.5) + 2 * int(y >= 0.5)
        x, y = 2 * x - (k & 1), 2 * y - (k >> 1)
        if not planar.is_quad[quad, k]:
            return quad, k, np.array([x, y]) * LATTICE
        quad = int(planar.first_quad[quad] + planar.is_quad[quad, :k].sum())


def widen_paints(texture: Texture) -> Texture:
    """A texture of maps without gradients, with so many more paints that their numbers take 32 bits."""
    maps = []
    for root in texture.roots:
        planar, shift = decode_map(texture.flat, root.quad), MOST_HALF_PAINTS
        base, sides = (np.where(of > 0, of + shift, 0).astype(np.int32) for of in (planar.base, planar.sides))
        table = np.insert(planar.paints, np.full(shift, 1), 0, axis=0)
        maps.append(replace(planar, base=base, sides=sides, paints=table))
    return encode(maps, [replace(root, style=None) for root in texture.roots], name=texture.name, source=None)


def paints_at(planar: PlanarMap, point) -> dict[int, int]:
    """Paints at a point, and how often each: one paint, once, in a sound map."""
    quad, k, (x, y) = cell_at(planar, point)
    first = int(planar.first_curve[quad] + planar.count[quad, :k].sum())
    tally = {int(planar.base[quad, k]): 1}

    def add(curve, by):
        for paint, event in zip(planar.sides[curve].tolist(), (by, -by), strict=True):
            tally[paint] = tally.get(paint, 0) + event

    for curve in range(first, first + int(planar.count[quad, k])):
        points = planar.curves[curve].astype(float)
        for end, event in ((0, 1), (3, -1)):
            if points[end, 0] == 0.0 and points[end, 1] <= y:
                add(curve, event)
        assert points[0, 1] <= points[3, 1]
        if points[0, 1] <= y < points[3, 1] and x_at(points, y) <= x:
            add(curve, -1)
    return {paint: times for paint, times in tally.items() if times}


def gradient_colours(gradient: Gradient, points) -> NDArray[np.float64]:
    """Premultiplied colours (n, 4) at points, by the text of SVG 2: the greatest t whose circle has a radius."""
    x, y = np.array(gradient.to_ramp)[:, :2] @ np.transpose(points) + np.array(gradient.to_ramp)[:, 2:]
    t = x
    if gradient.focus is not None:
        fx, fr = gradient.focus
        # |(x, y) - (fx (1 - t), 0)| = fr (1 - t) + t, as a polynomial of t
        a, b, c = fx**2 - (1 - fr) ** 2, 2 * (fx * (x - fx) - fr * (1 - fr)), (x - fx) ** 2 + y**2 - fr**2
        with np.errstate(invalid="ignore", divide="ignore"):
            root = np.sqrt(b * b - 4 * a * c)
            both = np.sort([(-b - root) / (2 * a), (-b + root) / (2 * a)] if a else [-c / b, -c / b], axis=0)
            both[~(fr + both * (1 - fr) >= 0)] = np.nan
        t = np.where(np.isnan(both[1]), both[0], both[1])
    there = np.nan_to_num(t)
    if gradient.spread is Spread.REPEAT:
        there = there % 1.0
    elif gradient.spread is Spread.REFLECT:
        there = np.minimum(there % 2.0, -there % 2.0)
    offsets = np.array([stop.offset for stop in gradient.stops])
    straight = np.array([(*stop.color, stop.opacity) for stop in gradient.stops])
    high = np.searchsorted(offsets, there, side="right")
    before, after = np.maximum(high - 1, 0), np.minimum(high, len(offsets) - 1)
    way = np.where(after > before, offsets[after] - offsets[before], 1.0)
    share = np.where(after > before, (there - offsets[before]) / way, 0.0)[:, None]
    colours = (1 - share) * straight[before] + share * straight[after]
    return np.where(np.isnan(t)[:, None], 0.0, colours * np.append(colours[:, [3, 3, 3]], np.ones((len(t), 1)), axis=1))


def over(below, above, blend: Blend, opacity: float):
    """Premultiplied colours (n, 4), of the blend modes that tests use."""
    above = above * opacity
    out = above + (1 - above[:, 3:]) * below
    if blend is Blend.MULTIPLY:
        out[:, :3] = above[:, :3] * (1 - below[:, 3:]) + below[:, :3] * (1 - above[:, 3:]) + above[:, :3] * below[:, :3]
    elif blend is Blend.SCREEN:
        out[:, :3] = above[:, :3] + below[:, :3] - above[:, :3] * below[:, :3]
    elif blend is not Blend.NORMAL:
        raise NotImplementedError(blend)
    return out


def colours_at(drawing: Drawing, points, chords: int = 256) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Premultiplied colours of a drawing at points, (n, 4), and the points' distance from the nearest outline."""
    windings, distance = path_windings(drawing, points, chords)

    masks = [sum(mask.outer == place for mask in drawing.groups if mask.mask) for place in range(len(drawing.groups))]

    def paint_group(group: int, start: int) -> tuple[NDArray[np.float64], int]:
        """Colours of a group from a path on, masked, and the path after it."""
        below, k, left = np.zeros((len(points), 4)), start, np.ones((len(points), 1))
        missing = masks[group] if group >= 0 else 0
        while k < len(drawing.paths):
            around = drawing.around(drawing.paths[k].group)
            if group >= 0 and group not in around:
                break
            inner = around[around.index(group) + 1 :] if group >= 0 else around
            if inner:
                above, k = paint_group(inner[0], k)
                of = drawing.groups[inner[0]]
                if of.mask:
                    amount = above[:, 3] if of.mask is Mask.OPACITY else above[:, :3] @ (0.2125, 0.7154, 0.0721)
                    left, missing = left * (of.opacity * amount)[:, None], missing - 1
                else:
                    below = over(below, above, of.blend, of.opacity)
                continue
            path, w = drawing.paths[k], windings[k]
            inside = w & 1 != 0 if path.fill_rule == FillRule.EVENODD else w != 0
            flat = [*(c * path.paint.opacity for c in path.paint.color), path.paint.opacity]
            gradient, picture, colour = path.paint.gradient, path.paint.picture, np.array(flat)
            if gradient is not None:
                colour = gradient_colours(gradient, points)
            elif picture is not None:
                colour = np.array([picture.color_at(*point) for point in np.asarray(points).tolist()])
            below, k = over(below, inside[:, None] * colour, Blend.NORMAL, 1.0), k + 1
        return below * left * (missing == 0), k

    return paint_group(-1, 0)[0], distance


def colour_paths(drawing: Drawing, rng, blends=(Blend.NORMAL, Blend.MULTIPLY, Blend.SCREEN)) -> Drawing:
    """A drawing with random paints, some of them equal and some opaque, and random groups, some of them masks."""
    paths, groups = [], []
    around: list[int] = []
    for path in drawing.paths:
        while around and rng.random() < 0.4:
            around.pop()
        if rng.random() < 0.3:
            blend = Blend(int(rng.choice(blends)))
            mask = Mask(int(rng.choice(Mask, p=(0.6, 0.2, 0.2)))) if around else Mask.NONE
            groups.append(Group(around[-1] if around else -1, float(rng.choice([0.5, 1.0])), blend, mask))
            around.append(len(groups) - 1)
        colour = tuple(rng.choice([0.0, 0.5, 1.0], 3).tolist())
        paint = Paint(colour, float(rng.choice([0.3, 1.0, 1.0])))
        paths.append(Path(path.contours, path.fill_rule, paint, around[-1] if around else -1))
    return Drawing(tuple(paths), groups=tuple(groups))


MOST_LAYERS = 30


def layered_drawing(seed: int) -> Drawing:
    """Up to 30 random layers, degenerate and coincident ones among them, in groups, with masks and all blend modes."""
    rng = np.random.default_rng(seed)
    paths: tuple[Path, ...] = ()
    for _ in range(int(rng.integers(1, 6))):
        paths += degenerate.drawing(int(rng.integers(1 << 30))).paths
    if seed % 3 == 0:
        distance = 10.0 ** -int(rng.integers(3, 12))
        paths += degenerate.heap(seed, [1, 2, 1], distance, FillRule(seed // 2 % 2)).paths
    return colour_paths(Drawing(paths[:MOST_LAYERS]), rng, list(Blend))


def sample_picture(drawing: Drawing, size: int, samples: int = 32) -> NDArray[np.float64]:
    """Picture of a drawing, (size, size, 4), by samples x samples points in a pixel."""
    at = (np.arange(size * samples) + 0.5) / (size * samples)
    rows = [colours_at(drawing, np.column_stack([at, np.full(len(at), y)]), 24)[0] for y in at[::-1]]
    return np.array(rows).reshape(size, samples, size, samples, 4).mean(axis=(1, 3))
