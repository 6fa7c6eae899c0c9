"""Colours that the page around a drawing gives it: `currentColor`, custom properties and context paints."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from vexture.errors import ParameterError, shortened
from vexture.svg.colors import CONTEXT, CURRENT, Color, parse_color

__all__ = ["CURRENT_IS_BLACK", "ENCLOSED", "Page"]

NAMED: Final = "currentColor, context-fill, context-stroke or a custom property, such as --primary"
CURRENT_IS_BLACK: Final = "currentColor has no value in it, and is black as in browsers (`page_colors` gives it one)"
"""What a note says of a drawing that has other colours, too."""

LONGEST: Final = 40
"""Letters of a name in a note."""


@dataclass(frozen=True, slots=True)
class Page:
    """What surrounds a drawing, and the colours that it gives.

    Examples
    --------
    >>> Page.of({"currentColor": "#c00", "--primary": "teal"}).inherited
    {'color': '#c00', '--primary': 'teal'}
    """

    colors: Mapping[str, str] = field(default_factory=dict)  # by names, of which `currentcolor` is in small letters
    is_open: bool = True  # whether a user can give colours: nobody can to a drawing in an image

    @classmethod
    def of(cls, given: object) -> "Page":
        """The page that gives some colours, by `page_colors`; raises a `ParameterError` if they are none."""
        if given is None:
            return cls()
        if not isinstance(given, Mapping):
            raise ParameterError(f"`page_colors` is {given!r:.80}; it must be a mapping of names to CSS colours")
        return cls({checked_name(name): checked_color(name, color) for name, color in given.items()})

    @property
    def inherited(self) -> dict[str, str]:
        """Properties that the outermost element of a drawing inherits."""
        given = ((name, color) for name, color in self.colors.items() if name not in CONTEXT)
        return {"color" if name == CURRENT else name: color for name, color in given}

    def context(self, name: str) -> Color | None:
        """The colour of a context paint outside of markers and uses; None if it has none there."""
        color = parse_color(self.colors.get(name, ""))
        return color if isinstance(color, Color) else None

    def lost(self, what: str, *, helps: bool) -> str:
        """What a note says of something that has no value; `helps` is whether a colour would be valid there."""
        remedy = " (`page_colors` gives it one)" if helps and self.is_open else ""
        return f"{shortened(what, LONGEST)}, which has no value{remedy}"


ENCLOSED: Final = Page(is_open=False)
"""What surrounds a drawing in an image: it gives none."""


def checked_name(name: object) -> str:
    """A name to which a page can give a colour; raises a `ParameterError` if it is another."""
    if isinstance(name, str):
        if name.startswith("--") and len(name) > len("--"):
            return name
        if name.lower() in (CURRENT, *CONTEXT):
            return name.lower()
    raise ParameterError(f"`page_colors` names {name!r:.80}; give {NAMED}")


def checked_color(name: object, color: object) -> str:
    """A colour that a page gives; raises a `ParameterError` if it is none."""
    if not isinstance(color, str) or not isinstance(parse_color(color), Color):
        raise ParameterError(f"`page_colors` gives {name} {color!r:.80}; give a CSS colour, such as teal or #c00")
    return color.strip()
