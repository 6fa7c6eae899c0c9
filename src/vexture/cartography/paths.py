"""Paths of a map: the polygons of each feature as one path in the unit square, without an object for each vertex."""

from collections.abc import Iterator, Sequence
from itertools import islice, pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.contours import ring_contours
from vexture.drawing import Drawing, FillRule, Path
from vexture.errors import SourceError
from vexture.geo.extent import Bounds
from vexture.geo.rings import Rings, oriented
from vexture.paint import Paint

__all__ = ["Fit", "area_paths", "fitted", "symbol_paths"]


class Fit:
    """The box of a map in the middle of the unit square, at its own aspect ratio."""

    def __init__(self, box: Bounds) -> None:
        west, south, east, north = box
        self.scale = max(east - west, north - south)
        self.low = np.array([(west + east) / 2, (south + north) / 2]) - self.scale / 2
        self.sides = ((east - west) / self.scale, (north - south) / self.scale)

    @property
    def to_source(self) -> NDArray[np.float64]:
        """Map from the unit square to the units of the map."""
        return np.array([[self.scale, 0.0, self.low[0]], [0.0, self.scale, self.low[1]]])

    def inward(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points in the unit square."""
        return np.clip((points - self.low) / self.scale, 0.0, 1.0)


def area_paths(
    rings: Rings, names: NDArray[Any], rgba: NDArray[np.float64], rank: NDArray[np.int64], fit: Fit
) -> Iterator[Path]:
    """A path of each feature's polygons, in the order of their ranks."""
    if not len(rings.ends):
        return
    rings = oriented(rings)
    assert rings.feature is not None
    contours = ring_contours(fit.inward(rings.points), rings.ends)
    owner = rings.feature[rings.polygon]
    order = np.argsort(rank[owner], kind="stable")
    ends = np.append(np.flatnonzero(np.diff(rank[owner][order])) + 1, len(order))
    first, places = 0, order.tolist()
    features = owner[order[np.append(0, ends[:-1]).astype(np.intp)]]
    paints: dict[tuple[float, ...], Paint] = {}
    named = zip(ends.tolist(), names[features].tolist(), map(tuple, rgba[features].tolist()), strict=True)
    for end, name, colour in named:
        paint = paints.get(colour) or paints.setdefault(colour, Paint(colour[:3], colour[3]))
        own = tuple(contours[place] for place in places[first:end])
        yield Path.sound(own, FillRule.NONZERO, paint, element=str(name))
        first = end


def symbol_paths(
    symbol: Drawing,
    points: NDArray[np.float64],
    sizes: NDArray[np.float64],
    names: list[str],
    paints: list[Paint | None],
) -> Iterator[Path]:
    """The paths of a drawing about each of some points, of sizes in the units of the map; paints replace its own.

    All copies of a path are placed at once: of hundreds of thousands, each operation on one alone would take seconds.
    """
    if not (np.isfinite(points).all() and np.isfinite(sizes).all()):
        raise SourceError("a point has no place on the map; choose another `crs`")
    copies = []
    for path in symbol.paths:
        moved = (np.concatenate(path.contours) - 0.5) * sizes[:, None, None, None] + points[:, None, None, :]
        spans = [*pairwise([0, *np.cumsum([len(contour) for contour in path.contours]).tolist()])]
        copies.append((moved, spans, path.fill_rule, Paint(path.paint.color, path.paint.opacity)))
    for number, (name, paint) in enumerate(zip(names, paints, strict=True)):
        for moved, spans, rule, own in copies:
            contours = tuple(moved[number, start:end] for start, end in spans)
            yield Path.sound(contours, rule, paint or own, element=name)


def fitted(paths: Sequence[Path], fit: Fit) -> Iterator[Path]:
    """Paths in the units of the map, in the unit square."""
    if not paths:
        return
    contours = [contour for path in paths for contour in path.contours]
    whole = fit.inward(np.concatenate(contours))
    places = [0, *np.cumsum([len(contour) for contour in contours]).tolist()]
    moved = (whole[start:end] for start, end in pairwise(places))
    for path in paths:
        own = tuple(islice(moved, len(path.contours)))
        yield Path.sound(own, path.fill_rule, path.paint, element=path.element)
