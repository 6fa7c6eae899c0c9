"""Write pyramids as one PMTiles file (version 3), or as a folder with a TileJSON."""

import gzip
import hashlib
import json
import os
import shutil
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, Final

from vexture.base.errors import DeviceError, LimitError
from vexture.base.layout import PACKED_SUFFIX
from vexture.texture.files import TEMPORARY, make_folder
from vexture_geo.base.extent import Bounds
from vexture_geo.vector.tables import TABLES

if TYPE_CHECKING:
    from vexture_geo.tiles.store import Content

ARCHIVE: Final = ".pmtiles"
"""Suffix of an archive."""

LISTED: Final = "tiles.json"
"""Name of the TileJSON in a folder."""

MOST_FILES: Final = 200_000
"""Most tiles in a folder, because more would fill the directories of a disk."""

ROOT_BYTES: Final = 16384 - 127
"""Most bytes of the root directory: with the header it lies in the first 16 KiB of an archive."""

Extra = Mapping[Path, Callable[[BinaryIO], None]]
"""Functions that write the files beside a pyramid, by path."""

Runs = Sequence[tuple[int, int, str]]


def check_target(output: Path) -> None:
    """Raise a `DeviceError` if a pyramid cannot be written to a path."""
    if output.suffix.lower() == ARCHIVE:
        if output.is_dir():
            raise DeviceError(f"{output}: is a folder; name a file")
        return
    if output.exists() and (not output.is_dir() or (any(output.iterdir()) and not (output / LISTED).is_file())):
        raise DeviceError(f"{output}: holds something else than tiles; name an archive ({ARCHIVE}) or a new folder")


def table_of(output: Path, kind: str) -> Path | None:
    """Path of a pyramid's table of attributes: beside an archive, or in the folder; None if it has none."""
    if kind == TABLES[-1]:
        return None
    return output.with_suffix(f".{kind}") if output.suffix.lower() == ARCHIVE else output / f"table.{kind}"


def write_archive(
    output: Path,
    runs: Runs,
    contents: "Mapping[str, Content]",
    zooms: Sequence[int],
    bounds: Bounds,
    about: Any,
    extra: Extra,
) -> int:
    """Write an archive and the files beside it, each whole or not at all, and return its size; `bounds` in degrees."""
    from pmtiles.tile import Compression, Entry, TileType, serialize_header
    from pmtiles.writer import optimize_directories

    places: dict[str, int] = {}
    length, entries = 0, []
    for first, count, digest in runs:
        if digest not in places:
            places[digest] = length
            length += contents[digest].length
        entries.append(Entry(first, places[digest], contents[digest].length, count))
    root, leaves, _ = optimize_directories(entries, ROOT_BYTES)  # type: ignore[no-untyped-call]
    metadata = gzip.compress(json.dumps(about, separators=(",", ":")).encode(), mtime=0)
    west, south, east, north = (round(value * 1e7) for value in bounds)
    at = 127
    header: Any = {"root_offset": at, "root_length": len(root)}
    header |= {"metadata_offset": at + len(root), "metadata_length": len(metadata)}
    header |= {"leaf_directory_offset": at + len(root) + len(metadata), "leaf_directory_length": len(leaves)}
    header |= {"tile_data_offset": at + len(root) + len(metadata) + len(leaves), "tile_data_length": length}
    header |= {"addressed_tiles_count": sum(count for _, count, _ in runs), "tile_entries_count": len(entries)}
    header |= {"tile_contents_count": len(places), "clustered": True, "internal_compression": Compression.GZIP}
    header |= {"tile_compression": Compression.NONE, "tile_type": TileType.UNKNOWN}
    header |= {"min_zoom": zooms[0], "max_zoom": zooms[-1], "center_zoom": zooms[0]}
    header |= {"min_lon_e7": west, "min_lat_e7": south, "max_lon_e7": east, "max_lat_e7": north}
    make_folder(output.parent, durable=False)

    def tiles(file: BinaryIO) -> None:
        file.write(serialize_header(header) + root + metadata + leaves)
        for digest in places:
            file.write(contents[digest].read())

    for path, write in {**extra, output: tiles}.items():
        _write_whole(path, write)
    return output.stat().st_size


def _write_whole(path: Path, write: Callable[[BinaryIO], None]) -> None:
    """Write a file completely or not at all."""
    partial = path.with_name(f".{path.name}{TEMPORARY}")
    try:
        with partial.open("wb") as file:
            write(file)
            file.flush()
            os.fsync(file.fileno())
        partial.replace(path)
    except BaseException:
        partial.unlink(missing_ok=True)
        raise


def write_folder(
    output: Path,
    runs: Runs,
    contents: "Mapping[str, Content]",
    zooms: Sequence[int],
    bounds: Bounds,
    about: Any,
    extra: Extra,
) -> int:
    """Write a folder with one file per tile, completely or not at all, and return the size of its distinct tiles."""
    count = sum(count for _, count, _ in runs)
    if count > MOST_FILES:
        raise LimitError(f"{output}: {count} tiles are too many files; the limit is {MOST_FILES}; write one {ARCHIVE}")
    partial = output.with_name(f".{output.name}{TEMPORARY}")
    shutil.rmtree(partial, ignore_errors=True)
    try:
        size = _fill(partial, runs, contents)
        version = hashlib.sha256(json.dumps(runs).encode()).hexdigest()[:16]
        tiles = [f"{{z}}/{{x}}/{{y}}{PACKED_SUFFIX}?v={version}"]
        listed: dict[str, Any] = {"tilejson": "3.0.0", "tiles": tiles, "vector_layers": []}
        listed |= {"minzoom": zooms[0], "maxzoom": zooms[-1], "bounds": list(bounds), **about}
        for path, write in extra.items():
            with (partial / path.name).open("wb") as file:
                write(file)
        (partial / LISTED).write_text(json.dumps(listed, indent=1) + "\n")
    except BaseException:
        shutil.rmtree(partial, ignore_errors=True)  # it may have filled the disk
        raise
    old = output.with_name(f".{output.name}.old{TEMPORARY}")
    shutil.rmtree(old, ignore_errors=True)
    if output.exists():
        output.rename(old)
    partial.rename(output)
    shutil.rmtree(old, ignore_errors=True)
    return size


def _fill(partial: Path, runs: Runs, contents: "Mapping[str, Content]") -> int:
    """Write the tiles of a folder, and return the size of its distinct tiles."""
    from pmtiles.tile import tileid_to_zxy

    first_of: dict[str, Path] = {}
    size = 0
    for first, count, digest in runs:
        for number in range(first, first + count):
            z, x, y = tileid_to_zxy(number)
            path = partial / str(z) / str(x) / f"{y}{PACKED_SUFFIX}"
            path.parent.mkdir(parents=True, exist_ok=True)
            if digest in first_of:
                _link_file(first_of[digest], path)
                continue
            path.write_bytes(contents[digest].read())
            first_of[digest] = path
            size += contents[digest].length
    return size


def _link_file(path: Path, other: Path) -> None:
    """Link a file to another path, or copy it where the disk has no hard links."""
    with suppress(OSError):
        os.link(path, other)
        return
    shutil.copyfile(path, other)
