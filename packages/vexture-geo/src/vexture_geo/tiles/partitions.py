"""Divide a source into parts of the world, each small enough for one job; on disk, as the source may be large."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from vexture_geo.tiles.grid import MARGIN, Tile, widen_box
from vexture_geo.tiles.pieces import FeaturePieces, join_pieces, schema

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
