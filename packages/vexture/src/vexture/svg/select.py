"""CSS selectors: relatives of an element, and selection of a part of a document."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

import cssselect2
from lxml import etree

from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, ParameterError, format_count, printable, shorten_text
from vexture.base.notes import Note
from vexture.svg.document import language, local_name
from vexture.svg.values import INITIAL_SIZE, Viewport, is_relative
from vexture.svg.viewport import Rectangle, view_box

LONGEST_NAMED = 80
"""Longest selector in a message, in characters."""

MOST_NAMED = 3
"""Most symbols of a sprite that a message names."""

LINKS = ("href", "{http://www.w3.org/1999/xlink}href")

UNPAINTED = "nothing in it is painted"
"""Remark on a document without painted content."""

SHOWN = ("display:inline", "visibility:visible", "opacity:1")
"""Declarations that undo the hiding of a sprite in a page."""

FRAME = ("viewBox", "width", "height", "preserveAspectRatio")
"""Attributes that set the frame of a document or of a symbol."""


@dataclass(frozen=True, slots=True)
class SelectedPart:
    """Elements of a document to paint."""

    elements: set[etree._Element]
    is_unframed: bool = False  # True if it is a symbol without a frame, whose frame follows from its content


class Node(cssselect2.ElementWrapper):  # type: ignore[misc]
    """An element for selectors that finds its relatives one by one, and checks the time limit.

    The base class stores a tuple of relatives for each element, by recursion, which takes too much memory and depth for
    many siblings.
    """

    @property
    def ancestors(self) -> Iterator["Node"]:
        """Elements around this one, from the inside to the root."""
        return self._line("parent")

    @property
    def previous_siblings(self) -> Iterator["Node"]:
        """Siblings before this one, the nearest first."""
        return self._line("previous")

    @cached_property
    def lang(self) -> str:
        """Language in lower case, for `:lang()`; the base class knows only `xml:lang`."""
        return (language(self.etree_element) or "").lower()

    def _line(self, step: str) -> Iterator["Node"]:
        check_time()
        node = getattr(self, step)
        while node is not None:
            yield node
            node = getattr(node, step)

    def iter_children(self) -> Iterator["Node"]:
        """Return the children of this element, which are created once."""
        check_time()
        return iter(self._children)

    @cached_property
    def _children(self) -> list["Node"]:
        return list(super().iter_children())

    def iter_next_siblings(self) -> Iterator["Node"]:
        """Return the siblings after this one, in order."""
        return islice(self.iter_siblings(), self.index + 1, None)


def chosen(root: etree._Element, select: str) -> set[etree._Element]:
    """Return the elements that a CSS selector list matches.

    Raise a `ParameterError` if it is not valid, and a `LimitError` if it matches nothing. Namespace prefixes are those
    that the root element declares, as in ``[inkscape|label="Roads"]``.

    Examples
    --------
    >>> root = etree.fromstring('<svg><g id="a"><path/></g><path class="b"/></svg>')
    >>> sorted(element.tag for element in chosen(root, "#a, .b"))
    ['g', 'path']
    """
    prefixes = {prefix: name for prefix, name in root.nsmap.items() if prefix is not None}
    try:
        selectors = cssselect2.compile_selector_list(select, prefixes)
        wrappers = Node.from_xml_root(root).iter_subtree()
        found = {wrapper.etree_element for wrapper in wrappers if wrapper.matches(*selectors)}
    except (cssselect2.SelectorError, SyntaxError, AttributeError) as error:
        cut = isinstance(error, AttributeError)  # raised by cssselect2 for :nth-child(2n+)
        reason = "it breaks off" if cut else shorten_text(str(error.args[-1] if error.args else error), LONGEST_NAMED)
        raise ParameterError(
            f"`select` {format_selector(select)} is no CSS selector ({reason}); "
            "write it like '#id', '.class' or 'g > path'"
        ) from None
    except (RecursionError, MemoryError):
        raise LimitError(f"`select` {format_selector(select)} nests brackets too deeply; simplify it") from None
    if not found:
        raise LimitError(
            f"`select` {format_selector(select)} matches no element; name one of the file's ids, classes or elements"
        )
    return found


def with_symbols_used(root: etree._Element, found: set[etree._Element]) -> SelectedPart:
    """Return selected elements, with an element `use` in place of each `symbol` that the document does not use.

    A single symbol fills the drawing: its viewBox becomes the document's, which is changed.

    Examples
    --------
    >>> root = etree.fromstring('<svg><symbol id="a" viewBox="0 0 24 24"><path d="M0 0h9v9z"/></symbol></svg>')
    >>> part = with_symbols_used(root, {root[0]})
    >>> [etree.QName(one).localname for one in part.elements], root.get("viewBox")
    (['use'], '0 0 24 24')
    """
    used = {link for use in root.iter("{*}use", "use") for name in LINKS if (link := use.get(name, "").strip())}
    symbols = [one for one in found if local_name(one) == "symbol" and f"#{one.get('id')}" not in used]
    if len(found) == 1 and symbols:
        return symbol_alone(root, symbols[0])
    return SelectedPart(
        found.difference(symbols) | {use_of(root, symbol, number) for number, symbol in enumerate(symbols)}
    )


def symbol_alone(root: etree._Element, symbol: etree._Element) -> SelectedPart:
    """Return an element `use` of a symbol that fills the drawing, as an `<svg>` with the symbol's viewBox would.

    A symbol without a viewBox gets a frame of its width and height. Styles that hide a sprite in a page, or remove its
    size, are undone, because a page shows the symbols elsewhere.
    """
    box = view_box(symbol.get("viewBox", ""))
    sides = own_sides(symbol) if box is None else None
    for name in FRAME:
        root.attrib.pop(name, "")
    if box is not None:
        root.set("viewBox", symbol.get("viewBox", ""))
    own = ("auto", "auto") if sides is None else [f"{side!r}px" for side in sides]
    add_style(root, *SHOWN, f"width:{own[0]}", f"height:{own[1]}")
    add_style(symbol, "x:0", "y:0")
    use = use_of(root, symbol, 0)
    if box is None and sides is None:
        add_style(symbol, "overflow:visible")
        return SelectedPart({use}, is_unframed=True)
    placed: Rectangle = box or (0.0, 0.0, *(sides or (0.0, 0.0)))
    add_style(use, *(f"{name}:{side!r}px" for name, side in zip(("x", "y", "width", "height"), placed, strict=True)))
    return SelectedPart({use})


def own_sides(symbol: etree._Element) -> tuple[float, float] | None:
    """Return the width and height of a symbol by its attributes; None if one is relative to its use."""
    texts = [symbol.get(name, "auto") for name in ("width", "height")]
    width, height = (
        None if is_relative(text) else Viewport(0.0, 0.0).length(text, 0.0, INITIAL_SIZE) for text in texts
    )
    return None if width is None or height is None else (width, height)


def add_style(element: etree._Element, *declarations: str) -> None:
    """Add declarations to the style of an element; no style sheet overrides them."""
    element.set("style", ";".join((element.get("style", ""), *(f"{each}!important" for each in declarations))))


def use_of(root: etree._Element, symbol: etree._Element, number: int) -> etree._Element:
    """Append a new element `use` of a symbol to the document.

    A symbol without a name, or with the name of an earlier element, gets a name with a number.
    """
    name = symbol.get("id")
    if not name or next(one for one in root.iter("*") if one.get("id") == name) is not symbol:
        name = f"vexture-symbol-{number}"
    symbol.set("id", name)
    use = etree.SubElement(root, etree.QName(etree.QName(root).namespace, "use"))
    use.set("href", f"#{name}")
    return use


def unpainted_note(root: etree._Element) -> Note:
    """Return the note on a document without painted content; for a sprite it lists the symbols, which are left out."""
    names = [f"#{name}" for name in symbols_of(root)]
    if not names:
        return Note("remark", UNPAINTED)
    labels = ", ".join(repr(shorten_text(printable(name), LONGEST_NAMED)) for name in names[:MOST_NAMED])
    more = ", ..." if len(names) > MOST_NAMED else ""
    remedy = "choose one by `select`, or make an atlas of all, as `vexture convert --atlas` does"
    return Note("left out", f"{format_count(len(names), 'symbol')}: {labels}{more} ({remedy})", has_remedy=True)


def symbols_of(root: etree._Element) -> dict[str, etree._Element]:
    """Return the symbols of a document by name; of several with the same name, only the first can be used."""
    found: dict[str, etree._Element] = {}
    for element in root.iter("{*}symbol", "symbol"):
        name = element.get("id")
        if name and local_name(element) == "symbol":
            found.setdefault(name, element)
    return found


def nothing_painted(select: str, count: int) -> LimitError:
    """Return the error for a selector whose elements paint nothing."""
    elements = "1 element that paints" if count == 1 else f"{count} elements that paint"
    return LimitError(
        f"`select` {format_selector(select)} matches {elements} nothing; choose some that are filled or stroked"
    )


def format_selector(select: str) -> str:
    """Format a selector for a message."""
    text = " ".join(select.split())
    return repr(shorten_text(text, LONGEST_NAMED))
