"""Pictures of a map before its conversion: drawn at once, and exact where no polygons of a layer overlap."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vexture.renderers.accumulate import Sides, render_sides
from vexture.renderers.view import Size, ViewLike
from vexture.tree.planar.style import round_colours
from vexture_geo.base.rings import Rings, orient_rings
from vexture_geo.maps.colours import rgba_of
from vexture_geo.maps.paths import MapFit
from vexture_geo.maps.prepare import DOT, FILL, INK, PaintedLayer, Prepared
from vexture_geo.maps.symbols import Symbols

CHORDS = 8
"""Chords in place of a cubic of a symbol."""


@dataclass(frozen=True, eq=False)
class _Sheet:
    """Sides, the colours of their owners, (c, 4), and the owners' rows in the map's table, followed by outlines."""

    sides: Sides
    rgba: NDArray[np.float64]
    rows: NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class MapPicture:
    """Sheets of a map, each above the ones before it."""

    sheets: tuple[_Sheet, ...]

    def draw(self, rgba: NDArray[np.float64] | None, size: Size, view: ViewLike) -> NDArray[np.float32]:
        """Draw premultiplied sRGB and opacity of each pixel, (height, width, 4), top row first.

        `rgba`, (f, 4), replaces the colours of the table's rows, and then those of the layers' outlines.
        """
        picture = np.zeros(1, np.float32)
        for sheet in self.sheets:
            above = render_sides(sheet.sides, sheet.rgba if rgba is None else rgba[sheet.rows], size, view)
            picture = above + (1.0 - above[..., 3:]) * picture
        return picture

    def colours(self, count: int) -> NDArray[np.float64]:
        """Colours of the table's rows, and then of the layers' outlines, (count, 4)."""
        rgba = np.zeros((count, 4))
        for sheet in self.sheets:
            rgba[sheet.rows] = sheet.rgba
        return round_colours(rgba)


def map_picture(ready: Prepared) -> MapPicture:
    """Make sheets of the areas, the lines and the symbols of each layer."""
    sheets: list[_Sheet] = []
    first, borders = 0, sum(len(one.features) for one in ready.layers)
    for one in ready.layers:
        rows = np.arange(first, first + len(one.features))
        first += len(one.features)
        parts = [(one.features.rings, one.colours(FILL), rows)]
        if len(one.outline.rings.ends):
            parts.append((one.outline.rings, one.outline.rgba, np.array([borders])))
            borders += 1
        parts.append((one.lines, one.colours(INK), rows))
        sheets += [_Sheet(_ring_sides(rings, ready.fit), rgba, of) for rings, rgba, of in parts if len(rings.ends)]
        if one.symbols is not None:
            sheets.append(_symbols(one, one.symbols, ready.fit, rows))
    return MapPicture(tuple(sheets))


def plain(ready: Prepared, rgba: NDArray[np.float64]) -> NDArray[np.float64]:
    """Colours of the table's rows if no attribute is shown, and then those of outlines in `rgba`."""
    changed, first = rgba.copy(), 0
    for one in ready.layers:
        features = one.features
        for colour, rows in ((FILL, features.feature), (INK, features.lines.feature), (DOT, features.points.feature)):
            changed[first + rows] = round_colours(rgba_of(colour, "fill")[None])
        first += len(features)
    return changed


def _ring_sides(rings: Rings, fit: MapFit) -> Sides:
    rings = orient_rings(rings)
    assert rings.feature is not None
    owner = np.repeat(rings.feature[rings.polygon], np.diff(rings.ends, prepend=0))
    points = fit.inward(rings.points)
    return Sides(points, points[rings.following], owner.astype(np.int64))


def _symbols(one: PaintedLayer, symbols: Symbols, fit: MapFit, rows: NDArray[np.intp]) -> _Sheet:
    """Make chords of the symbols of points; each path of a symbol has its own colour."""
    number = dict(zip(one.names.tolist(), rows.tolist(), strict=True))
    paths = [*symbols.paths(fit)]
    cubics = np.concatenate([contour for path in paths for contour in path.contours])
    counts = [sum(map(len, path.contours)) for path in paths]
    owner = np.repeat(np.arange(len(paths)), CHORDS * np.array(counts))
    t = np.linspace(0.0, 1.0, CHORDS + 1)[:, None]
    weights = np.concatenate([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3], axis=1)
    places = np.einsum("tk,nkx->ntx", weights, cubics)
    start, end = places[:, :-1].reshape(-1, 2), places[:, 1:].reshape(-1, 2)
    areas = np.bincount(owner, start[:, 0] * end[:, 1] - end[:, 0] * start[:, 1])
    turned = (areas < 0.0)[owner, None]  # outlines of drawings have either orientation
    sides = Sides(np.where(turned, end, start), np.where(turned, start, end), owner.astype(np.int64))
    rgba = np.array([(*path.paint.color, path.paint.opacity) for path in paths])
    return _Sheet(sides, rgba, np.array([number[path.element] for path in paths], np.intp))
