"""Symbols at points: a drawing at each point, without most of what other symbols hide where they crowd."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.bezier.cover import DIRECTIONS, cover_cells, cut_outlines, find_reach
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture_geo.maps.paths import MapFit

CROWD: Final = 1024
"""Number of symbols below which hidden parts are kept, because their map takes little time anyway."""

FINE: Final = 8
"""Cells of the grid of hidden areas in the radius of a symbol of median size."""

MOST_CELLS: Final = 1 << 24
"""Most cells of the grid: 64 MB."""

MOST_VISITS: Final = 1 << 28
"""Most cells in the boxes of all symbols together: some seconds."""

INNER: Final = 1.0 - 1e-6
"""Fraction of a circle that counts, to allow for rounding."""

STRAIGHT: Final = 1e-9
"""Angle, in radians, by which rounding may turn a convex outline back."""


@dataclass(frozen=True, eq=False)
class Symbols:
    """Copies of a drawing's paths at points.

    Parameters
    ----------
    symbol : Drawing
    points : (n, 2) float64 array
    sizes : (n,) float64 array
        In the units of the map, like the points.
    names : list of str
        Element of each point.
    paints : list
        Paint of each; None keeps the drawing's own paints.

    Raises
    ------
    SourceError
        If a point or a size is not finite.
    """

    symbol: Drawing
    points: NDArray[np.float64]
    sizes: NDArray[np.float64]
    names: list[str]
    paints: list[Paint | None]

    def __post_init__(self) -> None:
        if not (np.isfinite(self.points).all() and np.isfinite(self.sizes).all()):
            raise SourceError("a point has no place on the map; choose another `crs`")

    def __len__(self) -> int:
        return len(self.names)

    def _copies(self, path: Path) -> NDArray[np.float64]:
        """Cubics of a path of the drawing at each point, (n, m, 4, 2), in the units of the map.

        All are placed at once, because an operation for each of hundreds of thousands would take seconds.
        """
        return (np.concatenate(path.contours) - 0.5) * self.sizes[:, None, None, None] + self.points[:, None, None, :]

    @property
    def corners(self) -> NDArray[np.float64]:
        """Least and greatest coordinates of the start points of cubics, (2, 2) or (0, 2), in the units of the map."""
        low, high = [], []
        for path in self.symbol.paths:
            for start in np.concatenate(path.contours)[:, 0] if path.contours else ():
                places = (start - 0.5) * self.sizes[:, None] + self.points
                low.append(places.min(axis=0))
                high.append(places.max(axis=0))
        return np.array([np.min(low, axis=0), np.max(high, axis=0)]) if low and len(self) else np.empty((0, 2))

    def paths(self, fit: MapFit) -> Iterator[Path]:
        """Yield all paths, uncut, in the unit square."""
        copies = []
        for path in self.symbol.paths:
            spans = [*pairwise([0, *np.cumsum([len(contour) for contour in path.contours]).tolist()])]
            own = Paint(path.paint.color, path.paint.opacity)
            copies.append((fit.inward(self._copies(path)) if spans else None, spans, path.fill_rule, own))
        for number, (name, paint) in enumerate(zip(self.names, self.paints, strict=True)):
            for moved, spans, rule, own in copies:
                contours = () if moved is None else tuple(moved[number, start:end] for start, end in spans)
                yield Path.unchecked(contours, rule, paint or own, element=name)

    def seen_paths(self, fit: MapFit) -> Iterator[Path]:
        """Yield the paths in the unit square; where many convex ones crowd, without most of what later ones hide.

        A path that is wholly hidden has no contours; its element exists, like that of any feature.
        """
        circles = _circles(self.symbol)
        if circles is None or len(self) < CROWD:
            yield from self.paths(fit)
            return
        (path,) = self.symbol.paths
        own = Paint(path.paint.color, path.paint.opacity)
        paints = [paint or own for paint in self.paints]
        opaque = {id(paint): paint.is_opaque for paint in paints}
        outlines = fit.inward(self._copies(path))
        middles = fit.inward((circles.middle - 0.5) * self.sizes[:, None] + self.points)
        inner = self.sizes * circles.inner / fit.scale * [opaque[id(paint)] for paint in paints]
        cubics, ends, hides = _cut_hidden(outlines, middles, inner, self.sizes * circles.outer / fit.scale)
        spans = pairwise([0, *ends.tolist()])
        for name, paint, (start, end), one_hides in zip(self.names, paints, spans, hides.tolist(), strict=True):
            contours = (cubics[start:end],) if end > start else ()
            yield Path.unchecked(contours, path.fill_rule, paint, element=name, hides=one_hides)


class _Circles(NamedTuple):
    """Concentric circles in and around a convex outline."""

    middle: NDArray[np.float64]
    inner: float
    outer: float


def _circles(symbol: Drawing) -> _Circles | None:
    """Circles in and around the outline of a drawing; None unless it is one convex contour."""
    contours = [contour for path in symbol.paths for contour in path.contours]
    if len(contours) != 1 or len(symbol.paths) != 1:
        return None
    corners = contours[0][:, :3].reshape(-1, 2)
    corners = corners[(corners != np.roll(corners, -1, axis=0)).any(axis=1)]
    sides = np.roll(corners, -1, axis=0) - corners
    turned = np.angle(np.roll(sides, -1, axis=0) @ (1, 1j) / (sides @ (1, 1j)))
    turned *= np.sign(turned.sum())
    if not (len(corners) > 2 and turned.min() > -STRAIGHT and turned.sum() < 2.5 * np.pi):
        return None
    fine = contours[0]
    for _ in range(3):
        fine = _halve_cubics(fine)
    start, end = fine[:, 0], fine[:, 3]
    middle = (start.min(axis=0) + start.max(axis=0)) / 2
    chord = end - start
    across = chord[:, 0] * (middle - start)[:, 1] - chord[:, 1] * (middle - start)[:, 0]
    far = np.abs(across) / np.maximum(np.hypot(*chord.T), 1e-300)  # to the chord's line: at most that to the chord
    is_inside = (across > 0.0).all() or (across < 0.0).all()
    outer = float(np.hypot(*(fine.reshape(-1, 2) - middle).T).max())
    return _Circles(middle, float(far.min()) * INNER if is_inside else 0.0, outer / INNER)


def _halve_cubics(cubics: NDArray[np.float64]) -> NDArray[np.float64]:
    """Halve each cubic by de Casteljau's algorithm."""
    a, b, c, d = cubics.transpose(1, 0, 2)
    p, q, r = (a + b) / 2, (b + c) / 2, (c + d) / 2
    s, t = (p + q) / 2, (q + r) / 2
    m = (s + t) / 2
    return np.stack([a, p, s, m, m, t, r, d], axis=1).reshape(-1, 4, 2)


def _cut_hidden(
    outlines: NDArray[np.float64], middles: NDArray[np.float64], inner: NDArray[np.float64], outer: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.bool_]]:
    """Visible parts of outlines (n, m, 4, 2), the index after the last cubic of each, and which of them hide others."""
    count = len(outlines)
    low, high = (middles - outer[:, None]).min(axis=0), (middles + outer[:, None]).max(axis=0)
    wide, tall = high - low
    step = max(
        float(np.median(outer)) / FINE,
        float(np.sqrt(wide * tall / MOST_CELLS)),
        float(np.sqrt((4.0 * outer * outer).sum() / MOST_VISITS)),
    )
    top = np.full((int(tall / step) + 2, int(wide / step) + 2), -1, np.int32)
    places = (middles - low) / step
    cover_cells(np.column_stack([places, inner / step]), top)
    reach, hides = np.empty((count, DIRECTIONS)), np.zeros(count, np.bool_)
    find_reach(np.column_stack([places, outer / step]), top, reach, hides)
    ends = np.empty(count, np.int64)
    left = cut_outlines(outlines, np.column_stack([middles, outer]), reach * step, ends)
    if np.array_equal(left, outlines.reshape(-1, 4, 2)):
        hides[:] = False
    return left, ends, hides
