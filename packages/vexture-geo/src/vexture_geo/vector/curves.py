"""Straighten curves in WKB: arcs in lines and rings become chords, and surfaces become their polygons."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from struct import Struct, error, pack
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.errors import LimitError
from vexture.base.tolerance import ROUND

HEAD: Final = 5
"""Bytes of a geometry that give its kind."""

BROKEN: Final = b"\x01"
"""Bytes that no reader of WKB accepts as a geometry."""

POINT, LINE, POLYGON, COLLECTION = 1, 2, 3, 7
ARCS, COMPOUND, CURVED = 8, 9, 10
TRIANGLE: Final = 17

STRAIGHT: Final = {ARCS: LINE, COMPOUND: LINE, CURVED: POLYGON, 11: 5, 12: 6, 15: 6, 16: 6, TRIANGLE: POLYGON}
"""Kinds of WKB geometries that GEOS cannot hold, and the kinds that replace them: 11 and 12 are collections of curves
and of surfaces, 15 and 16 surfaces of polygons and of triangles."""

PARTED: Final = (4, 5, 6, COLLECTION, COMPOUND, CURVED, 11, 12, 15, 16)
"""Kinds that consist of other geometries."""

FLAGS: Final = 0xE0000000
"""Flags of extended WKB: it has z, m and the number of a reference system."""

DEEPEST: Final = 16
"""Most levels of nested collections."""

ARC: Final = 5e-4
"""Largest distance of chords from an arc, as a fraction of the distance between its points, because a pyramid of tiles
shows arcs closely. Chords are also within `ROUND` of the extent of all curves."""

LEAST_PIECES: Final = 4
"""Fewest chords of a whole circle."""

FLAT: Final = 1e-12
"""Fraction of the square of their distance: three points that span a smaller area are collinear."""

FARTHEST: Final = 1e3
"""Largest radius in distances between the points of an arc; a larger arc is never the long way around."""

MOST_POINTS: Final = 50_000_000
"""Most ends of chords in all curves."""


@dataclass(frozen=True, eq=False)
class _Shape:
    """A geometry: its kind, and its points, rings or parts."""

    kind: int
    rings: list[NDArray[np.float64]] = field(default_factory=list)
    parts: list["_Shape"] = field(default_factory=list)

    def each(self) -> Iterator["_Shape"]:
        """Yield the geometry and everything that it consists of."""
        yield self
        for part in self.parts:
            yield from part.each()


class _Reader:
    """Reader of one geometry in WKB, which raises a `ValueError` or `struct.error` for damage."""

    def __init__(self, content: bytes) -> None:
        self.content, self.at = content, 0

    def shape(self, depth: int = 0) -> _Shape:
        """Read the geometry that begins here."""
        (order,) = self._numbers("<B")
        sign = "<" if order else ">"
        (code,) = self._numbers(f"{sign}I")
        kind, size = _kind_of(code)
        self.at += 4 * bool(code & 0x20000000)
        if kind == POINT:
            return _Shape(kind, [self._points(sign, size, 1)])
        (count,) = self._numbers(f"{sign}I")
        if kind in (LINE, ARCS):
            return _Shape(kind, [self._points(sign, size, count)])
        if kind in (POLYGON, TRIANGLE):
            return _Shape(kind, [self._points(sign, size, *self._numbers(f"{sign}I")) for _ in range(count)])
        if kind not in PARTED or depth > DEEPEST:
            raise ValueError(f"no geometry is of the kind {kind}")
        return _Shape(kind, parts=[self.shape(depth + 1) for _ in range(count)])

    def _numbers(self, form: str) -> tuple[int, ...]:
        found = Struct(form).unpack_from(self.content, self.at)
        self.at += Struct(form).size
        return found

    def _points(self, sign: str, size: int, count: int) -> NDArray[np.float64]:
        if count * size * 8 > len(self.content) - self.at:
            raise ValueError("it ends within its points")
        found = np.frombuffer(self.content, f"{sign}f8", count * size, self.at).reshape(count, size)
        self.at += found.nbytes
        return found[:, :2].astype(np.float64)


def straighten_curves(shapes: NDArray[Any]) -> NDArray[Any]:
    """Replace curves in WKB geometries by chords; curved geometries lose z and m, and damaged ones become `BROKEN`.

    Chords are within `ROUND` of the extent of all curves. An arc has the same chords in both directions, so that
    neighbours still share their border.

    Raises a `LimitError` if they are too many.
    """
    found = dict[int, _Shape | None]()
    kinds = dict[bytes, int]()  # cached, because millions of geometries share the same head
    for place, content in enumerate(shapes):
        if not isinstance(content, bytes):
            continue
        head = content[:HEAD]
        kind = kinds[head] if head in kinds else kinds.setdefault(head, _kind_at(head))
        if kind in (COLLECTION, *STRAIGHT):
            check_time()
            try:
                shape = _Reader(content).shape()
            except (ValueError, error):
                found |= {} if kind == COLLECTION else {place: None}
                continue
            if any(each.kind in STRAIGHT for each in shape.each()):
                found[place] = shape
    if not found:
        return shapes
    curves = [shape for shape in found.values() if shape is not None]
    points = [np.empty((0, 2)), *(ring for shape in curves for each in shape.each() for ring in each.rings)]
    every = np.concatenate(points)
    every = every[np.isfinite(every).all(axis=1)]
    chords = _Chords(ROUND * float(np.ptp(every, axis=0).max()) if len(every) else 0.0)
    made = shapes.copy()
    for place, one in found.items():
        try:
            made[place] = BROKEN if one is None else chords.written(one)
        except ValueError:
            made[place] = BROKEN
    return made


def _kind_of(code: int) -> tuple[int, int]:
    """Return the kind of a geometry and the number of coordinates of its points, in either notation of z and m."""
    kind = code & ~FLAGS
    iso = kind // 1000
    size = 2 + bool(code & 0x80000000) + bool(code & 0x40000000)
    return kind % 1000, size + (0, 1, 1, 2)[iso] if iso < 4 else size


def _kind_at(content: bytes) -> int:
    """Return the kind of a geometry by its first bytes; 0 if they are missing."""
    return _kind_of(int.from_bytes(content[1:5], "little" if content[0] else "big"))[0] if len(content) >= 5 else 0


class _Chords:
    """Writer of geometries with chords in place of arcs, at most `distance` from them."""

    def __init__(self, distance: float) -> None:
        self.distance, self.count = distance, 0

    def written(self, shape: _Shape) -> bytes:
        """Encode a geometry as WKB; a `ValueError` if an arc lacks a point."""
        kind = STRAIGHT.get(shape.kind, shape.kind)
        head = pack("<BI", 1, kind)
        if kind == POINT:
            return head + shape.rings[0].tobytes()
        if kind == LINE:
            return head + _counted_points(self._line(shape))
        if kind == POLYGON:
            rings = [self._line(part) for part in shape.parts] if shape.kind == CURVED else shape.rings
            return head + pack("<I", len(rings)) + b"".join(map(_counted_points, rings))
        return head + pack("<I", len(shape.parts)) + b"".join(map(self.written, shape.parts))

    def _line(self, shape: _Shape) -> NDArray[np.float64]:
        """Collect the points of a line, of arcs, or of a sequence of both."""
        if shape.kind == LINE:
            return shape.rings[0]
        if shape.kind == ARCS:
            return self._along(shape.rings[0])
        if shape.kind != COMPOUND:
            raise ValueError("it is no curve")
        lines = [line for part in shape.parts if len(line := self._line(part))]
        joined = [line[int(n > 0 and bool((line[0] == lines[n - 1][-1]).all())) :] for n, line in enumerate(lines)]
        return np.concatenate([np.empty((0, 2)), *joined])

    def _along(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Compute points along arcs, each from one point through the next to the one after that."""
        if not len(points):
            return points
        if len(points) % 2 == 0:
            raise ValueError("an arc has no end")
        arcs = np.stack([points[:-2:2], points[1::2], points[2::2]], axis=1)
        back = _is_back(arcs[:, 0], arcs[:, 2])
        arcs[back] = arcs[back, ::-1]
        middle, radius, first, sweep = _circles(arcs)
        size = np.ptp(arcs, axis=1).max(axis=1)
        distance = np.minimum(self.distance, ARC * size)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = 2.0 * np.arccos(np.clip(1.0 - distance / radius, -1.0, 1.0))
            wanted = np.maximum(np.abs(sweep) / step, LEAST_PIECES * np.abs(sweep) / (2.0 * np.pi))
        pieces = np.where(sweep == 0.0, 1.0, np.ceil(np.where(np.isfinite(wanted), wanted, LEAST_PIECES)))
        self.count += int(pieces.sum())
        if self.count > MOST_POINTS:
            raise LimitError(f"its curves have more than {MOST_POINTS:,} chords; choose fewer features by `where`")
        counts = pieces.astype(np.intp)
        arc = np.repeat(np.arange(len(arcs)), counts)
        number = np.arange(len(arc)) - np.repeat(np.cumsum(counts) - counts, counts)
        number = np.where(back[arc], counts[arc] - number, number)
        angle = first[arc] + sweep[arc] * number / counts[arc]
        made = middle[arc] + radius[arc, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        made[np.cumsum(counts) - counts] = points[:-2:2]
        return np.concatenate([made, points[-1:]])


def _counted_points(points: NDArray[np.float64]) -> bytes:
    return pack("<I", len(points)) + points.tobytes()


def _is_back(start: NDArray[np.float64], end: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which arcs go down or, if level, to the left, and so are divided from their other end."""
    (x, y), (end_x, end_y) = start.T, end.T
    return np.asarray((end_y < y) | ((end_y == y) & (end_x < x)))


def _circles(arcs: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    """Centre, radius, first angle and sweep of arcs through three points; the sweep of a straight arc is 0.

    An arc that ends where it starts is a circle, and its second point is opposite.
    """
    start, through, end = arcs.transpose(1, 0, 2)
    with np.errstate(all="ignore"):  # chords that are not finite are refused later
        one, other = through - start, end - start
        cross = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
        size = np.ptp(arcs, axis=1).max(axis=1)
        squares = (one**2).sum(axis=1), (other**2).sum(axis=1)
        to_middle = np.stack(
            [other[:, 1] * squares[0] - one[:, 1] * squares[1], one[:, 0] * squares[1] - other[:, 0] * squares[0]],
            axis=1,
        ) / (2.0 * cross[:, None])
        is_circle = (start == end).all(axis=1)
        to_middle = np.where(is_circle[:, None], one / 2.0, to_middle)
        radius = np.hypot(*to_middle.T)
        first, last = np.arctan2(*-to_middle.T[::-1]), np.arctan2(*(other - to_middle).T[::-1])
        way = np.where(cross > 0.0, 1.0, -1.0)
        sweep = np.where(is_circle, 2.0 * np.pi, way * ((way * (last - first)) % (2.0 * np.pi)))
        far = (radius > FARTHEST * size) & (np.abs(sweep) > np.pi)
        straight = ~is_circle & ((np.abs(cross) <= FLAT * size**2) | far)
    sweep = np.where(straight | ~np.isfinite(radius), 0.0, sweep)
    return start + np.where(np.isfinite(to_middle), to_middle, 0.0), np.nan_to_num(radius, posinf=0.0), first, sweep
