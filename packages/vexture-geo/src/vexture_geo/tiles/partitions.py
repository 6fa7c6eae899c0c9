"""Divide a source into parts of the world, each small enough for one job; on disk, as the source may be large."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture.base.tolerance import ROUND
from vexture_geo.base.crs import format_bounds, period, refuse_metres, system, transform_points
from vexture_geo.base.longitudes import note_short_ways, unwrap_rings
from vexture_geo.base.rings import Rings, cut, map_rings, refuse_far, repair_rings, within
from vexture_geo.tiles.grid import CRS, HALF, LATITUDE, MARGIN, Tile, pixel, widen_box
from vexture_geo.tiles.pieces import FeaturePieces, join_pieces, schema

BENT: Final = 0.02
"""Largest error of a projected side, in pixels of the largest zoom."""

BEYOND: Final = 2.0 * MARGIN
"""Turns beyond the world on each side, to the east and the west, that the single tile at zoom 0 shows."""

DEGREES: Final = "EPSG:4326"


def in_world(features: Any, first: int, most: int, notes: Notes) -> FeaturePieces:
    """Cut a batch of features, numbered from `first`, into pieces for tiles up to a zoom."""
    rings, own = features.rings, features.crs
    if not len(rings.ends):
        return FeaturePieces(np.empty(0, np.int64), np.empty(0, object), np.empty(0, object))
    refuse_far(rings, "correct it")
    rings = _in_degrees(rings, own, most, notes) if system(own).is_geographic else _in_metres(rings, own, notes)
    feature = np.asarray(rings.feature, np.int64)
    ids = np.asarray(features.ids, object)[feature]
    return FeaturePieces(feature + first, ids, rings.shapes)


def _in_degrees(rings: Rings, crs: str, most: int, notes: Notes) -> Rings:
    """Project rings from longitude and latitude to metres, with copies beyond the antimeridian."""
    turn = period(crs)
    assert turn is not None
    degree = turn / 360.0
    refuse_metres(rings.points, crs, f"the coordinates {format_bounds(rings.box, crs)}")
    note_short_ways(rings.steps, turn, notes)
    rings = repair_rings(unwrap_rings(rings, turn), notes)
    reach = turn / 2.0 * (1.0 + BEYOND)
    world = (-reach, -LATITUDE * degree, reach, LATITUDE * degree)
    boxes = rings.boxes
    if (np.abs(boxes[:, :, 0]) > turn / 2.0 * (1.0 - BEYOND)).any() or (np.abs(boxes[:, :, 1]) > world[3]).any():
        rings = cut(within(rings, world, turn), world)
    if not len(rings.ends):
        return rings
    size = np.full(2, BENT * pixel(most) / ROUND)
    wide = 2.0 * HALF
    rings = map_rings(rings, lambda points: _project(points, crs, turn), (-wide, -wide, wide, wide), size)
    refuse_far(rings, "correct it")
    return _cut_to_world(rings)


def _project(points: Any, crs: str, turn: float) -> Any:
    """Project points to metres; those beyond the antimeridian stay beyond it."""
    turns = np.rint(points[:, 0] / turn)
    image = transform_points(points - np.stack([turns * turn, np.zeros(len(turns))], axis=1), crs, CRS)
    return image + np.stack([turns * 2.0 * HALF, np.zeros(len(turns))], axis=1)


def _in_metres(rings: Rings, crs: str, notes: Notes) -> Rings:
    """Project rings from a projected system to metres of Web Mercator."""
    rings = repair_rings(rings, notes)
    if crs != CRS:
        size = np.full(2, 1.0)
        wide = 2.0 * HALF
        rings = map_rings(rings, lambda points: transform_points(points, crs, CRS), (-wide, -wide, wide, wide), size)
        if not np.isfinite(rings.points).all():
            raise SourceError("it has points without a place in the tiles' projection, EPSG:3857; correct its `crs`")
        rings = repair_rings(rings, Notes())
    rings = within(rings, _world(), 2.0 * HALF)
    return _cut_to_world(rings)


def _world() -> tuple[float, float, float, float]:
    reach = HALF * (1.0 + BEYOND)
    return (-reach, -HALF, reach, HALF)


def _cut_to_world(rings: Rings) -> Rings:
    return cut(rings, _world()) if len(rings.ends) else rings


WEIGHT: Final = 200_000
"""Points above which a part is split: some seconds of work."""

TILE_WEIGHT: Final = 64
"""Points that take about as long as one more tile of the largest zoom crossed by a border."""

GROUP: Final = 200_000
"""Points that are buffered for a file before they are written."""

DEEPEST: Final = 6
"""Most zooms that one pass over a part goes down, because each new part needs an open file."""


@dataclass(frozen=True)
class SourcePart:
    """Tile of a part, and the amount of work in it."""

    tile: Tile
    weight: float


class _File:
    """A growing file of pieces, which exists once something is in it."""

    def __init__(self, folder: Path, tile: Tile, finest: float) -> None:
        self._path, self._tile, self._finest = folder / f"{tile.name}.parquet", tile, finest
        self._waiting: list[FeaturePieces] = []
        self._points = 0
        self._writer: Any = None
        self.weight = 0.0

    def add(self, pieces: FeaturePieces) -> None:
        """Append pieces."""
        import shapely

        points = pieces.points
        self.weight += points + TILE_WEIGHT * float(shapely.length(pieces.shapes).sum()) / self._finest
        self._waiting.append(pieces)
        self._points += points
        if self._points >= GROUP:
            self._flush()

    def _flush(self) -> None:
        import pyarrow.parquet as pq

        if self._writer is None:
            self._writer = pq.ParquetWriter(self._path, schema())
        self._writer.write_table(join_pieces(self._waiting).to_table())
        self._waiting, self._points = [], 0

    def close(self) -> SourcePart:
        """Write buffered pieces."""
        self._flush()
        self._writer.close()
        return SourcePart(self._tile, self.weight)


def partition_source(
    source: Iterable[FeaturePieces], folder: Path, most: int, step: int, report: Callable[[str], None] = lambda _: None
) -> list[SourcePart]:
    """Write the pieces of a source into files of a folder, and return the parts, in order.

    `most` is the largest zoom of tiles, and `step` divides the zooms of parts.
    """
    world = Tile(0, 0, 0)
    first = _spread(source, world, 0, folder, most)
    waiting, found = list(first), []
    while waiting:
        part = waiting.pop()
        below = _steps(part, most, step)
        if below == 0:
            found.append(part)
            continue
        path = folder / f"{part.tile.name}.parquet"
        report(f"parts: {len(found) + len(waiting) + 1}")
        waiting += split(_batches(path), part.tile, below, folder, most)
        path.unlink()
    found.sort(key=lambda part: part.tile)
    return found


def _steps(part: SourcePart, most: int, step: int) -> int:
    """Count the zooms to go down until parts are small enough."""
    steps = 0
    while part.weight > WEIGHT << 2 * steps and steps < DEEPEST and part.tile.z + steps + step <= most:
        steps += step
    return steps


def split(source: Iterable[FeaturePieces], tile: Tile, steps: int, folder: Path, most: int) -> list[SourcePart]:
    """Divide a tile into parts some zooms below, as files of a folder."""
    return _spread(source, tile, steps, folder, most)


def _spread(source: Iterable[FeaturePieces], tile: Tile, steps: int, folder: Path, most: int) -> list[SourcePart]:
    files: dict[Tile, _File] = {}
    finest = Tile(most, 0, 0).side
    try:
        for pieces in source:
            for part, inside in _parts(pieces, tile, tile.z + steps):
                if part not in files:
                    files[part] = _File(folder, part, finest)
                files[part].add(inside)
    finally:
        found = [file.close() for file in files.values()]
    return found


def _parts(pieces: FeaturePieces, tile: Tile, zoom: int) -> Iterator[tuple[Tile, FeaturePieces]]:
    """Divide pieces among the tiles of a zoom, each with its margin."""
    inside = pieces.within(widen_box(tile.box, MARGIN * Tile(zoom, 0, 0).side))
    if not len(inside):
        return
    if tile.z == zoom:
        yield tile, inside
        return
    for part in tile.below(1):
        yield from _parts(inside, part, zoom)


def _batches(path: Path) -> Iterator[FeaturePieces]:
    """Yield the pieces of a file, batch by batch."""
    import pyarrow.parquet as pq

    with pq.ParquetFile(path) as file:
        for number in range(file.num_row_groups):
            yield FeaturePieces.of_table(file.read_row_group(number, use_threads=False))
