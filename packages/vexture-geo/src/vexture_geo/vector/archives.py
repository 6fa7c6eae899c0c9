"""Zips of geographic data: one or more shapefiles, a FileGDB, or one file of another format. Others are not unpacked.

Paths in a zip are never used: files are read in memory, or written to a new folder by the last part of their path.
"""

import os
import re
import zipfile
import zlib
from collections.abc import Iterable
from io import BytesIO
from pathlib import Path, PurePosixPath
from typing import Final

from vexture.base.content import LARGEST_FILE, SHAPEFILE, ZIP, is_geodatabase, is_stream, read_bytes, start_of
from vexture.base.errors import LimitError, SourceError, printable, reason_of
from vexture_geo.base.damage import refuse_cut
from vexture_geo.base.file_references import refuse_files_of_system

PARTS: Final = (".shp", ".shx", ".dbf", ".prj", ".cpg")
"""Files of one shapefile, of which the first two are required."""

FOLDER: Final = ".gdb"
NAME: Final = re.compile(r"\w[\w.-]*")
"""Suffix of the folder of a FileGDB, and pattern of the names of its files."""

SINGLE: Final = (
    *(".geojson", ".geojsons", ".geojsonl", ".ndjson", ".json", ".topojson", ".kml", ".gpx", ".gml", ".csv", ".tsv"),
    *(".gpkg", ".sqlite", ".fgb", ".parquet", ".feather", ".arrow"),
)
"""Suffixes of formats that consist of one file."""

DEPTHS: Final = (".tif", ".tiff", ".nc", ".nc4", ".asc", ".flt", ".grib", ".grib2", ".grb", ".grb2")
"""Suffixes of rasters and meshes of depths."""

KML: Final = ".kml"
MAIN: Final = "doc.kml"
"""Suffix of KML, and name of the main file of a KMZ."""

MOST_NAMED: Final = 6
"""Most files that a message names."""

REMEDY: Final = "zip the .shp, .shx, .dbf and .prj together"


def unzip(source: str | os.PathLike[str] | bytes) -> str | os.PathLike[str] | bytes:
    """Return the source, or the content of a zip: shapefiles or a FileGDB in a new zip, or one file.

    Raises a `SourceError` if it contains none of these or is damaged, and a `LimitError` if it contains several.
    """
    if not start_of(source).startswith(ZIP):
        return source
    try:
        with zipfile.ZipFile(BytesIO(read_bytes(source))) as archive:
            named = [info for info in archive.infolist() if info.filename]  # an empty name is no path
            infos = [info for info in named if not info.is_dir() and _is_own(info.filename)]
            return _read_contents(archive, infos)
    except (zipfile.BadZipFile, zlib.error, RuntimeError, NotImplementedError, EOFError, OSError, ValueError) as error:
        raise SourceError(f"the zip is damaged or encrypted ({reason_of(error)}); zip its files again") from None


def _read_contents(archive: zipfile.ZipFile, infos: list[zipfile.ZipInfo]) -> bytes:
    """Read the content of a zip, by the names of its files."""
    shapes = [info for info in infos if _suffix(info.filename) in PARTS]
    if any(_suffix(info.filename) == PARTS[0] for info in shapes):
        return _shapefiles({PurePosixPath(info.filename).name: read for info, read in _read(archive, shapes)})
    folders = {place for info in infos if (place := PurePosixPath(info.filename).parent).suffix.lower() == FOLDER}
    if folders:
        (folder,) = _only(folders, "FileGDBs")
        inner = [info for info in infos if PurePosixPath(info.filename).parent == folder]
        return _geodatabase({PurePosixPath(info.filename).name: read for info, read in _read(archive, inner)})
    singles = [info for info in infos if _suffix(info.filename) in SINGLE]
    main = [info for info in singles if PurePosixPath(info.filename).name.lower() == MAIN]
    texts = [info for info in singles if _suffix(info.filename) == KML]
    if main and len(texts) > 1:  # a KMZ may have parts, to which its main file links
        return _pack_files({info.filename: read for info, read in _read(archive, texts)})
    depths = [info.filename for info in infos if _suffix(info.filename) in DEPTHS]
    if depths and not singles:
        raise SourceError(f"{_format_name(depths[0])} is not read in a zip; unzip it, and give the file itself")
    if not singles:
        raise SourceError(f"the zip holds no shapefile (.shp), FileGDB (.gdb) or other geographic data; {REMEDY}")
    chosen = main[:1] or singles
    _only({PurePosixPath(info.filename) for info in chosen}, "files")
    ((_, content),) = _read(archive, chosen[:1])
    if content.startswith(ZIP):
        raise SourceError(f"{_format_name(chosen[0].filename)} in the zip is a zip itself; unpack it")
    return content


def _is_own(name: str) -> bool:
    """Return whether a file of a zip is data, and not added by an operating system."""
    place = PurePosixPath(name)
    return not place.name.startswith(".") and "__MACOSX" not in place.parts


def _suffix(name: str) -> str:
    return PurePosixPath(name).suffix.lower()


def _only(places: Iterable[PurePosixPath], kind: str) -> list[PurePosixPath]:
    found = sorted(places)
    if len(found) > 1:
        shown = ", ".join(_format_name(str(place)) for place in found[:MOST_NAMED])
        more = ", ..." if len(found) > MOST_NAMED else ""
        raise LimitError(f"the zip holds {len(found)} {kind} that can be read: {shown}{more}; zip one of them")
    return found


def _format_name(name: str) -> str:
    return printable(name)


def _read(archive: zipfile.ZipFile, infos: list[zipfile.ZipInfo]) -> list[tuple[zipfile.ZipInfo, bytes]]:
    """Read files of a zip, at most as many bytes of each as its entry states."""
    if sum(info.file_size for info in infos) > LARGEST_FILE:
        raise SourceError(f"what the zip holds is larger than {LARGEST_FILE:,} bytes; split it")
    return [(info, archive.read(info)) for info in infos]


def pack_shapefile(path: Path) -> bytes:
    """Pack a ``.shp`` and the files beside it into one zip; equal files give equal bytes."""
    try:
        beside = {each.name.lower(): each for each in path.parent.iterdir()}
    except OSError as error:
        raise SourceError(f"its folder cannot be read: {error.strerror}; the files beside it are needed") from None
    found = {part: beside.get(path.stem.lower() + part) for part in PARTS} | {".shp": path}
    return _shapefiles({f"{path.stem}{part}": read_bytes(each) for part, each in found.items() if each is not None})


def pack_parts(path: Path) -> bytes | None:
    """Pack the files of a shapefile or FileGDB into one zip; None for other files."""
    if is_stream(path):
        return None
    if is_geodatabase(path):
        return pack_geodatabase(path)
    return pack_shapefile(path) if start_of(path).startswith(SHAPEFILE) else None


def pack_geodatabase(path: Path) -> bytes:
    """Pack the folder of a FileGDB into one zip; equal files give equal bytes."""
    refuse_links_of_folder(path)
    files = {}
    for each in sorted(path.iterdir()):
        if each.is_file():
            files[each.name] = read_bytes(each)
            if sum(map(len, files.values())) > LARGEST_FILE:
                raise SourceError(f"its files are larger than {LARGEST_FILE:,} bytes; split it")
    return _geodatabase(files)


def refuse_links_of_folder(path: Path) -> None:
    """Raise a `SourceError` if a file in the folder of a FileGDB is a symbolic link to another place."""
    place = os.path.realpath(path)
    for each in sorted(path.iterdir()):
        if each.is_symlink() and os.path.dirname(os.path.realpath(each)) != place:
            raise SourceError(
                f"its {printable(each.name)} is a link to another place, and no other file is read; copy the whole "
                "folder, with what links lead to (cp -rL)"
            )


def packed_files(content: bytes) -> tuple[str, dict[str, bytes]]:
    """Return the kind of a zip of `pack_parts` or `unzip`, a suffix (``.shp``, ``.gdb`` or ``.kml``), and its files."""
    with zipfile.ZipFile(BytesIO(content)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    if all(_suffix(name) == KML for name in files):
        return KML, files
    inner = {PurePosixPath(name).name: read for name, read in files.items() if name.startswith(f"a{FOLDER}/")}
    return (FOLDER, inner) if inner else (PARTS[0], files)


def _geodatabase(files: dict[str, bytes]) -> bytes:
    """Pack the files of a FileGDB into one zip."""
    return _pack_files({f"a{FOLDER}/{name}": content for name, content in files.items() if NAME.fullmatch(name)})


def _shapefiles(files: dict[str, bytes]) -> bytes:
    """Pack the files of shapefiles into one zip."""
    named = {Path(name).stem + Path(name).suffix.lower(): content for name, content in files.items()}
    for stem in [Path(name).stem for name in named if name.endswith(PARTS[0])]:
        if f"{stem}.shx" not in named:
            raise SourceError(f"the shapefile {stem}.shp lacks its {stem}.shx; keep its files together")
        for name in (f"{stem}.shp", f"{stem}.shx"):
            refuse_cut(name, named[name], len(named[name]))
        refuse_files_of_system(named.get(f"{stem}.prj", b"").decode(errors="replace"))
    return _pack_files(named)


def _pack_files(files: dict[str, bytes]) -> bytes:
    packed = BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name), content)  # without a time, so that equal files give equal bytes
    return packed.getvalue()
