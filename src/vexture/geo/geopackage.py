"""What of a GeoPackage could lead out of it: tables that are files elsewhere, and systems that name files."""

import os
import re
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Final

from vexture.content import start_of
from vexture.deadline import check_time
from vexture.errors import SourceError, printable, reason_of, shortened
from vexture.geo.named import refuse_files_of_system

__all__ = ["refuse_links_of_geopackage"]

APPLICATION: Final = slice(68, 72)
GEOPACKAGES: Final = (b"GPKG", b"GP10", b"GP11")
"""Application identifiers of a GeoPackage, at these bytes of an SQLite file."""

SYSTEMS: Final = "gpkg_spatial_ref_sys"
DEFINITION: Final = "definition"
"""Table of reference systems, and what the names of the columns begin with that define them."""

SPACE: Final = r"(?:\s|/\*.*?\*/|--[^\n]*\n)"
VIRTUAL: Final = re.compile(rf"{SPACE}*create{SPACE}+virtual\b", re.IGNORECASE | re.DOTALL)
"""Start of a statement that makes a table of what a module reads."""

NAME: Final = r"""(?:"(?:[^"]|"")*"|'(?:[^']|'')*'|`[^`]*`|\[[^\]]*\]|\w+)"""
INDEX: Final = re.compile(
    rf"create\s+virtual\s+table\s+(?:if\s+not\s+exists\s+)?{NAME}\s+using\s+(?:rtree|rtree_i32|fts[345])\s*\(",
    re.IGNORECASE,
)
"""Such a statement, of an index that is in the file itself: of places or of texts."""

OUTSIDE: Final = re.compile(r"\b(?:gdal_get_\w*pixel_value|ogr_\w+|load_extension)\s*\(", re.IGNORECASE)
"""Functions of GDAL that read files or ask servers."""

STEPS: Final = 1_000_000
"""Of the database's machine between two looks at the clock."""

SHOWN: Final = 100
"""Characters of a link in a message."""

REFUSED: Final = "and no other file is read; remove it, or save the layer that you need in a file of its own"


def refuse_links_of_geopackage(source: str | os.PathLike[str] | bytes) -> None:
    """Raise a `SourceError` if an SQLite database is no GeoPackage, or names files or addresses.

    GDAL would look at all of its tables and views when it opens it, whichever layer is wanted.
    """
    if start_of(source)[APPLICATION] not in GEOPACKAGES:
        raise SourceError("an SQLite database, but no GeoPackage; save it as GeoPackage")
    try:
        with closing(_opened(source)) as base:
            known = [map(_text, row) for row in base.execute("SELECT type, name, sql FROM sqlite_master")]
            for kind, name, sql in known:
                _refuse_statement(kind, name, sql)
                if name.lower() == SYSTEMS and kind != "table":  # which could take for ever
                    raise SourceError(f"its {SYSTEMS} is a {kind} rather than a table; save it again")
            rows = base.execute(f"SELECT * FROM {SYSTEMS}")
            told = [place for place, about in enumerate(rows.description) if about[0].lower().startswith(DEFINITION)]
            for row in rows:
                for place in told:
                    refuse_files_of_system(_text(row[place]))
    except (sqlite3.Error, OverflowError, UnicodeDecodeError, MemoryError) as error:  # of sizes that are damaged
        check_time()
        raise SourceError(f"its database is damaged ({reason_of(error)}); save it again") from None


def _opened(source: str | os.PathLike[str] | bytes) -> sqlite3.Connection:
    """A database of which nothing is believed, nor changed."""
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
        raise SourceError(f"its table {_shown(name)!r} is made of {_shown(made_of)!r}, {REFUSED}")
    found = OUTSIDE.search(sql)
    if found:
        raise SourceError(f"its {kind} {_shown(name)!r} reads {_shown(sql[found.start() :])!r}, {REFUSED}")


def _shown(text: str) -> str:
    return printable(shortened(" ".join(text.split()), SHOWN))


def _text(value: object) -> str:
    return value.decode(errors="replace") if isinstance(value, bytes) else "" if value is None else str(value)
