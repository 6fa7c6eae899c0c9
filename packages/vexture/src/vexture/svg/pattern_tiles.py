"""Repetition of the first tile of a pattern.

Neighbours share their border bit for bit, so that there is no seam. Contours that span a tile from border to border are
not repeated but stretched: a hatching is one strip for each of its lines.
"""

from collections import Counter
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass, replace
from math import ceil, floor
from typing import Final

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.tolerance import ROUND
from vexture.bezier.bounds import bounds
from vexture.bezier.clip import clip_contour
from vexture.bezier.convert import line_cubics, straight
from vexture.drawing.drawing import Path
from vexture.svg.compositing import Veil
from vexture.svg.report import Report, describe_element
from vexture.svg.transform import Identity, Transform, map_points, scale_of
from vexture.svg.viewport import Rectangle

MOST: Final = {"elements": 20_000, "segments": 400_000, "gradients": 2_000}
"""Limits for all patterns of a drawing: elements in first tiles, parts of all tiles, gradients (one set per tile)."""

TOUCHED: Final = 1e-6
"""Fraction of a tile; tiles that a shape reaches less far into are left out."""

LOOSE: Final = 1e-3
"""Fraction of a tile; points closer to its border than this, and than a reader's accuracy, are moved onto it."""

Window = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Least and greatest coordinates."""


@dataclass(frozen=True, slots=True)
class Canvas:
    """A surface to paint on: the drawing, or a pattern's first tile in the pattern's space."""

    frame: Rectangle | None  # the visible part; None while unknown
    size: float  # larger side of the drawing, which sets the accuracy; infinite while unknown
    whole: Transform = Identity  # map to the drawing

    @property
    def window(self) -> Window:
        """Corners of the frame, in the form that `Space.window` clips to."""
        assert self.frame is not None
        x, y, width, height = self.frame
        return np.array([x, y]), np.array([x + width, y + height])

    @property
    def sides(self) -> NDArray[np.float64]:
        """Width and height of the frame."""
        assert self.frame is not None
        return np.array(self.frame[2:])

    @property
    def near(self) -> float:
        """Distance from the border of a tile within which points are moved onto it."""
        return min(ROUND * self.size / scale_of(self.whole), LOOSE * float(self.sides.min()))

    def fit_contour(self, contour: NDArray[np.float64]) -> NDArray[np.float64]:
        """Move the points of a contour near the border onto it; return an empty contour if it then has no area."""
        lines, near = straight(contour), self.near
        for border in self.window:
            contour = np.where(np.abs(contour - border) <= near, border, contour)
        contour[lines] = line_cubics(contour[lines, 0], contour[lines, 3])
        contour = contour[(contour != contour[:, :1]).any(axis=(1, 2))]
        return contour if len(contour) and np.ptp(contour, axis=(0, 1)).all() else contour[:0]

    def spans(self, contour: NDArray[np.float64]) -> tuple[bool, bool]:
        """Return whether a contour is an upright rectangle that spans the tile across, and down."""
        ends = contour[:, 0]
        upright = (np.abs(contour[:, 3] - ends) <= self.near).any(axis=1)
        if len(contour) != 4 or not upright.all() or not straight(contour).all():
            return False, False
        low, high = self.window
        x, y = (bool(set(ends[:, axis].tolist()) == {low[axis], high[axis]}) for axis in (0, 1))
        return x, y


@dataclass(frozen=True, slots=True)
class FirstTile:
    """Paths in one tile of a pattern, in the pattern's space; their gradients are in the drawing's."""

    canvas: Canvas
    veil: Veil  # veil around everything
    painted: tuple[tuple[Path, Veil | None], ...]  # each with its innermost veil

    @classmethod
    def from_paths(cls, canvas: Canvas, veil: Veil, paths: list[Path], veils: list[Veil | None]) -> "FirstTile":
        """Fit painted paths into the tile."""
        painted = []
        for path, innermost in zip(paths, veils, strict=True):
            fitted = tuple(contour for contour in map(canvas.fit_contour, path.contours) if len(contour))
            if fitted:
                painted.append((replace(path, contours=fitted), innermost))
        return cls(canvas, veil, tuple(painted))

    def copy_veils(self) -> "FirstTile":
        """Return a copy with veils of its own."""
        return deepcopy(self, {id(path): path for path, _ in self.painted})


class Budget:
    """Numbers of tiles and curves that the patterns of a drawing may still use."""

    def __init__(self, report: Report) -> None:
        self.report = report
        self.spent: Counter[str] = Counter()

    def affords(self, pattern: etree._Element, **counts: int) -> bool:
        """Return whether a pattern may use these numbers of parts, which `MOST` limits; if not, add a note."""
        for what, count in counts.items():
            if self.spent[what] + count > MOST[what]:
                self.report.simplification(
                    f"{describe_element(pattern)} read as solid: here it has {count:,} {what} in its tiles; all"
                    f" patterns of a drawing may have {MOST[what]:,}",
                    pattern,
                )
                return False
        self.spent.update(counts)
        return True


@dataclass(frozen=True, slots=True, eq=False)
class PatternTiles:
    """The tiles over a part of the drawing."""

    tile: Canvas  # the first tile
    matrix: Transform  # from the pattern's space to the canvas
    first: tuple[int, int]  # column and row
    last: tuple[int, int]  # column and row after the last
    window: Window  # on the canvas

    @classmethod
    def over(cls, tile: Canvas, shape: list[NDArray[np.float64]], window: Window, canvas: Canvas) -> "PatternTiles":
        """Return the tiles over a shape within a window of a canvas."""
        (x, y), (width, height) = tile.window[0], tile.sides
        matrix = tile.whole if canvas.whole == Identity else canvas.whole.inverse().transform(tile.whole)
        left, top, right, bottom = bounds(map_points(np.concatenate(shape), matrix.inverse()))
        first = floor((left - x) / width + TOUCHED), floor((top - y) / height + TOUCHED)
        last = ceil((right - x) / width - TOUCHED), ceil((bottom - y) / height - TOUCHED)
        return cls(tile, matrix, first, (max(last[0], first[0] + 1), max(last[1], first[1] + 1)), window)

    @property
    def count(self) -> int:
        """Number of tiles."""
        return (self.last[0] - self.first[0]) * (self.last[1] - self.first[1])

    def cost(self, path: Path) -> tuple[int, int]:
        """Return the number of cubics and of gradients or pictures that `repeat_path` makes of a path."""
        if path.paint.is_varied:
            return self.count * sum(map(len, path.contours)), self.count
        columns, rows = self.last[0] - self.first[0], self.last[1] - self.first[1]
        cubics = 0
        for contour in path.contours:
            across, down = self.tile.spans(contour)
            cubics += len(contour) * (1 if across else columns) * (1 if down else rows)
        return cubics, 0

    def repeat_path(self, path: Path) -> list[Path]:
        """Repeat a path of the first tile in all tiles."""
        if path.paint.is_varied:
            return [copy for at in self._places(False, False) for copy in self._gradient_tile(path, at)]
        contours: list[NDArray[np.float64]] = []
        for contour in path.contours:
            check_time()
            stretched = self.tile.spans(contour)
            start = self._places(*stretched)
            contours += self._move_contour(
                contour, start, np.where(stretched, np.array(self.last, np.float64), start + 1.0)
            )
        return [replace(path, contours=tuple(contours))] if contours else []

    def _places(self, across: bool, down: bool) -> NDArray[np.float64]:
        """Return the columns and rows of tiles, (m, 2); along a given axis only the first ones."""
        ends = zip(self.first, self.last, (across, down), strict=True)
        columns, rows = (np.arange(first, first + 1 if one else last, dtype=np.float64) for first, last, one in ends)
        return np.stack(np.meshgrid(columns, rows), axis=-1).reshape(-1, 2)

    def _gradient_tile(self, path: Path, at: NDArray[np.float64]) -> Iterator[Path]:
        """Yield a path with a gradient or a picture, in one tile."""
        check_time()
        contours = [part for contour in path.contours for part in self._move_contour(contour, at[None], at[None] + 1.0)]
        if contours:
            a, b, c, d = self.tile.whole[:4]
            x, y = (at * self.tile.sides).tolist()
            paint = path.paint.after(((1.0, 0.0, -a * x - c * y), (0.0, 1.0, -b * x - d * y)))
            yield replace(path, contours=tuple(contours), paint=paint)

    def _move_contour(
        self, contour: NDArray[np.float64], start: NDArray[np.float64], end: NDArray[np.float64]
    ) -> list[NDArray[np.float64]]:
        """Copy a contour of the first tile into other tiles on the canvas, clipped to the window.

        Points on the greater borders move to the columns and rows `end`, (m, 2), and all others to `start`.
        """
        low, high = self.tile.window
        on_end = contour == high
        base = np.where(on_end, low, contour)
        index = np.where(on_end, end[:, None, None], start[:, None, None])
        points = base + index * self.tile.sides
        if (end - start > 1.0).any():
            ends = points[:, :, 0]
            points = line_cubics(ends, np.roll(ends, -1, axis=1))
        points = map_points(points, self.matrix)
        low, high = self.window
        least, most = points.min(axis=(1, 2)), points.max(axis=(1, 2))
        inside = ((least >= low) & (most <= high)).all(axis=1)
        found = []
        for k in np.flatnonzero(((least < high) & (most > low)).all(axis=1)).tolist():
            part = points[k] if inside[k] else clip_contour(points[k], low, high)
            if len(part):
                found.append(part)
        return found


def visible(shape: list[NDArray[np.float64]], frame: Rectangle) -> tuple[list[NDArray[np.float64]], Window]:
    """Return the part of a shape inside a frame, and its bounding box."""
    x, y, width, height = frame
    cut = (clip_contour(contour, (x, y), (x + width, y + height)) for contour in shape)
    inside = [contour for contour in cut if len(contour)]
    box = bounds(np.concatenate(inside)) if inside else (x, y, x, y)
    return inside, (np.array(box[:2]), np.array(box[2:]))


def is_window(shape: list[NDArray[np.float64]], window: Window) -> bool:
    """Return whether a shape is an upright rectangle, bit for bit, and so equal to its bounding box."""
    if len(shape) != 1 or len(shape[0]) != 4:
        return False
    (left, top), (right, bottom) = (corner.tolist() for corner in window)
    corners = {(x, y) for x in (left, right) for y in (top, bottom)}
    upright = (np.ptp(shape[0], axis=1) == 0.0).any(axis=1)
    return bool(upright.all()) and {(x, y) for x, y in shape[0][:, 0].tolist()} == corners
