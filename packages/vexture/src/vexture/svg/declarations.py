"""Declarations of CSS: what style sheets and `style` attributes say of properties, with shorthands expanded."""

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
"""Style attributes that need no tokeniser: they can be split at ; and :."""

PREFIX: Final = "-webkit-"
"""Of names under which browsers know many properties, too, as they were before they became standards."""

MARKERS = ("marker-start", "marker-mid", "marker-end")

UNRESET: Final = frozenset({"direction", "unicode-bidi"})
"""Properties that `all` leaves alone (CSS Cascade 4, 3.2)."""

SIDED: Final = re.compile(
    "(border|outline)(?:-(?:top|right|bottom|left|inline|block)(?:-(?:start|end))?)?(?:-style)?"
    "|(padding)-[a-z-]+|(border)-[a-z-]+(-radius)"
)
"""Names of properties of one side or corner of a box, which are named as those of all."""

PAINTED: Final = "("
"""What images have, and most colours have not."""

SHORTHANDS: Final[dict[str, tuple[str, ...]]] = {
    "all": tuple(name for name in PROPERTIES if name not in UNRESET),
    "animation": ("animation-name",),  # with all else that it says: names are found in it
    "background": ("background-color", "background-image"),
    "font": FONT_LONGHANDS,
    "marker": MARKERS,
    "mask-image": ("mask",),
    "offset": ("offset-path",),
}
"""Properties that others set, as far as they are known here."""

MASK_MODES: Final = ("alpha", "luminance", "match-source")

MASK_LAYER: Final = re.compile(r"(.*?)(url\(\s*(?:\"[^\"]*\"|'[^']*'|[^\"')]*)\s*\))(.*)", re.IGNORECASE | re.DOTALL)
MASK_WORDS: Final = re.compile(
    r"(?:no-repeat|repeat(?:-[xy])?|space|round|center|left|right|top|bottom|auto|cover|contain|no-clip|[-+.\d]+[a-z%]*"
    r"|(?:content|padding|border|fill|stroke|view)-box|add|subtract|intersect|exclude|alpha|luminance|match-source)"
)
"""Words beside the reference of a mask."""


class Declaration(NamedTuple):
    """The value of a property, or of a custom one, whose name begins with two hyphens."""

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
    """Tokens of a style sheet or of a `style` attribute."""
    try:
        return cast(list[Any], tinycss2.parse_component_value_list(text, skip_comments=True))
    except ValueError:  # of int()
        raise SourceError("an integer in its styles has more than 4,300 digits; round it") from None


def read_descriptors(content: Any) -> Iterator[Declaration]:
    """Yield what the rules of a style sheet's block say, as written."""
    for item in tinycss2.parse_blocks_contents(content, skip_comments=True, skip_whitespace=True):
        if item.type == "declaration":
            yield Declaration(item.name, tinycss2.serialize(item.value).strip(), item.important)


def read_declaration(name: str, value: str, important: bool) -> Iterator[Declaration]:
    """Yield what a declaration says; a shorthand becomes its longhands, unless it refers to custom properties."""
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
    if not pairs and longhands(name) and value:  # to be named where it has no effect
        yield Declaration(name, value, important)


def canonical(name: str) -> str:
    """Name of a property in lower case, without a prefix."""
    return name.lower().removeprefix(PREFIX)


def longhands(name: str) -> tuple[str, ...]:
    """Properties that a property sets: itself, or what it is a shorthand for; none if it is not known here."""
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
    """Yield what the shorthand `mask` says: the reference and its mode; a value that is no reference stays whole.

    Of a mask that is an element, only the mode has an effect (CSS Masking 1, 7), not its place, size and repetition.

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
