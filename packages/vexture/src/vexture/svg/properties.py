"""The CSS properties that affect an SVG's picture: initial value, inheritance, and valid values.

To add a property, add it to `PROPERTIES` and use ``style["name"]`` where it takes effect. In SVG 2, geometry (`x`, `r`,
`d` ...) is set by properties, too.
"""

import re
from collections.abc import Callable
from typing import Final, NamedTuple

from vexture.drawing.calculation import sample_calculations
from vexture.drawing.colors import parse_color, parse_paint
from vexture.drawing.group import Blend
from vexture.svg.path_data import NUMBER
from vexture.svg.spatial import css_transform
from vexture.svg.values import Viewport

BLENDS = {blend.name.lower().replace("_", "-"): blend for blend in Blend}
"""Blend modes by their CSS names."""


UNSET = ("unset", "revert", "revert-layer")
"""Keywords for the inherited value, or else the initial one."""

KEYWORDS = ("inherit", "initial", *UNSET)
"""Keywords that are valid for every property."""


class Property(NamedTuple):
    """A CSS property as seen by the cascade."""

    initial: str
    inherited: bool
    accepts: Callable[[str], object]

    def allows(self, value: str) -> bool:
        """Return whether a value is valid; calculations count as their result."""
        return bool(self.accepts(value) or ("(" in value and self.accepts(sample_calculations(value))))


def anything(value: str) -> bool:
    """Accept every value; the code that uses it validates it."""
    return True


def one_of(*words: str) -> Callable[[str], object]:
    """Accept the words, in any case."""
    allowed = frozenset(words)
    return lambda value: value.lower() in allowed


def matching(pattern: str) -> Callable[[str], object]:
    """Accept the matches of a regular expression."""
    return re.compile(rf"\s*(?:{pattern})\s*", re.IGNORECASE).fullmatch


def is_transform(value: str) -> bool:
    """Accept functions whose arguments have units."""
    return css_transform(value, Viewport(1.0, 1.0).along(1.0)) is not None


PARTS: Final = ("fill", "stroke", "markers")
"""Parts of a shape in the default order of painting."""


def is_order(value: str) -> bool:
    """Accept distinct parts of a shape, or "normal" (SVG 2, 13.8)."""
    words = value.lower().split()
    return words == ["normal"] or (set(words) <= {*PARTS} and len({*words}) == len(words) > 0)


WEIGHTS: Final = frozenset({"normal", "bold", "bolder", "lighter"})


def is_weight(value: str) -> bool:
    """Accept keywords and 1 to 1000 (CSS Fonts 4, 2.2)."""
    word = value.strip().lower()
    return word in WEIGHTS or (re.fullmatch(NUMBER, word) is not None and 1.0 <= float(word) <= 1000.0)


UNIT = r"(?:px|pt|pc|in|cm|mm|q|em|ex|ch|rem|%|[sld]?v(?:w|h|i|b|min|max))?"
POSITIVE = rf"(?!-){NUMBER}"
LENGTH = f"{NUMBER}{UNIT}"
SIZE = f"{POSITIVE}{UNIT}"
OPACITY = rf"{NUMBER}(?:%|\.)?"  # Graphviz writes 1. for 1

MODE = "alpha|luminance|match-source"

RENDERINGS = (
    *("auto", "smooth", "high-quality", "pixelated", "crisp-edges", "-moz-crisp-edges", "-webkit-optimize-contrast"),
    *("optimizespeed", "optimizequality"),
)

SPACING = rf"normal|{LENGTH}"

FONT_SIZES = "(?:xx?-)?(?:small|large)|medium|smaller|larger"
STRETCHES = "(?:(?:ultra|extra|semi)-)?(?:condensed|expanded)|normal"
BASELINES = (
    *("auto", "alphabetic", "central", "hanging", "ideographic", "mathematical", "middle", "text-top", "text-bottom"),
    *("text-after-edge", "text-before-edge"),
)

PROPERTIES: dict[str, Property] = {
    "clip-rule": Property("nonzero", True, one_of("nonzero", "evenodd")),
    "color": Property("black", True, parse_color),
    "color-interpolation": Property("srgb", True, one_of("auto", "srgb", "linearrgb")),
    "color-interpolation-filters": Property("linearrgb", True, one_of("auto", "srgb", "linearrgb")),
    "fill": Property("black", True, parse_paint),
    "fill-opacity": Property("1", True, matching(OPACITY)),
    "fill-rule": Property("nonzero", True, one_of("nonzero", "evenodd")),
    "direction": Property("ltr", True, one_of("ltr", "rtl")),
    "dominant-baseline": Property("auto", True, one_of(*BASELINES, "use-script", "no-change", "reset-size")),
    "font-family": Property("", True, anything),
    "font-feature-settings": Property("normal", True, anything),
    "font-kerning": Property("auto", True, one_of("auto", "none", "normal")),
    "font-size": Property("medium", True, matching(rf"{SIZE}|{FONT_SIZES}")),
    "font-size-adjust": Property("none", True, matching(rf"none|(?:ex-height\s+)?{POSITIVE}")),
    "font-stretch": Property("normal", True, matching(rf"{STRETCHES}|{POSITIVE}%")),
    "font-style": Property("normal", True, matching(rf"normal|italic|oblique(?:\s+{NUMBER}(?:deg|grad|rad|turn))?")),
    "font-synthesis": Property("weight style small-caps", True, anything),
    "font-variant": Property("normal", True, anything),
    "font-variant-caps": Property("normal", True, anything),
    "font-variant-ligatures": Property("normal", True, anything),
    "font-variant-numeric": Property("normal", True, anything),
    "font-variant-position": Property("normal", True, anything),
    "font-variation-settings": Property("normal", True, anything),
    "font-weight": Property("normal", True, is_weight),
    "glyph-orientation-vertical": Property("auto", True, matching(f"auto|{NUMBER}(?:deg|grad|rad|turn)?")),
    "letter-spacing": Property("normal", True, matching(SPACING)),
    "kerning": Property("auto", True, matching(f"auto|{LENGTH}")),
    "lighting-color": Property("white", False, parse_color),
    "marker-end": Property("none", True, anything),
    "marker-mid": Property("none", True, anything),
    "marker-start": Property("none", True, anything),
    "paint-order": Property("normal", True, is_order),
    "stroke": Property("none", True, parse_paint),
    "stroke-dasharray": Property("none", True, matching(rf"none|{SIZE}(?:(?:\s*,\s*|\s+){SIZE})*+")),
    "stroke-dashoffset": Property("0", True, matching(LENGTH)),
    "stroke-linecap": Property("butt", True, one_of("butt", "round", "square")),
    "stroke-linejoin": Property("miter", True, one_of("miter", "round", "bevel", "miter-clip", "arcs")),
    "stroke-miterlimit": Property("4", True, matching(POSITIVE)),
    "stroke-opacity": Property("1", True, matching(OPACITY)),
    "stroke-width": Property("1", True, matching(SIZE)),
    "text-anchor": Property("start", True, one_of("start", "middle", "end")),
    "text-orientation": Property("mixed", True, one_of("mixed", "upright", "sideways", "sideways-right")),
    "text-shadow": Property("none", True, anything),
    "text-underline-offset": Property("auto", True, anything),
    "text-transform": Property("none", True, one_of("none", "uppercase", "lowercase", "capitalize", "full-width")),
    "white-space": Property("normal", True, one_of("normal", "nowrap", "pre", "pre-wrap", "pre-line", "break-spaces")),
    "word-spacing": Property("normal", True, matching(SPACING)),
    "writing-mode": Property(
        "horizontal-tb",
        True,
        one_of(
            *("horizontal-tb", "vertical-rl", "vertical-lr", "sideways-rl", "sideways-lr"),
            *("lr", "lr-tb", "rl", "rl-tb", "tb", "tb-rl", "tb-lr"),
        ),
    ),
    "visibility": Property("visible", True, one_of("visible", "hidden", "collapse")),
    "alignment-baseline": Property("baseline", False, one_of(*BASELINES, "baseline", "before-edge", "after-edge")),
    "animation-name": Property("none", False, anything),
    "background-color": Property("transparent", False, parse_color),
    "background-blend-mode": Property("normal", False, anything),
    "background-image": Property("none", False, anything),
    "background-size": Property("auto", False, anything),
    "border": Property("none", False, anything),
    "border-radius": Property("0", False, anything),
    "box-shadow": Property("none", False, anything),
    "baseline-shift": Property("baseline", False, matching(rf"{LENGTH}|baseline|sub|super|top|center|bottom")),
    "clip-path": Property("none", False, anything),
    "cx": Property("0", False, matching(LENGTH)),
    "cy": Property("0", False, matching(LENGTH)),
    "d": Property("none", False, anything),
    "display": Property("inline", False, anything),
    "filter": Property("none", False, anything),
    "flood-color": Property("black", False, parse_color),
    "flood-opacity": Property("1", False, matching(OPACITY)),
    "height": Property("auto", False, matching(f"auto|{SIZE}")),
    "inline-size": Property("auto", False, anything),
    "image-orientation": Property("from-image", True, anything),
    "image-rendering": Property("auto", True, one_of(*RENDERINGS)),
    "isolation": Property("auto", False, one_of("auto", "isolate")),
    "mask": Property("none", False, anything),
    "mask-mode": Property("match-source", False, matching(rf"(?:{MODE})(?:\s*,\s*(?:{MODE}))*+")),
    "mask-type": Property("luminance", False, one_of("luminance", "alpha")),
    "mix-blend-mode": Property("normal", False, one_of(*BLENDS)),
    "offset-path": Property("none", False, anything),
    "opacity": Property("1", False, matching(OPACITY)),
    "outline": Property("none", False, anything),
    "overflow": Property("visible", False, one_of("visible", "hidden", "scroll", "auto", "clip")),
    "padding": Property("0", False, anything),
    "r": Property("0", False, matching(SIZE)),
    "rotate": Property("none", False, anything),
    "rx": Property("auto", False, matching(f"auto|{SIZE}")),
    "ry": Property("auto", False, matching(f"auto|{SIZE}")),
    "scale": Property("none", False, anything),
    "shape-inside": Property("auto", False, anything),
    "stop-color": Property("black", False, parse_color),
    "stop-opacity": Property("1", False, matching(OPACITY)),
    "text-decoration": Property("none", False, anything),
    "text-decoration-color": Property("currentcolor", False, anything),
    "text-decoration-line": Property("none", False, anything),
    "text-decoration-style": Property("solid", False, anything),
    "text-decoration-thickness": Property("auto", False, anything),
    "transform": Property("none", False, is_transform),
    "transform-box": Property(
        "view-box", False, one_of("view-box", "fill-box", "stroke-box", "content-box", "border-box")
    ),
    "transform-origin": Property("0 0", False, anything),
    "translate": Property("none", False, anything),
    "unicode-bidi": Property(
        "normal",
        False,
        one_of("normal", "embed", "isolate", "bidi-override", "isolate-override", "plaintext"),
    ),
    "vector-effect": Property("none", False, anything),
    "width": Property("auto", False, matching(f"auto|{SIZE}")),
    "x": Property("0", False, matching(LENGTH)),
    "y": Property("0", False, matching(LENGTH)),
}

CSS_ONLY = frozenset(
    {
        *(
            "animation-name",
            "background-image",
            "border",
            "border-radius",
            "box-shadow",
            "offset-path",
            "outline",
            "padding",
        ),
        *("background-blend-mode", "background-color", "background-size"),
        *(
            "font-feature-settings",
            "font-kerning",
            "font-synthesis",
            "font-variant-caps",
        ),
        *("font-variant-ligatures", "font-variant-numeric", "font-variant-position", "font-variation-settings"),
        *(
            "image-orientation",
            "isolation",
            "mask-mode",
            "mix-blend-mode",
            "rotate",
            "scale",
            "text-decoration-color",
            "text-decoration-line",
        ),
        *("text-decoration-style", "text-decoration-thickness", "text-orientation", "text-transform"),
        *("text-shadow", "text-underline-offset", "translate"),
    }
)
"""Properties that are not presentation attributes (SVG 2, 6.6); as attributes, some names have another meaning."""
