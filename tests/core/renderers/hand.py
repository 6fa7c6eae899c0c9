"""Textures made by hand from FORMAT.md, part A, and a truth that knows nothing of the renderers' method.

A tree is `FULL`, `EMPTY`, a `Curve`, a `Corner`, or a list of four trees: top left and right, bottom left and right.
The truth cuts every outline into chords, closes it along its cell's edge and counts crossings in float64.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numba
import numpy as np
import pytest
from numpy.typing import NDArray

from vexture.base.errors import DeviceError
from vexture.renderers.device import context
from vexture.thesis.texture import ThesisTexture

Floats = NDArray[np.float64]
FULL, EMPTY = "full", "empty"
CHORDS = 512  # the sagitta of a chord is below 2e-5 of the cell
NEAR = 1e-4  # cells; a disagreement farther than this from the outline is a speckle


@dataclass(frozen=True)
class Curve:
    """P0 and P3 as distances along the cell's edge (Table 4.1), P1 and P2 in the cell's own square."""

    edge0: float
    p1: tuple[float, float]
    p2: tuple[float, float]
    edge3: float


@dataclass(frozen=True)
class Corner:
    """Straight lines from one edge point to the corner and on to the other."""

    edge0: float
    corner: tuple[float, float]
    edge3: float


K = 0.5522847498  # of the cubic that is nearly a quarter circle
QUARTERS = [
    Curve(0.75, (0.0, K), (1.0 - K, 1.0), 0.25),
    Curve(0.0, (K, 1.0), (1.0, K), 0.5),
    Curve(0.5, (1.0 - K, 0.0), (0.0, 1.0 - K), 0.0),
    Curve(0.25, (1.0, 1.0 - K), (K, 0.0), 0.75),
]
S_CURVE = Curve(0.8, (1.5, 1.6), (-0.5, -0.6), 0.3)
LOOP = Curve(0.75, (1.9, 1.9), (-0.9, 1.9), 0.5)
SWIRL = Curve(0.875, (2.2, 1.2), (-1.2, -0.2), 0.375)
ROOF = Corner(0.7, (0.4, 0.9), 0.55)
NOTCH = Corner(0.3, (0.2, 0.7), 0.9)
TREE = [QUARTERS[0], [LOOP, SWIRL, ROOF, [FULL, EMPTY, S_CURVE, QUARTERS[3]]], [QUARTERS, ROOF, NOTCH, FULL], LOOP]
"""Everything that a texture can hold, on several levels."""


@dataclass(frozen=True)
class Leaf:
    """What the truth knows of a cell: a constant, or a polygon and the outline that is part of it."""

    low: Floats
    size: float
    value: float = 0.0
    outline: Floats | None = None
    polygon: Floats | None = None


def texture_of(tree: Any, bits: int = 16) -> ThesisTexture:
    """Encode a tree; a coverage is the mean of 64 x 64 points in each leaf."""
    quads: list[Any] = []
    curves: list[Any] = [np.zeros((2, 3)), np.zeros((2, 3))]

    def add(node: Any) -> tuple[str, int, float]:
        if isinstance(node, list):
            row = len(quads)
            quads.append(None)
            cells = [add(child) for child in node]
            coverage = float(np.mean([c for _, _, c in cells]))
            quads[row] = [(kind, index, coverage) for kind, index, _ in cells]
            return "quad", row, coverage
        if node in (FULL, EMPTY):
            return "curve", (FULL, EMPTY).index(node), float(node == FULL)
        if isinstance(node, Curve):
            (x1, y1), (x2, y2) = (np.add(p, 1.25) / 3.5 for p in (node.p1, node.p2))
            curves.append([(node.edge0, x1, x2), (node.edge3, y1, y2)])
        else:
            curves.append([(node.edge0, node.corner[0], 0), (node.edge3, node.corner[1], 0)])
        kind = "curve" if isinstance(node, Curve) else "corner"
        center = (np.indices((64, 64)).reshape(2, -1).T + 0.5) / 64
        outline = decode(np.array(curves[-1]), kind == "corner")
        return kind, len(curves) - 1, float(in_polygon(close(outline), center).mean())

    add(tree)
    last = {"quad": max(len(quads) - 1, 1), "curve": len(curves) - 1, "corner": len(curves) - 1}
    red = {"quad": 1.0, "curve": 0.0, "corner": 0.5}
    rows = np.array([[(red[kind], index / last[kind], coverage) for kind, index, coverage in row] for row in quads])
    dtype = {8: np.uint8, 16: np.uint16}[bits]
    write = lambda values: np.floor(np.asarray(values) * (2**bits - 1) + 0.5).astype(dtype)  # noqa: E731
    return ThesisTexture(write(rows), write(curves))


def edge_point(edge: float) -> Floats:
    return np.array([np.interp(edge * 4, range(5), xs) for xs in ([0, 1, 1, 0, 0], [1, 1, 0, 0, 1])])


def decode(row: Floats, corner: bool) -> Floats:
    """Outline of a row of the curve texture, as points."""
    p0, p3 = edge_point(row[0, 0]), edge_point(row[1, 0])
    if corner:
        return np.array([p0, row[:, 1], p3])
    p1, p2 = row[:, 1] * 3.5 - 1.25, row[:, 2] * 3.5 - 1.25
    t = np.linspace(0, 1, CHORDS + 1)[:, None]
    return (1 - t) ** 3 * p0 + 3 * (1 - t) ** 2 * t * p1 + 3 * (1 - t) * t**2 * p2 + t**3 * p3


def edge_distance(point: Floats) -> float:
    x, y = point
    return float(x if y == 1 else 1 + (1 - y) if x == 1 else 2 + (1 - x) if y == 0 else 3 + y)


def close(outline: Floats) -> Floats:
    """Close an outline along its cell's edge, clockwise from P3, so that its right side lies within."""
    start, end = edge_distance(outline[-1]), edge_distance(outline[0])
    x, y = outline.T
    turns_left = np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) > 0
    if end < start or (end == start and turns_left):
        end += 4
    corners = [edge_point(c % 4 / 4) for c in range(int(start) + 1, int(np.ceil(end)))]
    return np.array([*outline, *corners])


@numba.njit(error_model="numpy")
def in_polygon(polygon, points):
    """Even-odd test of points, (n,)."""
    inside = np.zeros(len(points), np.bool_)
    for i in range(len(points)):
        x, y = points[i]
        x0, y0 = polygon[-1]
        for j in range(len(polygon)):
            x1, y1 = polygon[j]
            if (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
                inside[i] = not inside[i]
            x0, y0 = x1, y1
    return inside


def distance(outline: Floats, points: Floats) -> Floats:
    """Distance of points to an outline, (n,)."""
    start, step = outline[:-1], np.diff(outline, axis=0)
    square = np.maximum((step * step).sum(1), 1e-300)
    offset = points[:, None] - start
    s = np.clip((offset * step).sum(2) / square, 0, 1)
    return np.sqrt(((offset - s[..., None] * step) ** 2).sum(2).min(1))


def leaves(
    texture: ThesisTexture, footprint: float, row: int = 0, low: Any = (0, 0), size: float = 1
) -> Iterator[Leaf]:
    """All cells that a picture with pixels of this footprint shows."""
    quads, curves = (a / np.iinfo(a.dtype).max for a in (texture.quads, texture.curves))
    low = np.array(low, float)
    if footprint > size:
        yield Leaf(low, size, quads[row, 0, 2])
        return
    for pixel, corner in enumerate([(0, 1), (1, 1), (0, 0), (1, 0)]):
        kind, index, _ = quads[row, pixel]
        at, half = low + np.multiply(corner, size / 2), size / 2
        if kind > 0.75:
            yield from leaves(texture, footprint, round(index * (len(quads) - 1)), at, half)
            continue
        number = round(index * (len(curves) - 1))
        if number < 2:
            yield Leaf(at, half, 1.0 - number)
        else:
            outline = decode(curves[number], kind > 0.25)
            yield Leaf(at, half, 0.0, outline, close(outline))


def samples(size: tuple[int, int], to_unit: Floats) -> Floats:
    """The 16 points of every pixel of an affine view in the unit square, (height, width, 16, 2): a turned grid."""
    width, height = size
    row, column = np.divmod(np.arange(16), 4)
    offset = np.column_stack([4 * column + row, 4 * row + 3 - column]) / 16 + 1 / 32
    pixel = np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1)
    points = pixel[:, :, None] + offset
    return np.concatenate([points, np.ones((*points.shape[:-1], 1))], axis=-1) @ to_unit[:2].T


def truth(texture: ThesisTexture, size: tuple[int, int], to_unit: Floats) -> Floats:
    """Mean of each pixel's 16 points, (height, width)."""
    points = samples(size, to_unit)
    values = np.zeros(points.shape[:-1])
    for leaf in leaves(texture, footprint(to_unit)):
        local = (points - leaf.low) / leaf.size
        here = ((local >= 0) & (local < 1)).all(-1)
        values[here] = leaf.value if leaf.polygon is None else in_polygon(leaf.polygon, local[here])
    return values.mean(-1)


def footprint(to_unit: Floats) -> float:
    return float(np.hypot(*to_unit[:2, :2]).max())


def speckles(texture: ThesisTexture, image: NDArray[np.float32], to_unit: Floats) -> int:
    """Pixels that differ from the truth by more than the points that lie near an outline can explain."""
    size = image.shape[::-1]
    difference = np.abs(image - truth(texture, size, to_unit)) * 16
    rows, columns = np.nonzero(difference > 0.01)
    points = samples(size, to_unit)[rows, columns]
    near = np.zeros(points.shape[:-1], bool)
    for leaf in leaves(texture, footprint(to_unit)):
        local = (points - leaf.low) / leaf.size
        here = ((local >= 0) & (local < 1)).all(-1)
        near[here] |= np.minimum(local, 1 - local)[here].min(-1) < 1e-6 / leaf.size  # rounding may change the cell
        if leaf.outline is not None and here.any():
            near[here] |= distance(leaf.outline, local[here]) < NEAR
    return int(np.sum(difference[rows, columns] > near.sum(-1) + 0.01))


def view_of(low: tuple[float, float], width: float, pixels: int) -> Floats:
    """View of a square of the unit square, (3, 3)."""
    pixel = width / pixels
    return np.array([[pixel, 0, low[0]], [0, -pixel, low[1] + width], [0, 0, 1]])


def need_gpu() -> None:
    """Skip the test, saying why, where there is no OpenGL."""
    try:
        context()
    except DeviceError as error:
        pytest.skip(str(error))
