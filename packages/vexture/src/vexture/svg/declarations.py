"""CSS declarations from style sheets and `style` attributes, with shorthands expanded."""

import re
from collections.abc import Iterator
from typing import Any, Final, NamedTuple, cast

import tinycss2

from vexture.base.errors import SourceError
from vexture.drawing.colors import parse_color
from vexture.svg.font_values import FONT_LONGHANDS, font_longhands
from vexture.svg.properties import KEYWORDS, PROPERTIES
from vexture.svg.values import words
from vexture.svg.variables import refers

PLAIN = re.compile(r"[^\"'\\/(){}\[\]@!<&]*")
"""Style attributes that need no tokenizer, as they can be split at ; and :."""

PREFIX: Final = "-webkit-"
"""Prefix under which browsers know many properties from the time before they became standards."""

MARKERS = ("marker-start", "marker-mid", "marker-end")

UNRESET: Final = frozenset({"direction", "unicode-bidi"})
"""Properties that `all` does not reset (CSS Cascade 4, 3.2)."""

SIDED: Final = re.compile(
    "(border|outline)(?:-(?:top|right|bottom|left|inline|block)(?:-(?:start|end))?)?(?:-style)?"
    "|(padding)-[a-z-]+|(border)-[a-z-]+(-radius)"
)
"""Names of properties of one side or corner of a box, from which the name of the property of all is derived."""

PAINTED: Final = "("
"""Character that images contain and most colours do not."""

SHORTHANDS: Final[dict[str, tuple[str, ...]]] = {
    "all": tuple(name for name in PROPERTIES if name not in UNRESET),
    "animation": ("animation-name",),  # with all its other values, among which names are found
    "background": ("background-color", "background-image"),
    "font": FONT_LONGHANDS,
    "marker": MARKERS,
    "mask-image": ("mask",),
    "offset": ("offset-path",),
}
"""Shorthands, with those of their longhands that are supported."""

MASK_MODES: Final = ("alpha", "luminance", "match-source")

MASK_LAYER: Final = re.compile(r"(.*?)(url\(\s*(?:\"[^\"]*\"|'[^']*'|[^\"')]*)\s*\))(.*)", re.IGNORECASE | re.DOTALL)
MASK_WORDS: Final = re.compile(
    r"(?:no-repeat|repeat(?:-[xy])?|space|round|center|left|right|top|bottom|auto|cover|contain|no-clip|[-+.\d]+[a-z%]*"
    r"|(?:content|padding|border|fill|stroke|view)-box|add|subtract|intersect|exclude|alpha|luminance|match-source)"
)
"""Words besides the reference in a value of `mask`."""


class Declaration(NamedTuple):
    """The value of a property or of a custom property, whose name starts with two hyphens."""

    name: str
    value: str
    important: bool


def read_style(text: str) -> Iterator[Declaration]:
    """Yield the declarations of a `style` attribute."""
    if PLAIN.fullmatch(text):
        for part in text.split(";"):
            name, _, value = part.partition(":")
            yield from read_declaration(name.strip(), value.strip(), False)
    else:
        for name, value, important in read_descriptors(tokens(text)):
            yield from read_declaration(name, value, important)


def tokens(text: str) -> list[Any]:
    """Parse a style sheet or a `style` attribute into tokens."""
    try:
        return cast(list[Any], tinycss2.parse_component_value_list(text, skip_comments=True))
    except ValueError:  # raised by int()
        raise SourceError("an integer in its styles has more than 4,300 digits; round it") from None


def read_descriptors(content: Any) -> Iterator[Declaration]:
    """Yield the declarations in a block of a style sheet, unchanged."""
    for item in tinycss2.parse_blocks_contents(content, skip_comments=True, skip_whitespace=True):
        if item.type == "declaration":
            yield Declaration(item.name, tinycss2.serialize(item.value).strip(), item.important)


def read_declaration(name: str, value: str, important: bool) -> Iterator[Declaration]:
    """Yield a declaration; a shorthand is expanded into its longhands, unless it refers to custom properties."""
    if name.startswith("--"):
        yield Declaration(name, value, important)
        return
    name = canonical(name)
    if refers(value):
        if longhands(name):
            yield Declaration(name, value, important)
        return
    pairs = [*expand_declaration(name, value)]
    for longhand, part in pairs:
        yield Declaration(longhand, part, important)
    if not pairs and longhands(name) and value:  # so that a note names it if it has no effect
        yield Declaration(name, value, important)


def canonical(name: str) -> str:
    """Return the name of a property in lower case, without a prefix."""
    return name.lower().removeprefix(PREFIX)


def longhands(name: str) -> tuple[str, ...]:
    """Return the properties that a property sets: itself, or its longhands; none if it is not supported."""
    if name in PROPERTIES:
        return (name,)
    match = SIDED.fullmatch(name)
    return SHORTHANDS.get(name, ()) if match is None else ("".join(filter(None, match.groups())),)


def expand_declaration(name: str, value: str) -> Iterator[tuple[str, str]]:
    """Yield the longhands that a property and its value set."""
    if name == "mask" and value:
        yield from mask_longhands(value)
    elif name in PROPERTIES and value:
        yield name, value
    elif name == "background":
        parts = [value, *reversed(words(value))]
        yield "background-color", next(filter(parse_color, parts), "transparent")
        yield "background-image", value if PAINTED in value.lower() else "none"
    elif SIDED.fullmatch(name) and value:
        yield longhands(name)[0], value
    elif name == "font":
        yield from font_longhands(value)
    elif name in SHORTHANDS and value and (name != "all" or value.lower() in KEYWORDS):
        for longhand in SHORTHANDS[name]:
            yield longhand, value


def mask_longhands(value: str) -> Iterator[tuple[str, str]]:
    """Expand the shorthand `mask` into reference and mode; a value that is not a reference stays whole.

    For a mask that is an element, only the mode has an effect, not position, size and repetition (CSS Masking 1, 7).

    Examples
    --------
    >>> dict(mask_longhands("url(#m) no-repeat alpha")), dict(mask_longhands("url(#m) bright"))
    ({'mask': 'url(#m)', 'mask-mode': 'alpha'}, {'mask': 'url(#m) bright', 'mask-mode': 'match-source'})
    """
    match = MASK_LAYER.fullmatch(value)
    words = f"{match[1]} {match[3]}".lower().replace("/", " ").split() if match else []
    mode = next((word for word in words if word in MASK_MODES), MASK_MODES[-1])
    known = match is not None and all(map(MASK_WORDS.fullmatch, words))
    yield "mask", match[2] if match and known else value
    yield "mask-mode", mode if known else MASK_MODES[-1]
