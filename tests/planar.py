"""Reading a planar map point by point, and a brute-force answer to what colour is there."""

import numpy as np
from numpy.typing import NDArray

import degenerate
from degenerate import path_windings
from vexture.drawing import Drawing, FillRule, Path
from vexture.group import Blend, Group, Mask
from vexture.layout import LATTICE
from vexture.paint import Paint
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


def colours_at(drawing: Drawing, points) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Premultiplied colours of a drawing at points, (n, 4), and the points' distance from the nearest outline."""
    windings, distance = path_windings(drawing, points)

    masks = [sum(mask.outer == place for mask in drawing.groups if mask.mask) for place in range(len(drawing.groups))]

    def painted(group: int, start: int) -> tuple[NDArray[np.float64], int]:
        """Colours of a group from a path on, masked, and the path after it."""
        below, k, left = np.zeros((len(points), 4)), start, np.ones((len(points), 1))
        missing = masks[group] if group >= 0 else 0
        while k < len(drawing.paths):
            around = drawing.around(drawing.paths[k].group)
            if group >= 0 and group not in around:
                break
            inner = around[around.index(group) + 1 :] if group >= 0 else around
            if inner:
                above, k = painted(inner[0], k)
                of = drawing.groups[inner[0]]
                if of.mask:
                    amount = above[:, 3] if of.mask is Mask.OPACITY else above[:, :3] @ (0.2125, 0.7154, 0.0721)
                    left, missing = left * (of.opacity * amount)[:, None], missing - 1
                else:
                    below = over(below, above, of.blend, of.opacity)
                continue
            path, w = drawing.paths[k], windings[k]
            inside = w & 1 != 0 if path.fill_rule == FillRule.EVENODD else w != 0
            colour = np.array([*(c * path.paint.opacity for c in path.paint.color), path.paint.opacity])
            below, k = over(below, inside[:, None] * colour, Blend.NORMAL, 1.0), k + 1
        return below * left * (missing == 0), k

    return painted(-1, 0)[0], distance


def coloured(drawing: Drawing, rng, blends=(Blend.NORMAL, Blend.MULTIPLY, Blend.SCREEN)) -> Drawing:
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


def layered(seed: int) -> Drawing:
    """Up to 30 random layers, degenerate and coincident ones among them, in groups, with masks and all blend modes."""
    rng = np.random.default_rng(seed)
    paths: tuple[Path, ...] = ()
    for _ in range(int(rng.integers(1, 6))):
        paths += degenerate.drawing(int(rng.integers(1 << 30))).paths
    if seed % 3 == 0:
        distance = 10.0 ** -int(rng.integers(3, 12))
        paths += degenerate.heap(seed, [1, 2, 1], distance, FillRule(seed // 2 % 2)).paths
    return coloured(Drawing(paths[:MOST_LAYERS]), rng, list(Blend))
