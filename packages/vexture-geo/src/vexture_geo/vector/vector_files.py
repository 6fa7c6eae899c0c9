"""Files of features as GDAL is given them: by their first bytes, with the formats that GDAL may take them for.

GDAL gets a file only if nothing in it leads to another, and in memory, so that it opens, fetches and writes nothing
else. What is too large for that, and the folder of a FileGDB, it opens by an absolute path.
"""

import os
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from vexture.base.content import (
    BYTE_ORDER_MARK,
    FLATGEOBUF,
    LARGEST_FILE,
    RECORD,
    SHAPEFILE,
    SQLITE,
    VECTOR_FILES,
    ZIP,
    is_geodatabase,
    markup_of,
    read_bytes,
    start_of,
)
from vexture.base.errors import SourceError
from vexture_geo.base.damage import HEADER, refuse_cut
from vexture_geo.base.file_references import refuse_files_of_json, refuse_files_of_system
from vexture_geo.base.gdal import plain_place
from vexture_geo.vector.archives import (
    FOLDER,
    KML,
    MAIN,
    pack_shapefile,
    packed_files,
    refuse_links_of_folder,
    unzip,
)
from vexture_geo.vector.databases import as_geopackage, refuse_links_of_database
from vexture_geo.vector.markup import links_of_markup
from vexture_geo.vector.sequences import one_json

JSON: Final = ("GeoJSON", "TopoJSON")
SHAPEFILES: Final = ("ESRI Shapefile",)
GEODATABASE: Final = ("OpenFileGDB",)
MARKUP: Final[Mapping[str, tuple[str, ...]]] = {"kml": ("LIBKML", "KML"), "gpx": ("GPX",), "gml": ("GML",)}
"""GDAL's names of formats; of two, the first that this GDAL has."""

PLACED: Final = b"<Placemark"
"""Start of a feature of KML."""

SIZE_OF_HEADER: Final = slice(8, 12)
HEADER_START: Final = 12
FLATGEOBUF_HEADER: Final = 16 * 2**20
"""Where a FlatGeobuf says the size of its header, where that starts, and more bytes than GDAL takes."""


@dataclass(frozen=True)
class VectorFile:
    """A file for GDAL: in memory, or its place; the formats that it may be, and its links that are not read."""

    content: bytes | str
    formats: tuple[str, ...]
    links: Mapping[str, int] = field(default_factory=dict)

    @property
    def is_json(self) -> bool:
        """Whether it is GeoJSON or TopoJSON."""
        return self.formats == JSON

    @property
    def has_fixed_layers(self) -> bool:
        """Whether there are always the same layers, whatever is in them."""
        return self.formats == MARKUP["gpx"]


@contextmanager
def open_vectors(source: str | os.PathLike[str] | bytes) -> Iterator[VectorFile]:
    """A file of features, within this context; a `SourceError` if it is none, or names other files."""
    if is_geodatabase(source):
        place = plain_place(source)
        if not place.lower().endswith(".gdb"):
            raise SourceError("is the folder of a FileGDB, but its name does not end in .gdb; rename it")
        refuse_links_of_folder(Path(place))
        yield VectorFile(place, GEODATABASE)
        return
    placed = None if isinstance(source, bytes) else _on_disk(Path(source))
    if placed is not None:
        yield placed
        return
    with ExitStack() as opened:
        yield _in_memory(read_bytes(unzip(source)), opened)


def _on_disk(path: Path) -> VectorFile | None:
    """A file that is not read as a whole: a shapefile, or a file that is too large; None of any other."""
    start = start_of(path)
    if not path.is_file():
        return None
    size = path.stat().st_size
    if start.startswith(SHAPEFILE):
        if size <= LARGEST_FILE:
            return VectorFile(pack_shapefile(path), SHAPEFILES)
        with path.open("rb") as file:
            refuse_cut(path.name, file.read(HEADER), size)
        for beside in path.parent.iterdir():
            if beside.name.lower() == f"{path.stem.lower()}.prj":
                refuse_files_of_system(read_bytes(beside).decode(errors="replace"))
        return VectorFile(plain_place(path), SHAPEFILES)
    if size <= LARGEST_FILE:
        return None
    if start.startswith(SQLITE):
        return VectorFile(plain_place(path), (refuse_links_of_database(path),))
    if start.startswith(FLATGEOBUF):
        _refuse_links_of_flatgeobuf(path)
        return VectorFile(plain_place(path), ("FlatGeobuf",))
    raise SourceError(
        f"the file is larger than {LARGEST_FILE:,} bytes, the most that is read at once; convert it to FlatGeobuf, "
        "GeoPackage or GeoParquet, which are read in parts"
    )


def _in_memory(content: bytes, opened: ExitStack) -> VectorFile:
    """A file by its content."""
    if content.startswith(SHAPEFILE):
        raise SourceError("a shapefile is several files; give them together as a .zip")
    if content.startswith(ZIP):
        kind, files = packed_files(content)
        return _from_zip(content, kind, files, opened)
    if content.startswith(SQLITE):
        kind = refuse_links_of_database(content)
        return VectorFile(as_geopackage(content) if kind == "GPKG" else content, (kind,))
    if content.startswith(FLATGEOBUF):
        _refuse_links_of_flatgeobuf(content)
        return VectorFile(content, ("FlatGeobuf",))
    if content.lstrip(BYTE_ORDER_MARK + b" \t\r\n")[:1] in (b"{", RECORD):
        refuse_files_of_json(content)
        return VectorFile(one_json(content), JSON)
    kind = markup_of(start_of(content))
    if kind:
        return VectorFile(content, MARKUP[kind], links_of_markup(content))
    raise SourceError(f"none of GeoJSON, {VECTOR_FILES} or TopoJSON; convert it to one of them")


def _from_zip(content: bytes, kind: str, files: dict[str, bytes], opened: ExitStack) -> VectorFile:
    """Give GDAL the files of a zip; those that it knows only by a name get a place of their own."""
    if kind == FOLDER:
        folder = Path(opened.enter_context(TemporaryDirectory(prefix="vexture-", suffix=FOLDER)))
        for name, part in files.items():
            (folder / name).write_bytes(part)
        return VectorFile(plain_place(folder), GEODATABASE)
    if kind == KML:
        main = next(part for name, part in files.items() if name.lower().endswith(MAIN))
        if PLACED in main or links_of_markup(
            main, beside=files
        ):  # GDAL reads its places, or the parts that it links to
            return VectorFile(main, MARKUP["kml"], links_of_markup(main))
        links = sum((Counter(links_of_markup(part, beside=files)) for part in files.values()), Counter())
        place = Path(opened.enter_context(TemporaryDirectory(prefix="vexture-")), "a.kmz")
        place.write_bytes(content)
        return VectorFile(plain_place(place), MARKUP["kml"], links)
    return VectorFile(content, SHAPEFILES)


def _refuse_links_of_flatgeobuf(source: Path | bytes) -> None:
    """Raise a `SourceError` if the reference system in the header of a FlatGeobuf names a file or an address."""
    if isinstance(source, bytes):
        start = source[:FLATGEOBUF_HEADER]
    else:
        with source.open("rb") as file:
            start = file.read(FLATGEOBUF_HEADER)
    header = start[: HEADER_START + int.from_bytes(start[SIZE_OF_HEADER], "little")]
    refuse_files_of_system(header.decode("latin-1"))
