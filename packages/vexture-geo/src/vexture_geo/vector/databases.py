"""Detect parts of a GeoPackage or SpatiaLite that lead elsewhere: tables in other files, systems that name files."""

import os
import re
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Final

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError, printable, reason_of, shorten_text
from vexture_geo.base.file_references import refuse_files_of_system

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

SHOWN: Final = 100
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
    return printable(shorten_text(" ".join(text.split()), SHOWN))


def _text(value: object) -> str:
    return value.decode(errors="replace") if isinstance(value, bytes) else "" if value is None else str(value)
