"""CSS selectors: the relatives of an element, and choosing a part of a document."""

from collections.abc import Iterator
from functools import cached_property
from itertools import islice

import cssselect2
from lxml import etree

from vexture.deadline import check_time
from vexture.errors import LimitError, ParameterError, shortened
from vexture.svg.document import language

__all__ = ["Node", "chosen", "nothing_painted"]

LONGEST_NAMED = 80
"""Most characters of a selector in a message."""


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
        reason = "it breaks off" if cut else str(error.args[-1] if error.args else error)[:LONGEST_NAMED]
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


def nothing_painted(select: str, count: int) -> LimitError:
    """Error for a selector whose elements paint nothing."""
    elements = "1 element that paints" if count == 1 else f"{count} elements that paint"
    return LimitError(f"`select` {named(select)} matches {elements} nothing; choose some that are filled or stroked")


def named(select: str) -> str:
    """Selector as a message names it."""
    text = " ".join(select.split())
    return repr(shortened(text, LONGEST_NAMED))
