"""CSS selectors: the relatives of an element, and choosing a part of a document."""

from collections.abc import Iterator
from functools import cached_property
from itertools import islice

import cssselect2
from lxml import etree

from vexture.deadline import check_time
from vexture.errors import LimitError, ParameterError, counted, shortened
from vexture.svg.document import language, local_name

__all__ = [
    "UNPAINTED",
    "Node",
    "chosen",
    "nothing_painted",
    "symbol_alone",
    "symbols_of",
    "unpainted",
    "with_symbols_used",
]

LONGEST_NAMED = 80
"""Most characters of a selector in a message."""

LINKS = ("href", "{http://www.w3.org/1999/xlink}href")

UNPAINTED = "nothing in it is painted"
"""Remark about a document."""

SHOWN = ("display:inline!important", "visibility:visible!important", "opacity:1!important")
"""Undoes what hides a sprite in a page."""

FRAME = ("viewBox", "width", "height", "preserveAspectRatio")
"""What sets the frame of a document, or of a symbol."""


class Node(cssselect2.ElementWrapper):  # type: ignore[misc]
    """An element for selectors. It finds relatives one after another, and looks at the clock.

    Its base keeps a tuple of them for each element, by recursion: too much memory, and too deep, where many siblings
    stand side by side.
    """

    @property
    def ancestors(self) -> Iterator["Node"]:
        """Elements around this one, from the inner ones to the root."""
        return self._line("parent")

    @property
    def previous_siblings(self) -> Iterator["Node"]:
        """Siblings before this one, the nearest first."""
        return self._line("previous")

    @cached_property
    def lang(self) -> str:
        """Language in lower case, for `:lang()`; its base knows only `xml:lang`."""
        return (language(self.etree_element) or "").lower()

    def _line(self, step: str) -> Iterator["Node"]:
        check_time()
        node = getattr(self, step)
        while node is not None:
            yield node
            node = getattr(node, step)

    def iter_children(self) -> Iterator["Node"]:
        """The elements in this one, made once."""
        check_time()
        return iter(self._children)

    @cached_property
    def _children(self) -> list["Node"]:
        return list(super().iter_children())

    def iter_next_siblings(self) -> Iterator["Node"]:
        """Siblings after this one, in order."""
        return islice(self.iter_siblings(), self.index + 1, None)


def chosen(root: etree._Element, select: str) -> set[etree._Element]:
    """Elements that a CSS selector list matches; a `ParameterError` if it is no selector.

    Raises a `LimitError` if it matches nothing.

    Namespace prefixes are those that the root element declares, as in ``[inkscape|label="Roads"]``.

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
        cut = isinstance(error, AttributeError)  # what cssselect2 raises for :nth-child(2n+)
        reason = "it breaks off" if cut else shortened(str(error.args[-1] if error.args else error), LONGEST_NAMED)
        raise ParameterError(
            f"`select` {named(select)} is no CSS selector ({reason}); write it like '#id', '.class' or 'g > path'"
        ) from None
    except (RecursionError, MemoryError):
        raise LimitError(f"`select` {named(select)} nests brackets too deeply; simplify it") from None
    if not found:
        raise LimitError(
            f"`select` {named(select)} matches no element; name one of the file's ids, classes or elements"
        )
    return found


def with_symbols_used(root: etree._Element, found: set[etree._Element]) -> set[etree._Element]:
    """Chosen elements, with an element `use` in place of each `symbol` that the document does not use.

    A single one fills the drawing: its viewBox becomes that of the document, which is changed.

    Examples
    --------
    >>> root = etree.fromstring('<svg><symbol id="a" viewBox="0 0 24 24"><path d="M0 0h9v9z"/></symbol></svg>')
    >>> [etree.QName(one).localname for one in with_symbols_used(root, {root[0]})], root.get("viewBox")
    (['use'], '0 0 24 24')
    """
    used = {link for use in root.iter("{*}use", "use") for name in LINKS if (link := use.get(name, "").strip())}
    symbols = [one for one in found if local_name(one) == "symbol" and f"#{one.get('id')}" not in used]
    if len(found) == 1 and symbols:
        return symbol_alone(root, symbols[0])
    return found.difference(symbols) | {use_of(root, symbol, number) for number, symbol in enumerate(symbols)}


def symbol_alone(root: etree._Element, symbol: etree._Element) -> set[etree._Element]:
    """An element `use` of a symbol, which fills the drawing: its viewBox becomes that of the document.

    What hides a sprite in a page, or gives it no size there, is undone: a page shows the symbols elsewhere.
    """
    for name in FRAME:
        value = symbol.get(name)
        if value is not None:
            root.set(name, value)
        elif name in root.attrib:
            del root.attrib[name]
    sides = (f"{name}:{root.get(name, 'auto')}!important" for name in ("width", "height"))
    root.set("style", ";".join((root.get("style", ""), *SHOWN, *sides)))
    return {use_of(root, symbol, 0)}


def use_of(root: etree._Element, symbol: etree._Element, number: int) -> etree._Element:
    """A new element `use` of a symbol, at the end of the document; a symbol without a name gets one with a number."""
    name = symbol.get("id") or f"vexture-symbol-{number}"
    symbol.set("id", name)
    use = etree.SubElement(root, etree.QName(etree.QName(root).namespace, "use"))
    use.set("href", f"#{name}")
    return use


def unpainted(root: etree._Element) -> str:
    """Remark about a document that paints nothing: a sprite is one of symbols."""
    names = [*symbols_of(root)]
    if not names:
        return UNPAINTED
    first = f"#{shortened(names[0], LONGEST_NAMED)}"
    symbols = f"{UNPAINTED}, but it has {counted(len(names), 'symbol')}"
    return f"{symbols}; choose one by `select`, as {first!r}, or convert all of them by `atlas`"


def symbols_of(root: etree._Element) -> dict[str, etree._Element]:
    """The symbols of a document by their names; of several with one name only the first can be used."""
    found: dict[str, etree._Element] = {}
    for element in root.iter("{*}symbol", "symbol"):
        name = element.get("id")
        if name and local_name(element) == "symbol":
            found.setdefault(name, element)
    return found


def nothing_painted(select: str, count: int) -> LimitError:
    """Error for a selector whose elements paint nothing."""
    elements = "1 element that paints" if count == 1 else f"{count} elements that paint"
    return LimitError(f"`select` {named(select)} matches {elements} nothing; choose some that are filled or stroked")


def named(select: str) -> str:
    """Selector as a message names it."""
    text = " ".join(select.split())
    return repr(shortened(text, LONGEST_NAMED))
