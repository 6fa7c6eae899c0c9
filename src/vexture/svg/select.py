"""Choosing a part of a document by a CSS selector."""

import cssselect2
from lxml import etree

from vexture.errors import LimitError

__all__ = ["chosen", "nothing_painted"]

LONGEST_NAMED = 80
"""Most characters of a selector in a message."""


def chosen(root: etree._Element, select: str) -> set[etree._Element]:
    """Elements that a CSS selector list matches; a `LimitError` if it is no selector or matches nothing.

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
        wrappers = cssselect2.ElementWrapper.from_xml_root(root).iter_subtree()
        found = {wrapper.etree_element for wrapper in wrappers if wrapper.matches(*selectors)}
    except (cssselect2.SelectorError, SyntaxError, AttributeError) as error:
        cut = isinstance(error, AttributeError)  # what cssselect2 raises for :nth-child(2n+)
        reason = "it breaks off" if cut else str(error.args[-1] if error.args else error)[:LONGEST_NAMED]
        raise LimitError(
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
    return repr(text if len(text) <= LONGEST_NAMED else text[: LONGEST_NAMED - 3] + "...")
