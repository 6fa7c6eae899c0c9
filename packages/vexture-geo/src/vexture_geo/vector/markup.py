"""XML of features (KML, GPX, GML) before GDAL reads it: whole, without a DTD, and where it leads to."""

from collections import Counter
from collections.abc import Collection, Mapping
from typing import Final
from xml.parsers import expat

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError, printable, shorten_text

PIECE: Final = 2**20
"""Bytes that are parsed between two looks at the clock."""

NETWORK_LINK: Final = "NetworkLink"
HREF: Final = "http://www.w3.org/1999/xlink href"

SHOWN: Final = 80
"""Characters of a link in a message."""


def links_of_markup(content: bytes, beside: Collection[str] = ()) -> Mapping[str, int]:
    """Count links in XML that are not read, as texts of notes; raise a `SourceError` for damage or a DTD.

    GDAL stops at damage and keeps what came before it, in silence. A link of KML to a file `beside` it is read.

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
    except (expat.ExpatError, LookupError, ValueError) as error:  # the last two of an encoding
        raise SourceError(f"the XML is damaged ({shorten_text(str(error), SHOWN)}); save it again") from None
    return found
