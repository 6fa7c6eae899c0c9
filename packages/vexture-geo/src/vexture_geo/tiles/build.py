"""Build a pyramid of tiles from a source, as one file or a folder."""

import errno
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import atan, degrees, exp, pi
from pathlib import Path
from typing import Any, BinaryIO, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import about
from vexture.base.errors import DeviceError, LimitError, ParameterError, SourceError, VextureError, reason_of
from vexture.base.notes import Note, Notes
from vexture.texture.files import writable
from vexture_geo.base.crs import gis_packages
from vexture_geo.base.extent import Bounds
from vexture_geo.maps.coverage import ranks, ranks_by_area
from vexture_geo.tiles.archive import ARCHIVE, check_target, table_of, write_archive, write_folder
from vexture_geo.tiles.attributes import Attributes, paints_of, write_table
from vexture_geo.tiles.grid import HALF, MARGIN, TILE_PIXELS, Tile, last_zoom
from vexture_geo.tiles.options import TileOptions, digest_of
from vexture_geo.tiles.partitions import SourcePart, in_world, partition_source
from vexture_geo.tiles.pieces import FeaturePieces
from vexture_geo.tiles.store import SUFFIX, Store
from vexture_geo.tiles.subtree import Job, JobResult, run_job
from vexture_geo.vector.tables import check_targets
from vexture_geo.vector.vectors import is_memory

VERSION: Final = 7
"""Version of the files of unfinished pyramids; files of another version are not used."""

FULL: Final = (errno.ENOSPC, errno.EFBIG, getattr(errno, "EDQUOT", errno.ENOSPC))  # the last is not on Windows
"""Errors of a disk, or a quota of it, that is full."""

MOVES: Final = 0.25
"""Largest error of a border, in pixels, at the zoom of its tile."""

Work = Callable[[Iterator[Job], int], Iterator[JobResult]]
"""Does jobs, of which the number is given, in order."""

Report = Callable[[str, int, int], None]
"""Called with the kind of work, the number of finished jobs, and the total; 0 if it is unknown."""

RANKS: Final = "ranks.npy"
"""File of the ranks of features in the folder of an unfinished pyramid."""

WORLD: Final = (-HALF, -HALF, HALF, HALF)


@dataclass(frozen=True)
class TilesSummary:
    """Counts of a finished pyramid, and notes on it."""

    tiles: int
    contents: int
    bytes: int
    features: int
    notes: tuple[Note, ...]


@gis_packages()
def make_tiles(
    source: Any, output: Path, options: TileOptions, report: Report = lambda *_: None, batches: Any = None
) -> TilesSummary:
    """Make the pyramid of a source, as PMTiles or a folder.

    Parameters
    ----------
    source : path
        Source that `vexture_geo.vector.features.feature_batches` reads.
    output : Path
        A file ``.pmtiles``, or a folder. The table of attributes is written beside the file or into the folder.
    options : TileOptions
    report : callable
        Called with the progress of the work.
    batches : callable or None
        Replaces `feature_batches` as the source of batches of features.

    Raises
    ------
    SourceError
        If the source cannot be read, or has no polygons.
    DeviceError
        If the output cannot be written, or the executor cannot be reached.
    """
    check_target(output)
    check_targets([output, *([table] if (table := table_of(output, options.style.table)) else [])], [Path(source)])
    writable(output.parent)
    options.check_workers()
    key = {"version": VERSION, "source": digest_of(Path(source)), **options.key}
    store = Store(output.with_name(output.name + SUFFIX), key)
    try:
        facts = store.read_parts() or _read(source, store, options, report, batches)
        if facts["bounds"] is None:
            store.remove()
            raise SourceError(f"{source}: {_why_empty(facts, options.where)}")
        parts = [SourcePart(Tile(*tile), weight) for *tile, weight in facts["parts"]]
        _work(store, parts, options, report)
        made = _write_output(store, output, options, facts)
    except BaseException as error:
        store.close()
        if not store.has_parts:
            store.remove()  # the next run reads from the beginning
        if isinstance(error, VextureError) and not store.has_parts:
            raise
        if isinstance(error, Exception) and (kind_and_reason := _reason(error, output)) is not None:
            kind, reason = kind_and_reason
            raise kind(f"{reason}; {describe_unfinished(output)}") from None
        raise
    store.remove()
    return made


def _reason(error: Exception, output: Path) -> tuple[type[VextureError], str] | None:
    """Class and message of the error to raise in place of another; None to raise that itself."""
    if isinstance(error, VextureError):
        return type(error), str(error)
    if isinstance(error, MemoryError) or is_memory(error) or getattr(error, "errno", None) == errno.ENOMEM:
        return LimitError, (
            f"{output}: there is not enough memory; give `processes` 1, a larger `max_zoom`, which parts it finer, "
            "or choose fewer features by `where`"
        )
    if isinstance(error, OSError):
        reason = os.strerror(error.errno) if error.errno else reason_of(error)
        remedy = "make room, or choose another disk" if error.errno in FULL else "correct that, or write elsewhere"
        return DeviceError, f"{output}: {reason}; {remedy}"
    return None


def describe_unfinished(output: Path) -> str:
    """Describe what an unfinished pyramid has left, and how to continue."""
    folder = output.with_name(output.name + SUFFIX)
    if not folder.exists():
        return "nothing of it is finished, and reading begins anew"
    return f"what is finished is in {folder}, and the same command goes on from there"


def _read(source: Any, store: Store, options: TileOptions, report: Report, batches: Any) -> Any:
    """Split the source into parts, and return facts about it."""
    import shapely

    if batches is None:
        from vexture_geo.vector.features import feature_batches as batches
    notes = Notes()
    count, boxes, others = 0, [], 0
    attributes, order = Attributes(store.folder, options.style), Order(options.style.order)

    def pieces() -> Iterator[FeaturePieces]:
        nonlocal count, others
        for features in batches(source, **options.reading, notes=notes):
            attributes.add(features)
            others += len(features.lines.ends) + len(features.points.points)
            found = in_world(features, count, options.max_zoom, notes)
            order.add(features, found, count)
            count += len(features.ids)
            report("reading features", count, 0)
            if len(found):
                boxes.append(shapely.total_bounds(found.shapes))
                yield found

    with _name_errors(source, options):
        parts = partition_source(pieces(), store.sources, last_zoom(options.max_zoom, options.step), options.step)
        legends = attributes.close(options.layer or Path(source).name.partition(".")[0], notes)
        order.write(store.folder)
    box = shapely.total_bounds(shapely.box(*zip(*boxes, strict=True))).tolist() if boxes else None
    if others and boxes:
        notes.remark("a line or point is left out, as tiles have polygons only: vexture map draws them", others)
    facts: dict[str, Any] = {"parts": [[*part.tile, part.weight] for part in parts], "bounds": box, "features": count}
    facts |= {"legends": legends, "others": others}
    facts["notes"] = [[note.kind, note.message, note.count] for note in notes.in_order]
    store.write_parts(facts)
    return facts


@contextmanager
def _name_errors(source: Any, options: TileOptions) -> Iterator[None]:
    """Prefix errors with the source's name; columns may be read for colours or the order only."""
    style = options.style
    columns = {"color": style.color and style.color.column, "order": style.order}
    with about(str(source)):
        try:
            yield
        except ParameterError as error:
            named = (name for name, column in columns.items() if f"no column {column!r} " in str(error))
            said = str(error).replace("`columns`", f"`{next(named, 'columns')}`").replace("`crs`", "`source_crs`")
            raise type(error)(said) from None
        except VextureError as error:
            raise type(error)(str(error).replace("`crs`", "`source_crs`")) from None


def _work(store: Store, parts: list[SourcePart], options: TileOptions, report: Report) -> None:
    """Do all missing work: the parts, then the geometry of each zoom, and then the tiles of all these zooms."""
    leaves = {part.tile for part in parts}
    pyramid = options.pyramid(paints_of(store.folder), ranks_of(store.folder))

    def work(jobs: Iterator[Job], count: int) -> Iterator[JobResult]:
        return options.executor().map(run_job, pyramid, jobs, count)

    def leaf(tile: Tile) -> Job:
        return Job("leaf", tile, ((store.sources / f"{tile.name}.parquet").read_bytes(),))

    _do_all(store, "leaf", [part.tile for part in sorted(parts, key=lambda part: -part.weight)], leaf, work, report)
    above = [zoom for zoom in options.coarse if zoom < max(tile.z for tile in leaves)]
    inner = {zoom: sorted({tile.parent(zoom) for tile in leaves if tile.z > zoom}) for zoom in above}

    def join(tile: Tile) -> Job:
        names = [_geometry_name(store, part) for part in tile.below(options.step)]
        return Job("join", tile, tuple(store.geometry(name) for name in names if name))

    for zoom in reversed(above):
        _do_all(store, "join", inner[zoom], join, work, report)

    def one(tile: Tile) -> Job:
        around = [(tile, 0.0), *tile.around()]
        found = [(data, shift) for each, shift in around if (data := _around(store, leaves, each))]
        return Job("tile", tile, tuple(data for data, _ in found), tuple(shift for _, shift in found))

    # all tiles at once, so that no worker waits at the end of a zoom; low zooms first, because they hold most
    _do_all(
        store, "tile", [tile for zoom in above if zoom >= options.min_zoom for tile in inner[zoom]], one, work, report
    )


def _geometry_name(store: Store, tile: Tile) -> str | None:
    """Name of the job that made a tile's geometry; None if the tile is empty."""
    return next((name for kind in ("leaf", "join") if store.has(name := f"{kind}-{tile.name}")), None)


def _around(store: Store, leaves: set[Tile], tile: Tile) -> bytes | None:
    """Geometry that contains a tile: its own, or the source of the part in which it lies."""
    if name := _geometry_name(store, tile):
        data = store.geometry(name)
        if data:
            return data
    for zoom in range(tile.z, -1, -1):
        if (part := tile.parent(zoom)) in leaves:
            return (store.sources / f"{part.name}.parquet").read_bytes()
    return None


def _do_all(store: Store, kind: str, tiles: list[Tile], job: Callable[[Tile], Job], work: Work, report: Report) -> None:
    """Do all missing work of one kind."""
    missing = [tile for tile in tiles if not store.has(f"{kind}-{tile.name}")]
    before = len(tiles) - len(missing)
    made = work((job(tile) for tile in missing), len(missing))
    for number, (tile, found) in enumerate(zip(missing, made, strict=True), before + 1):
        store.add(f"{kind}-{tile.name}", found)
        report(WORDS[kind], number, len(tiles))


WORDS: Final = {"leaf": "parts", "join": "generalising", "tile": "tiles"}
"""Names of kinds of work in progress reports."""


def _write_output(store: Store, output: Path, options: TileOptions, facts: Any) -> TilesSummary:
    """Write the pyramid with its metadata and its table."""
    runs, contents = store.tiles()
    zooms = options.zooms
    about: dict[str, Any] = {"name": options.name or output.stem, "attribution": options.attribution}
    about["vexture"] = {"margin": MARGIN, "zooms": list(zooms), "sharp": options.max_zoom}
    about["vexture"]["tolerance"] = MOVES / TILE_PIXELS
    about["vexture"] |= {"legends": legends} if (legends := facts["legends"]) else {}
    table = table_of(output, options.style.table)
    extra: dict[Path, Callable[[BinaryIO], None]] = {}
    if table is not None:
        about["vexture"]["table"] = table.name
        extra[table] = lambda file: write_table(file, store.folder, options.style.table, legends)
    write = write_archive if output.suffix.lower() == ARCHIVE else write_folder
    size = write(output, runs, contents, zooms, _degrees(facts["bounds"]), about, extra)
    notes = tuple(Note(*note) for note in facts["notes"])
    return TilesSummary(sum(count for _, count, _ in runs), len(contents), size, facts["features"], notes)


def _why_empty(facts: Any, condition: str | None) -> str:
    """Explain why there is nothing to draw, and what to do."""
    if not facts["features"]:
        return f"no feature meets `where` {condition!r}; correct it" if condition else "it has no features; give some"
    if others := facts["others"]:
        return f"it has lines or points ({others}), but no polygon, and tiles have only these; draw it by vexture map"
    return "it has no polygon in the tiles' projection; give polygons"


def _degrees(box: list[float]) -> Bounds:
    """Return west, south, east and north in degrees, clipped to the world."""
    west, south, east, north = (min(max(value, -HALF), HALF) / HALF * pi for value in box)
    low, high = (degrees(2.0 * atan(exp(y)) - pi / 2.0) for y in (south, north))
    return (degrees(west), low, degrees(east), high)


class Order:
    """Order of a source's features, which come in batches: by a column, or else smaller above larger."""

    def __init__(self, column: str | None) -> None:
        self._column = column
        self._areas: list[NDArray[np.float64]] = []
        self._values: list[Any] = []
        self._features: Any = None

    def add(self, features: Any, found: FeaturePieces, first: int) -> None:
        """Append a batch of features, numbered from `first`, and their pieces in the world."""
        if self._column is None:
            import shapely

            inside = found.within(WORLD)  # copies beyond the antimeridian do not count
            area: NDArray[np.float64] = shapely.area(inside.shapes)
            self._areas.append(np.bincount(inside.order - first, area, len(features.ids)).astype(np.float64))
            return
        if self._features is None:
            ranks(features, self._column)  # its error reports a wrong column before all is read
            self._features = features
        self._values.append(features.table.column(self._column))

    def write(self, folder: Path) -> None:
        """Write the rank of each feature, 0 for the lowest."""
        np.save(folder / RANKS, self._ranks().astype(np.uint32))

    def _ranks(self) -> NDArray[np.int64]:
        if self._column is None:
            return ranks_by_area(np.concatenate([np.empty(0), *self._areas]))
        if self._features is None:
            return np.empty(0, np.int64)
        import pyarrow as pa

        chunks = [chunk for column in self._values for chunk in column.chunks]
        values = pa.chunked_array(chunks, self._values[0].type)
        whole = replace(self._features, ids=np.empty(len(values), object), table=pa.table({self._column: values}))
        return ranks(whole, self._column)


def ranks_of(folder: Path) -> NDArray[np.uint32]:
    """Read the ranks of features by their numbers: where they overlap, the higher one is visible."""
    found: NDArray[np.uint32] = np.load(folder / RANKS)
    return found
