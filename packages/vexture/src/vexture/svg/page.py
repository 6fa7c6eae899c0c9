"""Colours that a page passes to the drawing in it: `currentColor`, custom properties and context paints."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Final

from lxml import etree

from vexture.base.errors import ParameterError, shorten_text
from vexture.base.notes import Note
from vexture.drawing.colors import CONTEXT, CURRENT, Color, parse_color
from vexture.svg.document import local_name

NAMED: Final = "currentColor, context-fill, context-stroke or a custom property, such as --primary"
CURRENT_IS_BLACK: Final = "currentColor has no value in it, and is black as in browsers (`page_colors` gives it one)"
"""Message of a note on a drawing that also has other colours."""

LONGEST: Final = 40
"""Longest name in a note, in letters."""

MOST_NAMED: Final = 5
"""Most names in a list of a note."""

REFERENCE: Final = re.compile(r"var\(\s*(--[^\s,()]+)|(?<![\w-])(currentcolor|context-(?:fill|stroke))", re.IGNORECASE)
"""Name to which a value refers."""

DECLARATION: Final = re.compile(r"(?<![\w-])(--[^\s:;,(){}]+)\s*:")
"""Custom property that a style sheet or a `style` attribute declares."""


@dataclass(frozen=True, slots=True)
class Page:
    """The page around a drawing, with the colours that it passes on.

    Examples
    --------
    >>> Page.from_colors({"currentColor": "#c00", "--primary": "teal"}).inherited
    {'color': '#c00', '--primary': 'teal'}
    """

    colors: Mapping[str, str] = field(default_factory=dict)  # by name; `currentcolor` is in lower case
    is_open: bool = True  # True if a user can set colours, which is impossible for a drawing in an image

    @classmethod
    def from_colors(cls, colors: object) -> "Page":
        """Make a page from `page_colors`; raise a `ParameterError` if they are not valid."""
        if colors is None:
            return cls()
        if not isinstance(colors, Mapping):
            raise ParameterError(f"`page_colors` is {colors!r:.80}; it must be a mapping of names to CSS colours")
        return cls({checked_name(name): checked_color(name, color) for name, color in colors.items()})

    @property
    def inherited(self) -> dict[str, str]:
        """Properties that the outermost element of a drawing inherits."""
        own = ((name, color) for name, color in self.colors.items() if name not in CONTEXT)
        return {"color" if name == CURRENT else name: color for name, color in own}

    def context(self, name: str) -> Color | None:
        """Return the colour of a context paint outside markers and uses; None if it has none there."""
        color = parse_color(self.colors.get(name, ""))
        return color if isinstance(color, Color) else None

    def describe_missing(self, text: str, *, helps: bool) -> str:
        """Describe a reference without a value for a note; `helps` tells whether a colour would be valid there."""
        remedy = " (`page_colors` gives it one)" if helps and self.is_open else ""
        return f"{shorten_text(text, LONGEST)}, which has no value{remedy}"


ENCLOSED: Final = Page(is_open=False)
"""Page of a drawing in an image, which passes on no colours."""


def checked_name(name: object) -> str:
    """Return a name to which a page can give a colour; raise a `ParameterError` for any other name."""
    if isinstance(name, str):
        if name.startswith("--") and len(name) > len("--"):
            return name
        if name.lower() in (CURRENT, *CONTEXT):
            return name.lower()
    raise ParameterError(f"`page_colors` names {name!r:.80}; give {NAMED}")


def checked_color(name: object, color: object) -> str:
    """Return a colour of a page; raise a `ParameterError` if it is not one."""
    if not isinstance(color, str) or not isinstance(parse_color(color), Color):
        raise ParameterError(f"`page_colors` gives {name} {color!r:.80}; give a CSS colour, such as teal or #c00")
    return color.strip()


def unused_colors(page: Page, root: etree._Element) -> tuple[Note, ...]:
    """Return the note on colours of a page that nothing in a document refers to, if there are any.

    Examples
    --------
    >>> root = etree.fromstring('<svg><path fill="var(--primary)" stroke="currentColor"/></svg>')
    >>> print(*unused_colors(Page.from_colors({"--primry": "teal"}), root))
    `page_colors` names --primry, which the drawing does not have; it has --primary, currentColor
    """
    if not page.colors:
        return ()
    texts = [*texts_of(root)]
    matches = [match for text in texts for match in REFERENCE.finditer(text)]
    used = dict.fromkeys(match[1] or match[2].lower() for match in matches)
    unused = [name for name in page.colors if name not in used]
    if not unused:
        return ()
    own = {name for text in texts for name in DECLARATION.findall(text)}
    open_names = [name for name in used if name not in own]
    rest = f"it has {list_colors(open_names)}" if open_names else "it leaves no colour to the page"
    return (Note("remark", f"`page_colors` names {list_colors(unused)}, which the drawing does not have; {rest}"),)


def texts_of(root: etree._Element) -> Iterator[str]:
    """Yield the texts of a document that contain values: attributes and style sheets."""
    for element in root.iter("*"):
        yield from map(str, element.attrib.values())
        if local_name(element) == "style":
            yield "".join(map(str, element.itertext()))


def list_colors(names: list[str]) -> str:
    """List names of colours for a note, shortened if there are many."""
    labels = ["currentColor" if name == CURRENT else shorten_text(name, LONGEST) for name in names[:MOST_NAMED]]
    return ", ".join((*labels, "...") if len(names) > MOST_NAMED else labels)
