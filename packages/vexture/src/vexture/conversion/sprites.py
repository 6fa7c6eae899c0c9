"""The drawings of a source for an atlas: one drawing, or one per symbol of a sprite."""

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Final

from lxml import etree

from vexture.base.content import FileKind, about, decompress, is_stream, known_kind, read_bytes, start_of, unpack_source
from vexture.base.deadline import check_time
from vexture.base.errors import shorten_text
from vexture.base.notes import Note, Notes
from vexture.conversion.reading import Place, images_of, name_of, read_drawing
from vexture.drawing.drawing import Drawing
from vexture.svg.document import local_name, parse_svg
from vexture.svg.images import Images
from vexture.svg.links import Links, reference
from vexture.svg.page import Page, unused_colors
from vexture.svg.read import Request, read_document
from vexture.svg.select import SelectedPart, symbol_alone, symbols_of


def read_drawings(source: Place | bytes, *, name: str | None = None, **reading: Any) -> Iterator[tuple[str, Drawing]]:
    """Read the drawings of a source, each with its name for messages: one drawing, or one per symbol of a sprite.

    A sprite is an SVG that defines symbols and paints nothing else. With `select`, the matching elements are one
    drawing. `reading` holds parameters of `read_drawing`, and errors are the same.

    Examples
    --------
    >>> sprite = b'<svg><symbol id="up" viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></symbol></svg>'
    >>> [(shown, drawing.name) for shown, drawing in read_drawings(sprite, name="arrows.svg")]
    [('arrows.svg#up', 'up')]
    """
    label = name_of(source, name)
    content = read_bytes(source) if is_stream(source) else source
    drawing = read_drawing(content, name=label, **reading)
    plain = b"" if drawing.paths or reading.get("select") is not None else unpack_source(content)
    if not plain or known_kind(start_of(plain), label) is not FileKind.SVG:
        yield label, drawing
        return

    folder = Path(source).parent if isinstance(source, str | os.PathLike) else None
    of_symbols: dict[str, Any] = {key: reading[key] for key in ("names", "fonts", "page_colors") if key in reading}
    of_symbols["images"] = images_of(folder, reading.get("images", "draw"))
    is_sprite = False
    for symbol in symbol_drawings(read_bytes(plain), label, **of_symbols):
        is_sprite = True
        yield f"{label}#{symbol.name}", symbol
    if not is_sprite:
        yield label, drawing


LINK: Final = re.compile(r"#([^\s\"')]+)")
"""Possible link to an element, in an attribute or a style sheet."""


def symbol_drawings(
    content: bytes,
    source: str,
    names: str | None = None,
    fonts: Sequence[str | os.PathLike[str]] = (),
    images: Images | None = None,
    page_colors: Mapping[str, str] | None = None,
) -> Iterator[Drawing]:
    """Read the content of an SVG file as one drawing for each symbol with an id, which becomes its name.

    Each drawing is as if `select` chose the symbol. Parameters and errors are those of `svg_drawing`.

    Examples
    --------
    >>> symbol = '<symbol id="{}" viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></symbol>'
    >>> sprite = f"<svg>{symbol.format('up')}{symbol.format('down')}</svg>".encode()
    >>> [drawing.name for drawing in symbol_drawings(sprite, "arrows.svg")]
    ['up', 'down']
    """
    named, page = "id" if names is None else names, Page.from_colors(page_colors)
    with about(source):
        root = parse_svg(decompress(content))
    of_file = (*unread_symbols(root), *unused_colors(page, root))  # they belong to the first drawing
    sprite = Sprite(root)
    for name in sprite.symbols:
        check_time(source)
        alone = partial(symbol_part, name=name)
        with about(f"{source}#{name}"):
            request = Request(sprite.document(name), name, alone, named, fonts, images or Images(), page)
            drawing = read_document(request).drawing
        yield replace(drawing, notes=(*drawing.notes, *of_file))
        of_file = ()


def unread_symbols(root: etree._Element) -> tuple[Note, ...]:
    """Return notes on symbols of a sprite that cannot be reached by a name."""
    notes, named = Notes(), set(symbols_of(root).values())
    for symbol in root.iter("{*}symbol", "symbol"):
        if local_name(symbol) == "symbol" and symbol not in named:
            name = symbol.get("id")
            notes.left_out(
                f"symbol with the id of another, {shorten_text(name, 40)!r}" if name else "symbol without an id"
            )
    return notes.in_order


def symbol_part(root: etree._Element, name: str) -> SelectedPart:
    """Return the part to paint of a document with one symbol."""
    return symbol_alone(root, symbols_of(root)[name])


class Sprite:
    """A document whose symbols are read one by one, without the thousands of others that each one does not need.

    A style sheet may count siblings. If there is one, an empty symbol replaces each symbol that is left out.
    """

    def __init__(self, root: etree._Element) -> None:
        self.root = root
        self.symbols = symbols_of(root)
        every = [one for one in root.iter("{*}symbol", "symbol") if local_name(one) == "symbol"]
        self.outermost = [one for one in every if not any(local_name(each) == "symbol" for each in one.iterancestors())]
        owners = {each: one for one in self.outermost for each in one.iter("*")}
        self.owner = {name: owners[one] for name, one in self.symbols.items()}
        links = Links(root)
        self.needs: dict[etree._Element | None, set[etree._Element]] = {one: set() for one in (None, *self.outermost)}
        for element in root.iter("*"):
            check_time()
            found = (owners.get(target) for link in links_of(element) if (target := links.target(link)) is not None)
            self.needs[owners.get(element)].update(one for one in found if one is not None)
        self.is_styled = next(root.iter("{*}style", "style"), None) is not None
        self.places = {one: self.left_out(one) for one in self.outermost}

    def left_out(self, symbol: etree._Element) -> etree._Element:
        """Remove a symbol; return its replacement, or else its parent."""
        around = symbol.getparent()
        assert around is not None
        if not self.is_styled:
            around.remove(symbol)
            return around
        empty = around.makeelement(symbol.tag, {str(key): str(value) for key, value in symbol.attrib.items()})
        around.replace(symbol, empty)
        return empty

    def document(self, name: str) -> etree._Element:
        """Return a document for one symbol."""
        needed, waiting = set[etree._Element](), [*self.needs[None], self.owner[name]]
        while waiting:
            one = waiting.pop()
            if one not in needed:
                needed.add(one)
                waiting.extend(self.needs[one])
        for one in (each for each in self.outermost if each in needed):
            place = self.places[one]
            around = place.getparent() if self.is_styled else place
            assert around is not None
            if self.is_styled:
                around.replace(place, one)
            else:
                around.append(one)
        whole = deepcopy(self.root.getroottree()).getroot()
        for one in needed:
            self.places[one] = self.left_out(one)
        return whole


def links_of(element: etree._Element) -> Iterator[str]:
    """Yield texts that may be links, from the attributes of an element or the text of a style sheet."""
    link = reference(element)
    if link is not None:
        yield link
    sheet = element.text or "" if local_name(element) == "style" else ""
    for text in (sheet, *map(str, element.attrib.values())):
        if "#" in text:
            yield from (f"#{name}" for name in LINK.findall(text))
