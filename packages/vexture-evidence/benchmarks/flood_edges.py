"""Exactly filtered pictures of a shore on a plane in perspective, at rest and folded, to judge a page's pixels by.

A fold moves the places at which a shape is looked up, so the visible outline is moved the other way: its points are
where the fold takes them back to the outline, and the area that they enclose is filtered exactly.
"""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing, Path
from vexture.renderers.exact import render_exact

WORLD: Final = 100.0
"""Units of the page's world along the longer side of the frame."""

CHORD: Final = 0.25
"""Pixels; longest chord of a moved outline where it is seen: tips of creeks are a pixel round."""

COARSE: Final = 1 / 256
"""The same where it is not, in the unit square."""

STEPS: Final = 12
"""Of Newton's method."""

BORDER: Final = 64.0
"""Pixels around the picture in which outlines are as fine as in it."""

Array = NDArray[np.float64]


def water_to_unit(camera: dict[str, Any], box: Sequence[float], size: tuple[int, int]) -> Array:
    """From pixels, y down, to the unit square that lies on the water, north up; from a page's matrices, by columns.

    Parameters
    ----------
    camera : dict
        ``projection`` and ``view``, 16 numbers each, and ``level``, the water's height in the world.
    box : sequence of float
        Of the frame in the unit square; its middle is the world's origin.
    size : tuple of int
        Width and height of the picture.

    Examples
    --------
    >>> above = [1, 0, 0, 0, 0, 0, -1, 0, 0, -1, 0, 0, 0, 0, 0, 1]  # looks down: x right, z down
    >>> flat = [0.02, 0, 0, 0, 0, 0.02, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    >>> camera = {"projection": flat, "view": above, "level": 0.0}
    >>> np.round(water_to_unit(camera, (0, 0, 1, 1), (100, 100)) @ (0, 0, 1), 6)
    array([0., 1., 1.])
    """
    matrix = np.reshape(camera["projection"], (4, 4)).T @ np.reshape(camera["view"], (4, 4)).T
    scale = WORLD / max(box[2] - box[0], box[3] - box[1])
    middle_u, middle_v = 0.5 * (box[0] + box[2]), 0.5 * (box[1] + box[3])
    to_world = np.array(
        [
            [scale, 0.0, -scale * middle_u],
            [0.0, 0.0, camera["level"]],
            [0.0, -scale, scale * middle_v],
            [0.0, 0.0, 1.0],
        ]
    )
    width, height = size
    to_pixels = np.array([[0.5 * width, 0, 0, 0.5 * width], [0, -0.5 * height, 0, 0.5 * height], [0, 0, 0, 1.0]])
    return np.linalg.inv(to_pixels @ matrix @ to_world)


def inside(to_unit: Array, box: Sequence[float], size: tuple[int, int]) -> NDArray[np.bool_]:
    """Pixels all four corners of which see the box, (height, width)."""
    x, y = np.meshgrid(np.arange(size[0] + 1.0), np.arange(size[1] + 1.0))
    u, v, w = np.tensordot(to_unit, np.stack([x, y, np.ones_like(x)]), 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        seen = (w > 0) & (u / w > box[0]) & (u / w < box[2]) & (v / w > box[1]) & (v / w < box[3])
    return seen[:-1, :-1] & seen[1:, :-1] & seen[:-1, 1:] & seen[1:, 1:]


def points_on(cubics: Array, t: Array) -> Array:
    """A point on each cubic, (n, 2)."""
    s = 1 - t
    weights = np.stack([s**3, 3 * s * s * t, 3 * s * t * t, t**3], axis=1)
    return (weights[:, :, None] * cubics).sum(axis=1)


def on_screen(points: Array, to_unit: Array, size: tuple[int, int]) -> Array:
    """Pixels of places of the unit square, kept near the picture; those behind the camera are NaN."""
    x, y, w = np.linalg.inv(to_unit) @ np.vstack([points.T, np.ones(len(points))])
    with np.errstate(divide="ignore", invalid="ignore"):
        pixels = np.where(w > 0, np.stack([x, y]) / w, np.nan)
    return np.clip(pixels, -BORDER, np.array(size)[:, None] + BORDER).T


def fine_points(contour: Array, to_unit: Array, size: tuple[int, int]) -> Array:
    """Points along a closed contour, near one another where they are seen, (n, 2)."""
    which, t = np.arange(len(contour)), np.zeros(len(contour))
    while True:
        points = points_on(contour[which], t)
        ends = np.roll(points, -1, axis=0)
        pixels = on_screen(points, to_unit, size)
        with np.errstate(invalid="ignore"):
            long = np.hypot(*(np.roll(pixels, -1, axis=0) - pixels).T) > CHORD
        far = np.hypot(*(ends - points).T)
        split = (far > COARSE) | (long & (far > 1e-9)) | (~np.isfinite(pixels[:, 0]) & (far > COARSE / 16))
        if not split.any():
            return points
        last = np.roll(which, -1) != which
        after = np.where(last, 1.0, np.roll(t, -1))
        middle = 0.5 * (t + after)
        order = np.argsort(np.concatenate([np.arange(len(t)), np.flatnonzero(split) + 0.5]), kind="stable")
        which = np.concatenate([which, which[split]])[order]
        t = np.concatenate([t, middle[split]])[order]


def moved_back(points: Array, fold: Any, seconds: float) -> Array:
    """Places that a fold takes to these points."""
    places = points.copy()
    for _ in range(STEPS):
        found, jacobians = fold.at(places, seconds)
        step = np.linalg.solve(jacobians, (found - points)[..., None])[..., 0]
        places -= step
        if np.abs(step).max() < 1e-12:
            break
    return places


def exact_shore(
    drawing: Drawing, size: tuple[int, int], to_unit: Array, fold: Any = None, seconds: float = 0.0
) -> NDArray[np.float64]:
    """Exact coverage of each pixel by a drawing, folded or as it is, (height, width)."""
    if fold is not None:
        paths = []
        for path in drawing.paths:
            contours = []
            for contour in path.contours:
                points = moved_back(fine_points(contour, to_unit, size), fold, seconds)
                way = np.roll(points, -1, axis=0) - points
                ends = np.roll(points, -1, axis=0)
                contours.append(np.stack([points, points + way / 3, ends - way / 3, ends], axis=1))
            paths.append(Path(tuple(contours), path.fill_rule))
        drawing = Drawing(tuple(paths), drawing.to_source, drawing.name)
    return np.float64(render_exact(drawing, size, to_unit))


def edge_errors(picture: NDArray[np.uint8], truth: Array, visible: NDArray[np.bool_]) -> Array:
    """Differences in 1/255 at the pixels that the edge passes, of a picture in two flat colours, (height, width, 3).

    The colours are those of pixels that are all water and all land; a page that does not show both has no errors.
    """
    colors = np.float64(picture)
    full, empty = visible & (truth == 1.0), visible & (truth == 0.0)
    edge = visible & (truth > 1 / 512) & (truth < 1 - 1 / 512)
    if not (full.any() and empty.any() and edge.any()):
        return np.empty(0)
    water, land = np.median(colors[full], axis=0), np.median(colors[empty], axis=0)
    way = water - land
    shares = (colors[edge] - land) @ way / (way @ way)
    return 255 * np.abs(shares - truth[edge])
