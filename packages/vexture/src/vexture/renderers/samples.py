"""Pictures in an image, for the exact renderer: the colour at a point, and the places where a line leaves a pixel.

The *seams* of a picture are the straight lines at which its colour jumps or bends: the edges of its pixels or, where it
is interpolated, the lines through their centres. Between seams, the colour is a polynomial of two degrees.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Picture, Sampling
from vexture.renderers.ramps import Place, Point, add_cut, ramp_point

MOST_CORNERS: Final = 512
"""Most crossings of seams at which a cell is cut; a cell with more is cut into as many equal parts."""


PARALLEL: Final = 1e-12
"""Sine of the largest angle between lines that count as parallel."""


class Samples(NamedTuple):
    """The pictures of a drawing's paints."""

    maps: NDArray[np.float64]  # (n, 3, 3): from homogeneous pixel coordinates of the image to columns and rows
    inverses: NDArray[np.float64]  # (n, 3, 3): up to a factor
    sizes: NDArray[np.int64]  # (n, 2): columns and rows
    linear: NDArray[np.bool_]  # (n,): are colours between centres interpolated
    opacities: NDArray[np.float64]  # (n,)
    starts: NDArray[np.int64]  # (n,): place of the first pixel
    pixels: NDArray[np.uint8]  # (m, 4): rows of all pictures, one after another
    lost: NDArray[np.int64]  # (1,): 1 if a line met more seams than can be cut

    @classmethod
    def of_pictures(cls, pictures: Sequence[Picture], view: NDArray[np.float64]) -> "Samples":
        """Arrays of pictures; `view` is the (3, 3) matrix from pixel coordinates to the unit square."""
        maps = np.array([np.array([*picture.to_pixels, (0.0, 0.0, 1.0)]) @ view for picture in pictures])
        places, parts, end = dict[int, int](), [np.zeros((0, 4), np.uint8)], 0
        for picture in pictures:  # copies of a picture share its pixels
            if id(picture.pixels) not in places:
                places[id(picture.pixels)] = end
                parts.append(picture.pixels.reshape(-1, 4))
                end += len(parts[-1])
        maps = maps.reshape(-1, 3, 3)
        one, two, three = maps[:, 0], maps[:, 1], maps[:, 2]
        return cls(
            maps,
            np.stack([np.cross(two, three), np.cross(three, one), np.cross(one, two)], axis=2),
            np.array([picture.pixels.shape[1::-1] for picture in pictures], np.int64).reshape(-1, 2),
            np.array([picture.sampling is Sampling.LINEAR for picture in pictures], np.bool_),
            np.array([picture.opacity for picture in pictures], np.float64),
            np.array([places[id(picture.pixels)] for picture in pictures], np.int64),
            np.concatenate(parts),
            np.zeros(1, np.int64),
        )


def draw_effects(drawing: Drawing, render: Callable[[Drawing, tuple[int, int], None], NDArray[np.float32]]) -> Drawing:
    """Return the drawing with a picture in the place of each effect; `render` is the exact renderer."""
    if not any(path.paint.effect for path in drawing.paths):
        return drawing
    paths = []
    for path in drawing.paths:
        effect = path.paint.effect
        if effect is not None:
            side = 1 << effect.depth
            rasters = tuple(render(source, (side, side), None).astype(np.float64) for source in effect.sources)
            picture = Picture(effect.to_pixels, effect.to_bytes(rasters), Sampling.LINEAR, path.paint.opacity)
            path = replace(path, paint=Paint.from_picture(picture))
        paths.append(path)
    return replace(drawing, paths=tuple(paths))


@kernel(allocates=False)
def sample(samples: Samples, k: int, x: float, y: float, colour: NDArray[np.float64]) -> None:
    """Write the premultiplied colour of a picture at a point of the image."""
    X, Y, W = ramp_point(samples.maps[k], x, y)
    columns, rows = samples.sizes[k]
    W = W if W != 0.0 else 1e-300
    shift = 0.5 if samples.linear[k] else 0.0
    column, row = min(max(X / W - shift, 0.0), columns - 1.0), min(max(Y / W - shift, 0.0), rows - 1.0)
    i, j = int(column), int(row)
    right, down = column - i, row - j
    if not samples.linear[k]:
        right, down = 0.0, 0.0
    i_next, j_next = min(i + 1, columns - 1), min(j + 1, rows - 1)
    above, below = samples.starts[k] + j * columns, samples.starts[k] + j_next * columns
    factor = samples.opacities[k] / 255.0
    for channel in range(4):
        high = (1.0 - right) * samples.pixels[above + i, channel] + right * samples.pixels[above + i_next, channel]
        low = (1.0 - right) * samples.pixels[below + i, channel] + right * samples.pixels[below + i_next, channel]
        colour[channel] = factor * ((1.0 - down) * high + down * low)


@kernel(allocates=False)
def seams_between(samples: Samples, k: int, axis: int, one: float, other: float) -> tuple[int, int]:
    """First and last seam of columns (axis 0) or rows (axis 1) between two places; last < first if there is none."""
    size = samples.sizes[k, axis]
    first, last = 0.5 if samples.linear[k] else 1.0, size - 0.5 if samples.linear[k] else size - 1.0
    low, high = max(min(one, other), first), min(max(one, other), last)
    if not low <= high:
        return 0, -1
    return int(np.ceil(low - first)), int(np.floor(high - first))


@kernel(allocates=False)
def cut_seams(
    samples: Samples,
    k: int,
    start: Place,
    end: Place,
    span: Place,
    cuts: NDArray[np.float64],
    count: int,
) -> int:
    """Cut a line in the image, from `start` to `end`, at the seams of a picture; return the new count of cuts.

    Cuts are parts of a longer line, of which this one is the part `span`.
    """
    p, q = ramp_point(samples.maps[k], start[0], start[1]), ramp_point(samples.maps[k], end[0], end[1])
    change = q[2] - p[2]
    for axis in range(2):
        one, other = p[axis] / p[2], q[axis] / q[2]
        first, last = seams_between(samples, k, axis, one, other)
        for step in range(last - first + 1):
            seam = (first + step if other >= one else last - step) + (0.5 if samples.linear[k] else 1.0)
            part = (seam * p[2] - p[axis]) / (q[axis] - p[axis] - seam * change)
            if 0.0 < part < 1.0:
                count = add_cut(span[0] + part * (span[1] - span[0]), cuts, count)
            if count == len(cuts):
                samples.lost[0] = 1
                return count
    return count


@kernel(allocates=False)
def cut_corners(samples: Samples, k: int, low: Place, high: Place, cuts: NDArray[np.float64], count: int) -> int:
    """Cut the height of a box, from its corner `low` to `high`, where seams cross in it; return the new count.

    With very many crossings, the parts are equal ones. A picture that is parallel to the image needs no such cuts.
    """
    m = samples.maps[k]
    across, down = (np.inf, -np.inf), (np.inf, -np.inf)
    for x in (low[0], high[0]):
        for y in (low[1], high[1]):
            X, Y, W = ramp_point(m, x, y)
            across = min(across[0], X / W), max(across[1], X / W)
            down = min(down[0], Y / W), max(down[1], Y / W)
    i, i_last = seams_between(samples, k, 0, across[0], across[1])
    j, j_last = seams_between(samples, k, 1, down[0], down[1])
    corners = max(i_last - i + 1, 0) * max(j_last - j + 1, 0)
    if corners == 0 or is_parallel(m):
        return count
    if corners > MOST_CORNERS:
        for part in range(1, MOST_CORNERS):
            count = add_cut(part / MOST_CORNERS, cuts, count)
        return count
    shift = 0.5 if samples.linear[k] else 1.0
    for column in range(i, i_last + 1):
        for row in range(j, j_last + 1):
            X, Y, W = corner_of(samples.inverses[k], column + shift, row + shift)
            if low[0] < X / W < high[0]:
                count = add_cut((Y / W - low[1]) / (high[1] - low[1]), cuts, count)
    return count


@kernel(allocates=False)
def is_parallel(m: NDArray[np.float64]) -> bool:
    """Return whether a map takes rows and columns of the image to rows or columns, up to rounding."""
    straight, crossed = abs(m[0, 0]) + abs(m[1, 1]), abs(m[0, 1]) + abs(m[1, 0])
    affine = m[2, 0] == 0.0 and m[2, 1] == 0.0
    return bool(affine and min(straight, crossed) <= PARALLEL * max(straight, crossed))


@kernel(allocates=False)
def corner_of(inverse: NDArray[np.float64], column: float, row: float) -> Point:
    """Map a place in a picture to homogeneous coordinates of the image."""
    X, Y, W = ramp_point(inverse, column, row)
    return X, Y, W if W != 0.0 else 1e-300
