"""The CSS cascade: attributes, style sheets, `style`, `!important` and inheritance (CSS Cascade 4)."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from operator import itemgetter
from typing import Any, cast

import cssselect2
import tinycss2
from lxml import etree

from vexture.errors import SourceError
from vexture.svg.colors import Color, parse_color
from vexture.svg.document import XML, local_name
from vexture.svg.font_values import SPACINGS, font_longhands, font_weight, in_pixels, text_size
from vexture.svg.keyframes import (
    KEYFRAMES,
    Keyframes,
    animation_longhands,
    declared_at_start,
    names_of,
    read_keyframes,
)
from vexture.svg.mask_values import mask_longhands
from vexture.svg.properties import CSS_ONLY, PROPERTIES
from vexture.svg.report import Report
from vexture.svg.select import Node
from vexture.svg.values import fraction

__all__ = ["INITIAL", "LISTING", "MARKERS", "Cascade", "Style", "read_style"]

PLAIN = re.compile(r"[^\"'\\/(){}\[\]@!<&]*")
"""Style attributes that need no tokeniser: they can be split at ; and :."""

SCREEN = re.compile(r"\s*(?:only\s+)?(?:all|screen)?\s*", re.IGNORECASE)
"""Media queries that hold on every screen."""

OTHER_MEDIUM = re.compile(r"\s*(?:only\s+)?(?:print|speech)\b.*|\s*not\s+(?:all|screen)\s*", re.IGNORECASE | re.DOTALL)

PREFIX = "-webkit-"
"""Of names under which browsers know many properties, too, as they were before they became standards."""

MARKERS = ("marker-start", "marker-mid", "marker-end")

UNSET = ("unset", "revert", "revert-layer")
"""Keywords for the inherited value, or else the initial one."""

SPACE_MODES = {"default": "normal", "preserve": "pre"}
"""What `xml:space` says, as the value of `white-space` that browsers give it."""

LISTED, LISTING = frozenset({"x", "y"}), frozenset({"text", "tspan", "textPath", "tref"})
"""Attributes that are lists of these elements, and no properties (SVG 2, 11.2)."""

Declaration = tuple[str, str, bool]
"""Property, value, and whether it is important."""


@dataclass(frozen=True, slots=True, eq=False)
class Style:
    """Values of all properties at one element, as text."""

    inherited: dict[str, str]  # inherited properties that differ from their initial values
    own: dict[str, str]  # other properties that the element sets
    font_size: float  # in user units

    def __getitem__(self, name: str) -> str:
        value = self.own.get(name) or self.inherited.get(name)
        return PROPERTIES[name].initial if value is None else value

    def opacity(self, name: str) -> float:
        """Opacity that a property gives, 0..1."""
        value = fraction(self[name])
        return 1.0 if value is None else value

    @property
    def color(self) -> Color:
        """The meaning of `currentcolor` here."""
        color = parse_color(self["color"])
        return color if isinstance(color, Color) else Color((0.0, 0.0, 0.0), 1.0)


INITIAL = Style({}, {}, 16.0)
"""Style that the outermost element inherits."""


class Cascade:
    """Computes the style of an element from its parent's, with the document's `<style>` elements."""

    def __init__(self, root: etree._Element, report: Report) -> None:
        self.report = report
        self.matcher: Any = None
        self.font_faces: list[dict[str, str]] = []  # descriptors of each @font-face rule, by name
        self.keyframes: dict[str, Keyframes] = {}
        self.wrappers: dict[etree._Element, Any] = {}
        sheets = [element for element in root.iter("{*}style") if element.text]
        if sheets:
            self.matcher = cssselect2.Matcher()
            for sheet in sheets:
                if sheet.get("type", "text/css").strip().lower() in ("", "text/css"):
                    self.add_rules(
                        tinycss2.parse_stylesheet(tokens(sheet.text or ""), skip_comments=True, skip_whitespace=True)
                    )
            for wrapper in Node.from_xml_root(root).iter_subtree():
                self.wrappers[wrapper.etree_element] = wrapper

    def add_rules(self, rules: list[Any]) -> None:
        """Add the rules of a style sheet to the matcher, in order."""
        for rule in rules:
            if rule.type == "qualified-rule":
                declarations = list(read_declarations(rule.content))
                try:
                    selectors = cssselect2.compile_selector_list(rule.prelude)
                except (cssselect2.SelectorError, SyntaxError, AttributeError, RecursionError, MemoryError):
                    self.report.left_out("a CSS selector that cannot be read")
                    continue
                for selector in selectors:
                    self.matcher.add_selector(selector, declarations)
            elif rule.type == "at-rule":
                self.add_at_rule(rule)

    def add_at_rule(self, rule: Any) -> None:
        """Add the rules inside an at-rule, if it is a medium that applies."""
        name = rule.lower_at_keyword
        if name in KEYFRAMES:
            called, frames = read_keyframes(rule, read_declarations)
            self.keyframes[called] = frames
            return
        if name == "font-face":
            self.font_faces.append({key: value for key, value, _ in read_descriptors(rule.content or [])})
        if name in ("charset", "font-face", "namespace"):
            return
        queries = tinycss2.serialize(rule.prelude).split(",")
        if name == "media" and any(map(SCREEN.fullmatch, queries)):
            content = rule.content or []
            self.add_rules(tinycss2.parse_rule_list(content, skip_comments=True, skip_whitespace=True))
        elif name != "media" or not all(map(OTHER_MEDIUM.fullmatch, queries)):
            self.report.left_out(f"@{name[:40]}")

    def style(self, element: etree._Element, parent: Style) -> Style:
        """Style of an element; `parent` is the style of its parent, or of the `use` that shows it."""
        inherited, own = parent.inherited, dict[str, str]()
        for name, value in self.specified(element).items():
            keyword = value.lower()
            entry = PROPERTIES[name]
            if keyword in UNSET or (keyword == "inherit" and entry.inherited):
                continue
            if keyword == "inherit":
                value = parent[name]
            elif keyword == "initial":
                value = entry.initial
            elif keyword in ("bolder", "lighter"):
                value = f"{font_weight(value, parent[name]):g}"
            if not entry.inherited:
                own[name] = value
            elif inherited.get(name) != value:
                if inherited is parent.inherited:
                    inherited = dict(inherited)
                inherited[name] = value
        font_size = parent.font_size
        if inherited is not parent.inherited and "font-size" in inherited:
            font_size = text_size(inherited.pop("font-size"), parent.font_size)
        if inherited is not parent.inherited:
            for name in SPACINGS:
                if inherited.get(name) != parent.inherited.get(name):
                    inherited[name] = in_pixels(inherited[name], font_size)
        return Style(inherited, own, font_size)

    def specified(self, element: etree._Element) -> dict[str, str]:
        """Winning declaration of each property, in rising precedence: attributes, rules, `style`, `!important`."""
        found: dict[str, str] = {}
        mode = SPACE_MODES.get(str(element.get(f"{{{XML}}}space")))
        if mode is not None:
            found["white-space"] = mode
        for key, value in element.attrib.items():
            name = str(key)
            if name in PROPERTIES and name not in CSS_ONLY:
                if name in LISTED and local_name(element) in LISTING:
                    continue
                self.declare(found, name, str(value), element)
        declared = sorted(self.declared(element), key=itemgetter(2))  # stable; important ones come last
        for name, value, _ in declared:
            self.declare(found, name, value, element)
        if self.is_animated(found):
            lasting = {name for name, _, important in declared if important}
            for name, value in declared_at_start(found, self.keyframes):
                if name not in lasting:
                    self.declare(found, name, value, element)
        return found

    def is_animated(self, found: dict[str, str]) -> bool:
        """Whether an element with such declarations is animated by a style sheet."""
        return "animation-name" in found and not self.keyframes.keys().isdisjoint(names_of(found))

    def declare(self, found: dict[str, str], name: str, value: str, element: etree._Element) -> None:
        """Override earlier declarations, unless this one is invalid."""
        value = value.strip()
        if PROPERTIES[name].accepts(value) or value.lower() in ("inherit", "initial", *UNSET):
            found[name] = value
        elif "var(" in value:
            self.report.left_out("CSS variables")
        else:
            self.report.invalid(name, value, element)

    def declared(self, element: etree._Element) -> Iterator[Declaration]:
        """Yield the declarations of the style sheets and then of the `style` attribute, in rising precedence."""
        if self.matcher is not None and element in self.wrappers:  # not one that stands for a shape of CSS
            for _, _, pseudo, declarations in self.matcher.match(self.wrappers[element]):
                if pseudo is None:
                    yield from declarations
        text = element.get("style")
        if text:
            yield from read_style(text)


def read_style(text: str) -> Iterator[Declaration]:
    """Yield the declarations of a `style` attribute."""
    if PLAIN.fullmatch(text):
        for part in text.split(";"):
            name, _, value = part.partition(":")
            yield from expanded(name.strip().lower(), value.strip(), False)
    else:
        yield from read_declarations(tokens(text))


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
            yield item.lower_name, tinycss2.serialize(item.value).strip(), item.important


def read_declarations(content: Any) -> Iterator[Declaration]:
    """Yield the declarations of a style sheet's rule or of a `style` attribute."""
    for name, value, important in read_descriptors(content):
        yield from expanded(name, value, important)


def expanded(name: str, value: str, important: bool) -> Iterator[Declaration]:
    """Yield the declaration of a known property; a shorthand becomes its longhands."""
    name = name.removeprefix(PREFIX)
    if name == "mask" and value:
        for longhand, part in mask_longhands(value):
            yield longhand, part, important
    elif name in PROPERTIES and value:
        yield name, value, important
    elif name == "background":
        words = [value, *reversed(value.split())]
        yield "background-color", next(filter(parse_color, words), "transparent"), important
    elif name == "mask-image" and value:
        yield "mask", value, important
    elif name == "marker" and value:
        for marker in MARKERS:
            yield marker, value, important
    elif name == "animation":
        for longhand, part in animation_longhands(value):
            yield longhand, part, important
    elif name == "font":
        for longhand, part in font_longhands(value):
            yield longhand, part, important
