"""Pass files of features to GDAL: choose by their first bytes the formats that GDAL may try.

GDAL receives only files without links to other files, and in memory, so that it opens, fetches and writes nothing
else. Files too large for that, and the folder of a FileGDB, are opened by an absolute path.
"""

import os
import re
import sqlite3
from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final
from xml.parsers import expat

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
from vexture.base.deadline import check_time
from vexture.base.errors import SourceError, printable, reason_of, shorten_text
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
from vexture_geo.vector.sequences import one_json

GEOPACKAGE: Final = "GPKG"
SPATIALITE: Final = "SQLite"
"""GDAL's names of the two formats."""

APPLICATION: Final = slice(68, 72)
IDENTIFIERS: Final = (b"GPKG", b"GP10", b"GP11")
"""Application identifiers of a GeoPackage, and their position in an SQLite file."""

SYSTEMS: Final = {"gpkg_spatial_ref_sys": GEOPACKAGE, "spatial_ref_sys": SPATIALITE}
CONTENTS: Final = {GEOPACKAGE: "gpkg_contents", SPATIALITE: "geometry_columns"}
"""Tables of reference systems, and tables that list tables of features."""

DEFINITIONS: Final = ("definition", "srtext", "proj4text", "srs_wkt")
"""Prefixes of the names of columns that define a system."""

SPACE: Final = r"(?:\s|/\*.*?\*/|--[^\n]*\n)"
VIRTUAL: Final = re.compile(rf"{SPACE}*create{SPACE}+virtual\b", re.IGNORECASE | re.DOTALL)
"""Start of a statement that makes a virtual table, which a module reads."""

NAME: Final = r"""(?:"(?:[^"]|"")*"|'(?:[^']|'')*'|`[^`]*`|\[[^\]]*\]|\w+)"""
INDEX: Final = re.compile(
    rf"create\s+virtual\s+table\s+(?:if\s+not\s+exists\s+)?{NAME}\s+using\s+"
    r"(?:(?:rtree|rtree_i32|fts[345])\s*\(|Virtual(?:SpatialIndex|Elementary|KNN2?)\s*\(\s*\)\s*$)",
    re.IGNORECASE,
)
"""Such a statement for an index within the file itself, of places or of texts."""

OUTSIDE: Final = re.compile(
    r"\b(?:gdal_get_\w*pixel_value|ogr_\w+|load_extension|blob(?:from|to)file|xb_(?:load|store)xml"
    r"|(?:import|export)\w+|eval)\s*\(",
    re.IGNORECASE,
)
"""Functions of GDAL and SpatiaLite that read files or contact servers."""

STEPS: Final = 1_000_000
"""Steps of SQLite's virtual machine between two checks of the time limit."""

STATEMENT_SHOWN: Final = 100
"""Characters of a link in a message."""

REFUSED: Final = "and no other file is read; remove it, or save the layer that you need in a file of its own"


def refuse_links_of_database(source: str | os.PathLike[str] | bytes) -> str:
    """Return GDAL's name of the format of an SQLite database of features.

    Raises a `SourceError` if it is not one, or names files or addresses, because GDAL visits all of its tables and
    views when it opens it, whichever layer is read.
    """
    try:
        with closing(_open_database(source)) as base:
            known = [tuple(map(_text, row)) for row in base.execute("SELECT type, name, sql FROM sqlite_master")]
            for kind, name, sql in known:
                _refuse_statement(kind, name, sql)
            for kind, name, _ in known:
                if name.lower() in SYSTEMS:
                    if kind != "table":  # a view could run without end
                        raise SourceError(f"its {name} is a {kind} rather than a table; save it again")
                    _refuse_systems(base, name)
            names = {name.lower() for _, name, _ in known}
            found = next((format_ for format_, table in CONTENTS.items() if table in names), None)
    except (sqlite3.Error, OverflowError, UnicodeDecodeError, MemoryError) as error:  # the last for damaged sizes
        check_time()
        raise SourceError(f"its database is damaged ({reason_of(error)}); save it again") from None
    if found is None:
        raise SourceError("an SQLite database, but no GeoPackage or SpatiaLite; save it as GeoPackage")
    return found


def as_geopackage(content: bytes) -> bytes:
    """Add the identifier of a GeoPackage, without which GDAL takes it for another database."""
    if content[APPLICATION] in IDENTIFIERS:
        return content
    return content[: APPLICATION.start] + IDENTIFIERS[1] + content[APPLICATION.stop :]


def _refuse_systems(base: sqlite3.Connection, table: str) -> None:
    rows = base.execute(f'SELECT * FROM "{table}"')
    told = [place for place, about in enumerate(rows.description) if about[0].lower().startswith(DEFINITIONS)]
    for row in rows:
        for place in told:
            refuse_files_of_system(_text(row[place]))


def _open_database(source: str | os.PathLike[str] | bytes) -> sqlite3.Connection:
    """Open a database read-only, without trusting its schema."""
    if isinstance(source, bytes):
        base = sqlite3.connect(":memory:")
        base.deserialize(source)
    else:
        base = sqlite3.connect(f"{Path(source).absolute().as_uri()}?mode=ro&immutable=1", uri=True)
    base.text_factory = bytes  # texts may be in any encoding
    base.set_progress_handler(check_time, STEPS)
    base.execute("PRAGMA trusted_schema = OFF")
    return base


def _refuse_statement(kind: str, name: str, sql: str) -> None:
    if VIRTUAL.match(sql) and not INDEX.match(sql):
        made_of = re.split(r"\busing\b", sql, maxsplit=1, flags=re.IGNORECASE)[-1]
        raise SourceError(f"its table {_format_text(name)!r} is made of {_format_text(made_of)!r}, {REFUSED}")
    found = OUTSIDE.search(sql)
    if found:
        raise SourceError(f"its {kind} {_format_text(name)!r} reads {_format_text(sql[found.start() :])!r}, {REFUSED}")


def _format_text(text: str) -> str:
    return printable(shorten_text(" ".join(text.split()), STATEMENT_SHOWN))


def _text(value: object) -> str:
    return value.decode(errors="replace") if isinstance(value, bytes) else "" if value is None else str(value)


JSON: Final = ("GeoJSON", "TopoJSON")
SHAPEFILES: Final = ("ESRI Shapefile",)
GEODATABASE: Final = ("OpenFileGDB",)
MARKUP: Final[Mapping[str, tuple[str, ...]]] = {"kml": ("LIBKML", "KML"), "gpx": ("GPX",), "gml": ("GML",)}
"""GDAL's names of formats; of two, the first one that this GDAL supports is used."""

PLACED: Final = b"<Placemark"
"""Start of a feature of KML."""

SIZE_OF_HEADER: Final = slice(8, 12)
HEADER_START: Final = 12
FLATGEOBUF_HEADER: Final = 16 * 2**20
"""Position of the size of a FlatGeobuf header, start of the header, and a limit above GDAL's own."""

PIECE: Final = 2**20
"""Bytes parsed between two checks of the time limit."""

NETWORK_LINK: Final = "NetworkLink"
HREF: Final = "http://www.w3.org/1999/xlink href"

SHOWN: Final = 80
"""Characters of a link in a message."""


@dataclass(frozen=True)
class VectorFile:
    """A file for GDAL: its content or path, its possible formats, and counts of its links, which are not read."""

    content: bytes | str
    formats: tuple[str, ...]
    links: Mapping[str, int] = field(default_factory=dict)

    @property
    def is_json(self) -> bool:
        """True if the file is GeoJSON or TopoJSON."""
        return self.formats == JSON

    @property
    def has_fixed_layers(self) -> bool:
        """True if the format always has the same layers, whether empty or not."""
        return self.formats == MARKUP["gpx"]


@contextmanager
def open_vectors(source: str | os.PathLike[str] | bytes) -> Iterator[VectorFile]:
    """Open a file of features within this context; a `SourceError` if it is not one, or names other files."""
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
    """Open a file that is not read as a whole, a shapefile or a file that is too large; None for others."""
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
    """Open a file by its content."""
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
    """Open the files of a zip; formats that GDAL recognises only by name are written to a temporary folder."""
    if kind == FOLDER:
        folder = Path(opened.enter_context(TemporaryDirectory(prefix="vexture-", suffix=FOLDER)))
        for name, part in files.items():
            (folder / name).write_bytes(part)
        return VectorFile(plain_place(folder), GEODATABASE)
    if kind == KML:
        main = next(part for name, part in files.items() if name.lower().endswith(MAIN))
        if PLACED in main or links_of_markup(
            main, beside=files
        ):  # GDAL reads its places, or the parts to which it links
            return VectorFile(main, MARKUP["kml"], links_of_markup(main))
        links = sum((Counter(links_of_markup(part, beside=files)) for part in files.values()), Counter())
        place = Path(opened.enter_context(TemporaryDirectory(prefix="vexture-")), "a.kmz")
        place.write_bytes(content)
        return VectorFile(plain_place(place), MARKUP["kml"], links)
    return VectorFile(content, SHAPEFILES)


def _refuse_links_of_flatgeobuf(source: Path | bytes) -> None:
    """Raise a `SourceError` if the reference system in a FlatGeobuf header names a file or an address."""
    if isinstance(source, bytes):
        start = source[:FLATGEOBUF_HEADER]
    else:
        with source.open("rb") as file:
            start = file.read(FLATGEOBUF_HEADER)
    header = start[: HEADER_START + int.from_bytes(start[SIZE_OF_HEADER], "little")]
    refuse_files_of_system(header.decode("latin-1"))


def links_of_markup(content: bytes, beside: Collection[str] = ()) -> Mapping[str, int]:
    """Count links in XML that are not read, as texts of notes; raise a `SourceError` for damage or a DTD.

    GDAL silently stops at damage and keeps what precedes it. A KML link to a file `beside` it is read.

    Examples
    --------
    >>> dict(links_of_markup(b"<kml><NetworkLink><Link><href>http://a/b.kml</href></Link></NetworkLink></kml>"))
    {'the file of a NetworkLink is not read': 1}
    >>> links_of_markup(b"<!DOCTYPE gpx SYSTEM 'a.dtd'><gpx/>")
    Traceback (most recent call last):
    vexture.base.errors.SourceError: its DTD, 'a.dtd', is not read; save it without a DOCTYPE
    """
    found: Counter[str] = Counter()
    link: list[str] = []
    path: list[str] = []

    def refuse_dtd(name: str, system: str | None, public: str | None, has_subset: bool) -> None:
        shown = printable(shorten_text(" ".join((system or public or name).split()), SHOWN))
        raise SourceError(f"its DTD, {shown!r}, is not read; save it without a DOCTYPE")

    def start(name: str, attributes: dict[str, str]) -> None:
        path.append(name.rpartition(" ")[2])
        if path[-1] == NETWORK_LINK:
            link.clear()
        if HREF in attributes:
            found["what an xlink:href names is not read"] += 1

    def text(part: str) -> None:
        if path and path[-1] == "href" and NETWORK_LINK in path:
            link.append(part)

    def end(name: str) -> None:
        if path.pop() == NETWORK_LINK and "".join(link).strip() not in beside:
            found["the file of a NetworkLink is not read"] += 1

    parser = expat.ParserCreate(namespace_separator=" ")
    parser.StartDoctypeDeclHandler = refuse_dtd
    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = start, end, text
    try:
        for first in range(0, len(content), PIECE):
            check_time()
            parser.Parse(content[first : first + PIECE])
        parser.Parse(b"", True)
    except (expat.ExpatError, LookupError, ValueError) as error:  # the last two for unknown encodings
        raise SourceError(f"the XML is damaged ({shorten_text(str(error), SHOWN)}); save it again") from None
    return found
