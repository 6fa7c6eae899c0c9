"""CSS selectors: the relatives of an element, and choosing a part of a document."""

from collections.abc import Iterator
from functools import cached_property
from itertools import islice

import cssselect2
from lxml import etree

from vexture.deadline import check_time
from vexture.errors import LimitError, ParameterError, counted, shortened
from vexture.svg.document import language, local_name

__all__ = ["Node", "chosen", "nothing_painted", "unpainted", "with_symbols_used"]

LONGEST_NAMED = 80
"""Most characters of a selector in a message."""

LINKS = ("href", "{http://www.w3.org/1999/xlink}href")

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
        for name in FRAME:
            value = symbols[0].get(name)
            if value is not None:
                root.set(name, value)
            elif name in root.attrib:
                del root.attrib[name]
    uses = set()
    for number, symbol in enumerate(symbols):
        name = symbol.get("id") or f"vexture-symbol-{number}"
        symbol.set("id", name)
        use = etree.SubElement(root, etree.QName(etree.QName(root).namespace, "use"))
        use.set("href", f"#{name}")
        uses.add(use)
    return found.difference(symbols) | uses


def unpainted(root: etree._Element) -> str:
    """Remark about a document that paints nothing: a sprite is one of symbols."""
    names = [name for element in root.iter("{*}symbol", "symbol") if (name := element.get("id"))]
    if not names:
        return "nothing in it is painted"
    first = f"#{shortened(names[0], LONGEST_NAMED)}"
    return f"nothing in it is painted, but it has {counted(len(names), 'symbol')}; choose one by `select`, as {first!r}"


def nothing_painted(select: str, count: int) -> LimitError:
    """Error for a selector whose elements paint nothing."""
    elements = "1 element that paints" if count == 1 else f"{count} elements that paint"
    return LimitError(f"`select` {named(select)} matches {elements} nothing; choose some that are filled or stroked")


def named(select: str) -> str:
    """Selector as a message names it."""
    text = " ".join(select.split())
    return repr(shortened(text, LONGEST_NAMED))
