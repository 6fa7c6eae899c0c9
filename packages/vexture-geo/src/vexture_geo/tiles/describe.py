"""Read facts about a pyramid of tiles from its file or folder."""

import gzip
import hashlib
import json
import mmap
import zlib
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from vexture.base.content import decompress
from vexture.base.errors import DeviceError, FormatError, SourceError, format_count, reason_of
from vexture.base.layout import PACKED_SUFFIX
from vexture_geo.tiles.archive import ARCHIVE, LISTED

MAGIC: Final = b"PMTiles"

HEADER: Final = 127
"""Bytes in an archive's header."""

DEEPEST: Final = 3
"""Levels of directories below the root."""

REMEDY: Final = "make it again by vexture tiles"

Bytes = Callable[[int, int], bytes]
"""Reads bytes of a file from an offset, and a number of them."""


@dataclass
class ZoomCount:
    """Counts of the tiles of a zoom."""

    tiles: int = 0
    sizes: dict[Any, int] = field(default_factory=dict)

    def add(self, tiles: int, content: Any, size: int) -> None:
        """Count tiles that are equal, by a key of their content and its bytes."""
        self.tiles += tiles
        self.sizes[content] = size


@dataclass(frozen=True)
class TileCount:
    """Counts of tiles: equal tiles share one content; `bytes` is the size of the archive or of all contents."""

    tiles: int
    contents: int
    bytes: int
    largest: str
    largest_bytes: int
    levels: dict[int, ZoomCount]


def is_pyramid(path: Path) -> bool:
    """Return whether a path means a pyramid: a file by its first bytes or its name, a folder by its description."""
    if path.is_dir():
        return (path / LISTED).is_file()
    try:
        with path.open("rb") as file:
            return path.suffix.lower() == ARCHIVE or file.read(len(MAGIC)) == MAGIC
    except OSError:
        return False


def facts_of(path: Path) -> dict[str, Any]:
    """Facts about a pyramid, ready for JSON; unknown ones are None.

    Raises
    ------
    FormatError
        If it is damaged, or not a pyramid by vexture.
    DeviceError
        If it cannot be read.
    """
    try:
        about, bounds, found = _of_folder(path) if path.is_dir() else _of_archive(path)
    except OSError as error:
        raise DeviceError(f"{error.filename or path}: cannot be read ({error.strerror}); check its rights") from None
    own = about["vexture"]
    facts: dict[str, Any] = {
        "kind": "tiles",
        "name": about.get("name"),
        "attribution": about.get("attribution") or None,
    }
    facts |= {"zooms": own["zooms"], "sharp": own.get("sharp"), "bounds": bounds}
    facts |= {"tiles": found.tiles, "contents": found.contents, "bytes": found.bytes}
    facts["levels"] = [
        {"zoom": zoom, "tiles": level.tiles, "contents": len(level.sizes), "bytes": sum(level.sizes.values())}
        for zoom, level in sorted(found.levels.items())
    ]
    facts["largest"] = {"tile": found.largest, "bytes": found.largest_bytes} if found.tiles else None
    table = own.get("table")
    facts["table"] = table
    facts["features"], facts["columns"] = _table_facts(table and (path if path.is_dir() else path.parent) / table)
    facts["legends"] = own.get("legends", [])
    return facts


def _check_metadata(path: Path, about: Any) -> dict[str, Any]:
    """Return metadata if they are those of a pyramid by vexture; raise a `FormatError` otherwise."""
    known: dict[str, Any] = about if isinstance(about, dict) else {}
    own = known["vexture"] if isinstance(known.get("vexture"), dict) else {}
    zooms = own.get("zooms")
    if not isinstance(zooms, list) or not zooms or not all(isinstance(zoom, int) for zoom in zooms):
        raise FormatError(f"{path}: its metadata have no pyramid of vexture; {REMEDY}")
    table = own.get("table")
    if table is not None and (not isinstance(table, str) or Path(table).name != table):
        raise FormatError(f"{path}: its table is {table!r:.80}; it must be the name of a file beside it; {REMEDY}")
    legends = own.get("legends", [])
    if not isinstance(legends, list) or not all(map(_is_legend, legends)):
        raise FormatError(f"{path}: its legends are not those of vexture; {REMEDY}")
    return known


def _is_legend(legend: Any) -> bool:
    """Return whether a legend has every member that is printed."""
    texts = isinstance(legend, dict) and all(isinstance(legend.get(key), str) for key in ("layer", "column", "scale"))
    return texts and isinstance(legend.get("entries"), list)


def _is_box(bounds: Any) -> bool:
    """Return whether bounds are four numbers."""
    return isinstance(bounds, list) and len(bounds) == 4 and all(isinstance(value, int | float) for value in bounds)


def _of_archive(path: Path) -> tuple[dict[str, Any], list[float], TileCount]:
    """Read metadata, bounds and tiles of an archive."""
    from pmtiles.tile import Compression, SpecVersionUnsupported, TileType, deserialize_header

    with path.open("rb") as file:
        size = path.stat().st_size
        if size < HEADER or file.read(len(MAGIC)) != MAGIC:
            raise FormatError(f"{path}: is no archive of tiles (PMTiles); {REMEDY}")
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:

            def read(offset: int, length: int) -> bytes:
                if offset + length > size:
                    raise FormatError(f"{path}: breaks off: it has {size} of {offset + length} bytes; copy it again")
                return content[offset : offset + length]

            try:
                header = deserialize_header(content[:HEADER])
                if header["tile_type"] is not TileType.UNKNOWN:
                    kind = header["tile_type"].name
                    raise FormatError(f"{path}: its tiles are {kind}, not textures; give a pyramid of vexture tiles")
                text = read(header["metadata_offset"], header["metadata_length"])
                text = decompress(text) if header["internal_compression"] is Compression.GZIP else text
                about = _check_metadata(path, json.loads(text))
                found = _count_tiles(header, read, size)
            except SpecVersionUnsupported:
                raise FormatError(f"{path}: is PMTiles {content[7]}; this program reads version 3; {REMEDY}") from None
            except SourceError as error:
                raise FormatError(f"{path}: {error}") from None
            except DAMAGED as error:
                raise FormatError(f"{path}: is damaged ({reason_of(error)}); copy it again, or {REMEDY}") from None
    bounds = (header["min_lon_e7"], header["min_lat_e7"], header["max_lon_e7"], header["max_lat_e7"])
    return about, [value / 1e7 for value in bounds], found


DAMAGED: Final = (ValueError, EOFError, IndexError, OverflowError, gzip.BadGzipFile, zlib.error, RecursionError)
"""Errors from reading damaged bytes."""


def _count_tiles(header: Any, read: Bytes, size: int) -> TileCount:
    """Count the tiles of an archive."""
    from pmtiles.tile import tileid_to_zxy

    count, longest, largest, places = 0, 0, 0, set()
    levels: defaultdict[int, ZoomCount] = defaultdict(ZoomCount)
    for entry in _entries(header, read, header["root_offset"], header["root_length"], 0):
        end = header["tile_data_offset"] + entry.offset + entry.length
        if end > size:
            read(end, 0)  # raises the error of a truncated file
        count += entry.run_length
        places.add(entry.offset)
        for zoom, tiles in _zooms(entry.tile_id, entry.run_length):
            levels[zoom].add(tiles, entry.offset, entry.length)
        if entry.length > longest:
            longest, largest = entry.length, entry.tile_id
    return TileCount(count, len(places), size, "/".join(map(str, tileid_to_zxy(largest))), longest, levels)


def _zooms(tile: int, count: int) -> Iterator[tuple[int, int]]:
    """Count tiles of each zoom in a run; the 4^z numbers of zoom z follow those of lower zooms."""
    while count > 0:
        zoom = (3 * tile + 1).bit_length() - 1 >> 1
        here = min(count, (4 ** (zoom + 1) - 1) // 3 - tile)
        yield zoom, here
        tile, count = tile + here, count - here


def _entries(header: Any, read: Bytes, offset: int, length: int, depth: int) -> Iterator[Any]:
    """Yield the entries of a directory and of the directories below it."""
    from pmtiles.tile import deserialize_directory

    for entry in deserialize_directory(read(offset, length)):
        if entry.run_length:
            yield entry
        elif depth == DEEPEST:
            raise ValueError("its directories are too deep")
        else:
            below = header["leaf_directory_offset"] + entry.offset
            yield from _entries(header, read, below, entry.length, depth + 1)


def _of_folder(path: Path) -> tuple[dict[str, Any], Any, TileCount]:
    """Read metadata, bounds and tiles of a folder."""
    listed = path / LISTED
    try:
        about = _check_metadata(listed, json.loads(listed.read_bytes()))
    except (ValueError, RecursionError) as error:
        raise FormatError(f"{listed}: is no TileJSON ({reason_of(error)}); {REMEDY}") from None
    files = sorted(path.glob(f"[0-9]*/[0-9]*/[0-9]*{PACKED_SUFFIX}"))
    sizes: dict[bytes, int] = {}
    known: dict[tuple[int, int], bytes] = {}
    levels: defaultdict[int, ZoomCount] = defaultdict(ZoomCount)
    longest, largest = 0, ""
    for file in files:
        told = file.stat()
        place = (told.st_dev, told.st_ino)  # equal tiles are hard links to one file where the disk allows it
        if place not in known:
            known[place] = hashlib.sha256(file.read_bytes()).digest()
        sizes[known[place]] = told.st_size
        levels[int(file.parts[-3])].add(1, known[place], told.st_size)
        if told.st_size > longest:
            longest, largest = told.st_size, file.relative_to(path).with_suffix("").as_posix()
    bounds = about.get("bounds")
    box = bounds if _is_box(bounds) else None
    return about, box, TileCount(len(files), len(sizes), sum(sizes.values()), largest, longest, levels)


def _table_facts(table: Path | None) -> tuple[int | None, list[str] | None]:
    """Number of features and names of their attributes in a table; None if it is missing or not readable."""
    if table is None or not table.is_file():
        return None, None
    import pyarrow as pa

    try:
        if table.suffix == ".parquet":
            import pyarrow.parquet as pq

            told = pq.ParquetFile(table)
            return told.metadata.num_rows, list(told.schema_arrow.names)
        with pa.memory_map(str(table)) as content, pa.ipc.open_file(content) as reader:
            batches = (reader.get_batch(number) for number in range(reader.num_record_batches))
            return sum(batch.num_rows for batch in batches), list(reader.schema.names)
    except (pa.ArrowException, OSError):
        return None, None


def lines_of(facts: dict[str, Any]) -> Iterator[str]:
    """Describe a pyramid for people, one fact per line, without missing values."""
    sharp = facts["sharp"]
    zooms = ", ".join(map(str, facts["zooms"])) + (f"; exact up to views of {sharp}" if sharp is not None else "")
    bounds = facts["bounds"] and "west {:.6g}, south {:.6g}, east {:.6g}, north {:.6g}".format(*facts["bounds"])
    largest = facts["largest"] and "{tile}, {bytes} bytes".format(**facts["largest"])
    columns = facts["columns"] and ", ".join(facts["columns"])
    told = {"name": facts["name"], "attribution": facts["attribution"], "zooms": zooms, "bounds": bounds}
    told |= {"tiles": f"{facts['tiles']}, {facts['contents']} of them different", "size": f"{facts['bytes']} bytes"}
    for level in facts["levels"]:
        told[f"zoom {level['zoom']}"] = f"{format_count(level['tiles'], 'tile')}, {level['bytes']} bytes"
    told |= {"largest": largest, "table": facts["table"], "features": facts["features"], "columns": columns}
    yield from (f"{name:<12}{value}" for name, value in told.items() if value is not None)
    for legend in facts["legends"]:
        of = f"{legend['layer']}, " if len(facts["legends"]) > 1 else ""
        entries = len(legend["entries"])
        yield f"{'legend':<12}{of}{legend['column']}: {legend['scale']}, {format_count(entries, 'colour')}"
