"""Pictures of gradient meshes: colours at the nodes of a grid, by very many points of each Coons patch.

A patch is the sum of two ruled surfaces, between opposite sides, less the bilinear one between its corners. Colours are
interpolated between corners bilinearly, or by cubics whose slopes at a corner follow from its neighbours.
"""

from math import ceil, hypot
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.bounds import bounds
from vexture.drawing.picture import Picture
from vexture.svg.filter_pixels import from_linear, to_linear

Values = NDArray[np.float64]

MOST_NODES: Final = 128
"""Most columns and rows of a picture."""

FINER: Final = 4
"""Cells between nodes, in each direction; their colours are averaged."""

POINTS: Final = 2.0
"""Least points of a patch in a cell, in each direction."""

MOST_POINTS: Final = 3072
"""Most points along a side; a straight one through all cells needs as many."""

INSIDE: Final = 0.99
"""Factor towards its middle by which a shape is reduced, to ask whether a mesh covers it."""

CHECKED: Final = 2000
"""Most points of a shape that are checked."""

BEYOND: Final = 2
"""Nodes beyond a mesh that continue its colours, if it covers the shape."""


class Mesh(NamedTuple):
    """Patches between curved sides; rows from the top."""

    across: Values  # (rows + 1, columns, 4, 2): sides, as cubics from the left
    down: Values  # (rows, columns + 1, 4, 2): sides, as cubics from the top
    colors: Values  # (rows + 1, columns + 1, 4): sRGB and opacity of corners, not premultiplied
    is_smooth: bool  # True for cubics
    is_linear: bool  # True if colours are interpolated in linear light

    @property
    def border(self) -> Values:
        """Points around the mesh, (n, 2)."""
        sides = (*self.across[0], *self.down[:, -1], *self.across[-1, ::-1, ::-1], *self.down[::-1, 0, ::-1])
        t = np.linspace(0.0, 1.0, 16, endpoint=False)
        return np.concatenate([curve_points(side, t) for side in sides])


def mesh_picture(mesh: Mesh, shape: Values, scales: tuple[float, float]) -> Picture | None:
    """Return the picture of a mesh, in its coordinates; None if the mesh has no area.

    If the mesh does not cover the shape, (n, 4, 2), the picture is transparent beyond the mesh, whose edge is as soft
    as the nodes are apart. `scales` are the lengths of a unit along x and y.
    """
    cubics = np.concatenate([mesh.across.reshape(-1, 4, 2), mesh.down.reshape(-1, 4, 2)])
    left, top, right, bottom = bounds(cubics)
    width, height = right - left, bottom - top
    longest = max(scales[0] * width, scales[1] * height)
    if not min(width, height) > 1e-9 * max(width, height):
        return None
    is_whole = covers(mesh.border, shape)
    most, rim = (MOST_NODES, 0) if is_whole else (MOST_NODES - 2, 1)
    columns, rows = (max(ceil(most * part / longest), 2) for part in (scales[0] * width, scales[1] * height))
    gaps = (
        1 if is_whole else 0
    )  # then the first and the last node are on the border, else half of their distance inside
    steps = np.array([width / (columns - gaps), height / (rows - gaps)])
    columns, rows = columns + 2 * rim, rows + 2 * rim
    corner = np.array([left, top]) - (rim + 0.5 * gaps) * steps
    colors, shares = sample_cells(mesh, corner, steps / FINER, (columns * FINER, rows * FINER))
    colors, shares = (cells.reshape(rows, FINER, columns, FINER, -1).sum(axis=(1, 3)) for cells in (colors, shares))
    if is_whole:
        for _ in range(BEYOND):
            colors, shares = spread(colors, shares)
        values = colors / np.maximum(shares, 1.0)
    else:
        values = colors / FINER**2
    pixels = np.rint(255.0 * np.clip(values, 0.0, 1.0))
    pixels[..., :3] = np.minimum(pixels[..., :3], pixels[..., 3:])
    (a, b), (x, y) = (1.0 / steps).tolist(), corner.tolist()
    return Picture(((a, 0.0, -a * x), (0.0, b, -b * y)), pixels.astype(np.uint8))


def sample_cells(mesh: Mesh, corner: Values, steps: Values, size: tuple[int, int]) -> tuple[Values, Values]:
    """Return the premultiplied colours of cells, (rows, columns, 4), and 1 for those that the mesh reaches, else 0.

    Later patches cover earlier ones.
    """
    columns, rows = size
    colors, shares = np.zeros((rows * columns, 4)), np.zeros((rows * columns, 1))
    ends = decode(mesh.colors) if mesh.is_linear else mesh.colors
    slopes = (slopes_along(ends, 1), slopes_along(ends, 0)) if mesh.is_smooth else None
    for row in range(mesh.down.shape[0]):
        for column in range(mesh.across.shape[1]):
            sides = mesh.across[row : row + 2, column], mesh.down[row, column : column + 2]
            u, v = (middles(points_needed(pair / steps)) for pair in sides)
            at = ((patch_points(*sides, u, v) - corner) / steps).reshape(-1, 2).astype(np.int64)
            part = patch_colors(ends, slopes, (row, column), u, v)
            part = encode(part) if mesh.is_linear else part
            part[..., :3] *= part[..., 3:]
            place = np.clip(at[:, 1], 0, rows - 1) * columns + np.clip(at[:, 0], 0, columns - 1)
            counts = np.bincount(place, minlength=rows * columns)
            reached = np.flatnonzero(counts)
            for channel in range(4):
                sums = np.bincount(place, part[..., channel].ravel(), minlength=rows * columns)
                colors[reached, channel] = sums[reached] / counts[reached]
            shares[reached] = 1.0
    return colors.reshape(rows, columns, 4), shares.reshape(rows, columns, 1)


def points_needed(pair: Values) -> int:
    """Return the number of points along two opposite sides, (2, 4, 2), in units of cells, for their greatest speed."""
    speed = max(3.0 * hypot(*step) for side in pair for step in np.diff(side, axis=0).tolist())
    return int(min(POINTS * speed + 2.0, MOST_POINTS))


def middles(count: int) -> Values:
    """Return the middles of equal parts of 0..1."""
    return (np.arange(count) + 0.5) / count


def curve_points(cubic: Values, t: Values) -> Values:
    """Return points of a cubic, (n, 2)."""
    s = (1.0 - t)[:, None]
    t = t[:, None]
    points: Values = s**3 * cubic[0] + 3.0 * s * s * t * cubic[1] + 3.0 * s * t * t * cubic[2] + t**3 * cubic[3]
    return points


def patch_points(across: Values, down: Values, u: Values, v: Values) -> Values:
    """Return points of a Coons patch, (len(v), len(u), 2)."""
    top, bottom = (curve_points(side, u)[None] for side in across)
    left, right = (curve_points(side, v)[:, None] for side in down)
    x, y = u[None, :, None], v[:, None, None]
    ends = (1.0 - y) * ((1.0 - x) * across[0, 0] + x * across[0, 3]) + y * ((1.0 - x) * across[1, 0] + x * across[1, 3])
    points: Values = (1.0 - y) * top + y * bottom + (1.0 - x) * left + x * right - ends
    return points


def patch_colors(
    ends: Values, slopes: tuple[Values, Values] | None, place: tuple[int, int], u: Values, v: Values
) -> Values:
    """Return colours in a patch, (len(v), len(u), 4); the slopes of corners are those along rows and columns."""
    row, column = place

    def around(values: Values) -> Values:
        return values[row : row + 2, column : column + 2]

    found: Values
    if slopes is None:
        found = np.einsum("ai,bj,abk->ijk", np.stack([1.0 - v, v]), np.stack([1.0 - u, u]), around(ends))
        return found
    (x, x_slope), (y, y_slope) = hermite(u), hermite(v)
    found = np.einsum("ai,bj,abk->ijk", y, x, around(ends))
    found += np.einsum("ai,bj,abk->ijk", y, x_slope, around(slopes[0]))
    found += np.einsum("ai,bj,abk->ijk", y_slope, x, around(slopes[1]))
    return found.clip(0.0, 1.0)


def hermite(t: Values) -> tuple[Values, Values]:
    """Return the weights of both ends, (2, n), and of the slopes there."""
    s = 1.0 - t
    return np.stack([s * s * (1.0 + 2.0 * t), t * t * (1.0 + 2.0 * s)]), np.stack([t * s * s, -t * t * s])


def slopes_along(values: Values, axis: int) -> Values:
    """Return slopes at corners along an axis, for steps of 1, as Inkscape chooses them.

    A slope is half of the difference of the neighbours, but 0 at an extremum, and at most three times the difference to
    either neighbour. At an end, the curve is a parabola.
    """
    values = np.moveaxis(values, axis, 0)
    steps = np.diff(values, axis=0)
    slopes = np.empty_like(values)
    least = 3.0 * np.minimum(np.abs(steps[:-1]), np.abs(steps[1:]))
    slopes[1:-1] = np.where(steps[:-1] * steps[1:] > 0.0, np.clip(0.5 * (steps[:-1] + steps[1:]), -least, least), 0.0)
    if len(steps) == 1:
        slopes[:] = steps
    else:
        slopes[0], slopes[-1] = 2.0 * steps[0] - slopes[1], 2.0 * steps[-1] - slopes[-2]
    return np.moveaxis(slopes, 0, axis)


def spread(colors: Values, shares: Values) -> tuple[Values, Values]:
    """Continue the sums of nodes to neighbours that have none."""
    total, weight = np.zeros_like(colors), np.zeros_like(shares)
    rows, columns = shares.shape[:2]
    edged = [np.pad(values, ((1, 1), (1, 1), (0, 0))) for values in (colors, shares)]
    for j in range(3):
        for i in range(3):
            total += edged[0][j : j + rows, i : i + columns]
            weight += edged[1][j : j + rows, i : i + columns]
    is_empty = shares == 0.0
    return np.where(is_empty, total, colors), np.where(is_empty, weight, shares)


def covers(border: Values, shape: Values) -> bool:
    """Return whether a polygon (n, 2) covers the points of a shape, (m, 4, 2), which is reduced a little."""
    t = np.linspace(0.0, 1.0, 6, endpoint=False)
    points = np.concatenate([curve_points(cubic, t) for cubic in shape[:: max(len(shape) * 6 // CHECKED, 1)]])
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    x, y = (middle + INSIDE * (points - middle)).T[..., None]
    (x0, y0), (x1, y1) = border.T, np.roll(border, -1, axis=0).T
    crosses = (y0 <= y) != (y1 <= y)
    level = np.where(y1 != y0, y1 - y0, 1.0)
    is_right = x0 + (y - y0) / level * (x1 - x0) > x
    return bool(((crosses & is_right).sum(axis=1) % 2 == 1).all())


def decode(colors: Values) -> Values:
    """Convert colours, not premultiplied, to linear light."""
    return np.concatenate([to_linear(colors[..., :3]), colors[..., 3:]], axis=-1)


def encode(colors: Values) -> Values:
    """Convert colours in linear light, not premultiplied, to sRGB."""
    return np.concatenate([from_linear(np.clip(colors[..., :3], 0.0, 1.0)), colors[..., 3:]], axis=-1)
