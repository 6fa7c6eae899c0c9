"""Detect files and addresses named in a reference system: grids of shifts, lists of systems, definitions."""

import json
import re
from collections.abc import Iterator
from typing import Any, Final, NoReturn

from vexture.base.errors import SourceError, printable, shorten_text

PLACE: Final = re.compile(r"[/\\~]|^\.")
"""Characters in the name of a file or an address, but not in that of a grid that PROJ includes."""

VALUES: Final = (
    re.compile(r"\b(?:init|file|model|\w*grids)\s*=(.*?)(?=\s\+|\"\s*[\])]|$)", re.IGNORECASE | re.DOTALL),
    re.compile(r"\bPARAMETERFILE\s*[\[(]\s*\"(?:[^\"]|\"\")*\"\s*,\s*\"((?:[^\"]|\"\")*)\"", re.IGNORECASE),
    re.compile(r"\bPROJ4_GRIDS\"\s*,\s*\"((?:[^\"]|\"\")*)\"", re.IGNORECASE),
    re.compile(
        r"^\s*(?!https?://(?:www\.)?opengis\.net/(?:def/crs|gml/srs)\b)((?:https?|ftp|file):.*)", re.I | re.DOTALL
    ),
)
"""Patterns of file names in a PROJ text, in WKT 1 and 2, and as a whole text, except names like addresses."""

KEY: Final = re.compile(
    rb"""["'](?:c|\\u00[46]3)(?:r|\\u00[57]2)(?:s|\\u00[57]3)["']\s*:?\s*(?=[^\s:])""", re.IGNORECASE
)
"""The key `crs` of JSON in any spelling, up to its value."""

SCALAR: Final = re.compile(rb"""["\d.+-]|null|true|false|\[|[,\]}]""")
"""Start of a value that names no system, or of what follows a text that is not a key."""

LINK_TYPES: Final = ("link", "url")
"""Types, in lower case, of a `crs` in GeoJSON that is described elsewhere."""

MOST: Final = 65_536
"""Most bytes of the reference system in a GeoJSON."""

SHOWN: Final = 80
"""Characters of a link in a message."""


def refuse_files_of_system(text: str) -> None:
    """Raise a `SourceError` if a source's reference system names a file or an address.

    Examples
    --------
    >>> refuse_files_of_system("+proj=merc +nadgrids=@null +no_defs")
    >>> refuse_files_of_system('PROJCRS["Amersfoort / RD New"]')
    """
    if text.lstrip().startswith("{"):
        try:
            texts = [*_texts(json.loads(text))]
        except (ValueError, RecursionError):
            return  # not a reference system
    else:
        texts = [found[1] for pattern in VALUES for found in pattern.finditer(text)]
    for named in texts:
        if PLACE.search(named.strip(" \"'@")):
            raise SourceError(
                f"its reference system names {_format_text(named)!r}, and no other file is read; write the file with a "
                "system that has a code, EPSG:..."
            )


def _texts(value: Any) -> Iterator[str]:
    """Collect texts in PROJJSON that may name files: values of parameters, and names of methods."""
    left = [value]
    while left:
        one = left.pop()
        if isinstance(one, list):
            left += one
        elif isinstance(one, dict):
            left += one.values()
            if isinstance(one.get("value"), str):
                yield one["value"]
            if isinstance(one.get("name"), str):
                yield from (found[1] for pattern in VALUES for found in pattern.finditer(one["name"]))


def refuse_files_of_json(content: bytes) -> None:
    """Raise a `SourceError` if a reference system in GeoJSON would be fetched or read from elsewhere.

    The text is searched, wherever GDAL could find a system, because parsing a large file twice costs too much.
    """
    for found in KEY.finditer(content):
        start = found.end()
        if SCALAR.match(content, start):
            continue
        text = content[start : start + MOST].decode(errors="replace")
        try:
            value, _ = json.JSONDecoder(strict=False).raw_decode(text)
        except (ValueError, RecursionError):
            raise SourceError(f"its crs, at byte {start:,}, is no reference system; leave it out") from None
        texts = [*_all_texts(value)]
        if any(text.lower() in LINK_TYPES for text in texts):
            refuse_link(max(texts, key=len))
        for each in texts:
            refuse_files_of_system(each)


def refuse_link(link: str) -> NoReturn:
    """Raise a `SourceError` for GeoJSON whose reference system is described elsewhere."""
    raise SourceError(
        f"its crs is a link to {_format_text(link)!r}, and nothing is fetched; name the system: "
        '{"type": "name", "properties": {"name": "EPSG:..."}}'
    )


def _all_texts(value: Any) -> Iterator[str]:
    left = [value]
    while left:
        one = left.pop()
        if isinstance(one, str):
            yield one
        elif isinstance(one, list | dict):
            left += one.values() if isinstance(one, dict) else one


def _format_text(text: str) -> str:
    return printable(shorten_text(" ".join(text.split()).strip(" \"'@"), SHOWN))
