"""Style sheets of a drawing, with media queries, layers and nesting, and their declarations for an element."""

from collections.abc import Iterator
from math import inf
from typing import Any, Final, NamedTuple

import cssselect2
import tinycss2
from lxml import etree

from vexture.base.errors import shorten_text
from vexture.drawing.calculation import split_arguments
from vexture.svg.animations import KEYFRAMES, Values, read_keyframes
from vexture.svg.declarations import (
    Declaration,
    canonical,
    expand_declaration,
    longhands,
    read_declaration,
    read_descriptors,
    tokens,
)
from vexture.svg.media import Answer, Medium, condition, significant_tokens, word
from vexture.svg.properties import PROPERTIES
from vexture.svg.report import Report
from vexture.svg.select import Node

UNREADABLE = (cssselect2.SelectorError, SyntaxError, AttributeError, NotImplementedError, RecursionError, MemoryError)
"""Errors that cssselect2 raises for selectors that it cannot read."""

LONGEST: Final = 20_000
"""Longest selector, including those of the rules around it, whose lengths multiply with nested `&`."""

LONGEST_NAMED: Final = 60
"""Longest name in a note, in characters."""

PARENT: Final = "&"

FORGIVING: Final = frozenset({"is", "where", "matches", "-webkit-any"})
NOTHING: Final = tinycss2.parse_component_value_list(":not(*)")
"""Selector that matches nothing."""

COMBINATORS: Final = (">", "+", "~")

SILENT: Final = frozenset({"charset"})
"""At-rules without any effect."""

Layer = tuple[str, ...]
"""Names of the layers around a rule, starting with the outermost."""

OTHER_NAMES: Final = """
    accent-color align-content align-items align-self animation-composition animation-delay animation-direction
    animation-duration animation-fill-mode animation-iteration-count animation-play-state animation-range
    animation-timeline animation-timing-function appearance aspect-ratio backdrop-filter backface-visibility
    background-attachment background-blend-mode background-clip background-origin background-position
    background-repeat background-size block-size bottom box-decoration-break box-sizing break-after break-before
    break-inside caption-side caret-color clear clip color-scheme column-count column-fill column-gap column-rule
    column-span column-width columns contain contain-intrinsic-size container container-name container-type content
    content-visibility counter-increment counter-reset counter-set cursor direction empty-cells field-sizing flex
    flex-basis flex-direction flex-flow flex-grow flex-shrink flex-wrap float font-display font-optical-sizing
    font-palette gap grid grid-area grid-auto-columns grid-auto-flow grid-auto-rows grid-column grid-column-end
    grid-column-gap grid-column-start grid-gap grid-row grid-row-end grid-row-gap grid-row-start grid-template
    grid-template-areas grid-template-columns grid-template-rows hyphens inset
    inset-block inset-inline interpolate-size justify-content justify-items justify-self left line-break line-clamp
    line-height list-style list-style-image list-style-position list-style-type margin margin-block margin-bottom
    margin-inline margin-left margin-right margin-top mask-border mask-clip mask-composite mask-image mask-origin
    mask-position mask-repeat mask-size max-block-size max-height max-inline-size max-width min-block-size
    min-height min-inline-size min-width object-fit object-position offset offset-anchor offset-distance
    offset-position offset-rotate order orphans outline-color outline-offset outline-style outline-width
    overflow-anchor overflow-wrap overflow-x overflow-y overscroll-behavior padding-block padding-bottom
    padding-inline padding-left padding-right padding-top page perspective perspective-origin place-content
    place-items place-self pointer-events position print-color-adjust quotes resize right row-gap scroll-behavior
    scroll-margin scroll-padding scroll-snap-align scroll-snap-stop scroll-snap-type scroll-timeline scrollbar-color
    scrollbar-gutter scrollbar-width shape-image-threshold shape-margin shape-outside tab-size table-layout
    text-align text-align-last text-combine-upright text-decoration-skip-ink text-emphasis text-indent text-justify
    text-overflow text-size-adjust text-underline-position text-wrap top touch-action transform-style transition
    transition-behavior transition-delay transition-duration transition-property transition-timing-function
    user-select vertical-align view-timeline view-transition-name white-space-collapse widows will-change word-break
    word-wrap z-index zoom
"""

OTHER_PROPERTIES: Final = frozenset(OTHER_NAMES.split())
"""Properties that browsers support but that no drawing here shows, so that `@supports` answers as in browsers.

They are those of Chromium 150, without names of its own that are not CSS.
"""

PREFIXED: Final = (
    *("align-", "appearance", "backface-visibility", "background-", "box-", "column", "flex", "justify-content"),
    *("line-clamp", "mask-", "order", "perspective", "print-color-adjust", "transform-style", "transition"),
    *("text-emphasis", "text-size-adjust", "user-select"),
)
"""Prefixes of those properties that are also known with ``-webkit-``."""


class FontFace(NamedTuple):
    """A rule `@font-face`."""

    descriptors: dict[str, str]  # by name
    element: etree._Element  # the style sheet


class Around(NamedTuple):
    """A style rule that contains others."""

    selectors: list[Any]
    text: str


class StyleSheets:
    """The `<style>` elements of a document; `medium` is the medium that shows it."""

    def __init__(self, root: etree._Element, report: Report, medium: Medium) -> None:
        self.report = report
        self.medium = medium
        self.matcher: Any = None
        self.font_faces: list[FontFace] = []
        self.keyframes: dict[str, Values] = {}
        self.wrappers: dict[etree._Element, Any] = {}
        self.layers: dict[Layer, int] = {(): 0}  # in order of appearance
        self.prefixes = dict[str, str]()  # prefixes of namespaces
        sheets = [element for element in root.iter("{*}style") if element.text]
        if not sheets:
            return
        self.matcher = cssselect2.Matcher()
        for sheet in sheets:
            self.element = sheet
            if sheet.get("type", "text/css").strip().lower() in ("", "text/css") and self.holds(
                tokens(sheet.get("media", "")), 'media="{}" of <style>'
            ):
                self.add_rules(tinycss2.parse_stylesheet(tokens(sheet.text or ""), True, True), ())
        for wrapper in Node.from_xml_root(root).iter_subtree():
            self.wrappers[wrapper.etree_element] = wrapper
        self.ranks = {layer: rank for rank, layer in enumerate(sorted(self.layers, key=self.layer_order))}

    @property
    def has_layers(self) -> bool:
        """True if there are layers."""
        return len(self.layers) > 1

    def layer_order(self, layer: Layer) -> tuple[float, ...]:
        """Return the sort key of a layer: rules outside layers follow all rules in layers (CSS Cascade 5, 6.4.3)."""
        return *(self.layers[layer[:depth]] for depth in range(1, len(layer) + 1)), inf

    def declarations_of(self, element: etree._Element) -> Iterator[tuple[float, Declaration]]:
        """Yield the declarations for an element, in rising specificity, each with the rank of its layer."""
        if self.matcher is not None and element in self.wrappers:  # false for replaced CSS shapes
            for _, _, pseudo, (declarations, layer) in self.matcher.match(self.wrappers[element]):
                if pseudo is None:
                    rank = self.ranks[layer]
                    for declaration in declarations:
                        yield rank, declaration

    def add_rules(self, rules: list[Any], layer: Layer) -> None:
        """Add rules, in order."""
        for rule in rules:
            if rule.type == "qualified-rule":
                self.add_style_rule(rule, layer)
            elif rule.type == "at-rule":
                self.add_at_rule(rule, layer)

    def add_style_rule(self, rule: Any, layer: Layer, around: Around | None = None) -> None:
        """Add the declarations and the nested rules of a style rule."""
        try:
            text = tinycss2.serialize(rule.prelude).strip()
            parent = ":root" if around is None else around.text
            copies = text.count(PARENT) + (0 if around is None else text.count(",") + 1)
            if copies and len(text) + copies * len(parent) > LONGEST:
                raise SyntaxError
            if copies:
                text = nested_selector(rule.prelude, parent, around is not None)
            selectors = self.compile_selectors(text)
        except UNREADABLE:
            self.report.left_out(f"CSS selector '{format_tokens(rule.prelude)}', which cannot be read", self.element)
            return
        self.add_block(rule.content, layer, Around(selectors, text))

    def compile_selectors(self, text: str) -> list[Any]:
        """Compile a list of selectors; unknown ones in `:is()` and `:where()` match nothing (Selectors 4, 4.2)."""
        try:
            return list(cssselect2.compile_selector_list(text, self.prefixes))
        except cssselect2.SelectorError:
            forgiven = forgiving(tinycss2.parse_component_value_list(text), self.prefixes)
            return list(cssselect2.compile_selector_list(forgiven, self.prefixes))

    def add_block(self, content: Any, layer: Layer, around: Around) -> None:
        """Add the declarations and rules in the block of a style rule."""
        declarations = list[Declaration]()
        for item in tinycss2.parse_blocks_contents(content, skip_comments=True, skip_whitespace=True):
            if item.type == "declaration":
                declarations += read_declaration(item.name, tinycss2.serialize(item.value).strip(), item.important)
                continue
            self.add_declarations(declarations, layer, around)
            declarations = []
            if item.type == "qualified-rule":
                self.add_style_rule(item, layer, around)
            elif item.type == "at-rule":
                self.add_at_rule(item, layer, around)
        self.add_declarations(declarations, layer, around)

    def add_declarations(self, declarations: list[Declaration], layer: Layer, around: Around) -> None:
        """Add declarations for the elements of a style rule."""
        if declarations:
            for selector in around.selectors:
                self.matcher.add_selector(selector, (declarations, layer))

    def add_at_rule(self, rule: Any, layer: Layer, around: Around | None = None) -> None:
        """Add the rules inside an at-rule, if it is a condition that holds, or a layer."""
        name = rule.lower_at_keyword
        if name == "font-face":
            descriptors = {each.name.lower(): each.value for each in read_descriptors(rule.content or [])}
            self.font_faces.append(FontFace(descriptors, self.element))
        elif name in KEYFRAMES:
            called, values = read_keyframes(rule, declarations)
            self.keyframes[called] = values
        elif name == "layer":
            self.add_layers(rule, layer, around)
        elif name == "media" and rule.content is not None:
            if self.holds(rule.prelude, "@media {}"):
                self.add_content(rule.content, layer, around)
        elif name == "supports" and rule.content is not None:
            answer = condition(significant_tokens(rule.prelude), is_supported)
            if answer:
                self.add_content(rule.content, layer, around)
            elif answer is None:
                self.report.left_out(f"@supports {format_tokens(rule.prelude)}", self.element)
        elif name == "namespace":
            self.add_namespace(rule)
        elif name not in SILENT:
            self.report.left_out(f"@{name[:40]}", self.element)

    def add_namespace(self, rule: Any) -> None:
        """Store the prefix of a namespace. A default namespace is ignored: it is the drawing's, or matches nothing."""
        prefix, *values = significant_tokens(rule.prelude) or [None]
        if values and prefix.type == "ident":
            value = values[0]
            self.prefixes[prefix.value] = value.arguments[0].value if value.type == "function" else value.value

    def holds(self, queries: list[Any], message: str) -> bool:
        """Return whether media queries hold; add a note on unknown ones."""
        answer = self.medium.holds(queries)
        if answer is None:
            self.report.left_out(message.format(format_tokens(queries)), self.element)
        return answer is True

    def add_content(self, content: list[Any], layer: Layer, around: Around | None) -> None:
        """Add the content of an at-rule."""
        if around is None:
            self.add_rules(tinycss2.parse_rule_list(content, skip_comments=True, skip_whitespace=True), layer)
        else:
            self.add_block(content, layer, around)

    def add_layers(self, rule: Any, layer: Layer, around: Around | None) -> None:
        """Add the layers that a rule names, in order, and the rules inside it."""
        names = [tinycss2.serialize(part).strip() for part in split_arguments(rule.prelude)]
        for name in names:
            inner = layer
            for part in name.split(".") if name else [f" {len(self.layers)}"]:  # a layer without a name is unique
                inner = (*inner, part.strip())
                self.layers.setdefault(inner, len(self.layers))
            if rule.content is not None and len(names) == 1:
                self.add_content(rule.content, inner, around)


def declarations(content: Any) -> Iterator[Declaration]:
    """Yield the declarations of a block that contains no rules."""
    for name, value, important in read_descriptors(content):
        yield from read_declaration(name, value, important)


def format_tokens(tokens: list[Any]) -> str:
    """Format the beginning of some tokens for a note."""
    try:
        text = str(tinycss2.serialize(tokens))
    except RecursionError:
        text = "..."
    return shorten_text(" ".join(text.split()), LONGEST_NAMED)


def nested_selector(prelude: list[Any], around: str, is_relative: bool) -> str:
    """Return the selector of a rule nested in another one with the selector `around` (CSS Nesting 1)."""
    found = list[str]()
    for part in split_arguments(prelude):
        text = with_parent(part, around).strip()
        bare = PARENT not in tinycss2.serialize(part) or text.startswith(COMBINATORS)
        found.append(f":is({around}) {text}" if is_relative and bare else text)
    return ", ".join(found)


def forgiving(tokens: list[Any], prefixes: dict[str, str]) -> list[Any]:
    """Remove unknown selectors from the functions `:is()` and `:where()` of a selector."""
    found = list[Any]()
    for token in tokens:
        if token.type == "function" and token.lower_name in FORGIVING:
            parts = [forgiving(part, prefixes) for part in split_arguments(token.arguments)]
            known = [part for part in parts if is_selector(part, prefixes)] or [NOTHING]
            text = ",".join(str(tinycss2.serialize(part)) for part in known)
            found += tinycss2.parse_component_value_list(f"{token.name}({text})")
        else:
            found.append(token)
    return found


def with_parent(prelude: list[Any], around: str) -> str:
    """Replace each `&` in a selector by another selector."""
    found = list[str]()
    for token in prelude:
        if token == PARENT:
            found.append(f":is({around})")
        elif token.type == "function":
            found.append(f"{token.name}({with_parent(token.arguments, around)})")
        else:
            found.append(tinycss2.serialize([token]))
    return "".join(found)


def is_supported(token: Any) -> Answer:
    """Return whether a condition of `@supports` holds, for a declaration or a selector, as in browsers."""
    if token.type == "function":
        return is_selector(token.arguments) if token.lower_name == "selector" else None
    if token.type != "() block":
        return None
    inside = significant_tokens(token.content)
    if inside and (inside[0].type in ("() block", "function") or word(inside[0]) == "not"):
        return condition(inside, is_supported)
    name, colon, value = (part.strip() for part in tinycss2.serialize(token.content).partition(":"))
    if not colon:
        return None
    if name.startswith("--"):
        return True
    known = canonical(name)
    if not longhands(known):
        return is_other_property(name.lower())  # its value is assumed to be valid
    pairs = [*expand_declaration(known, value)]
    return bool(pairs) and all(PROPERTIES[longhand].allows(part) for longhand, part in pairs)


def is_selector(arguments: list[Any], prefixes: dict[str, str] | None = None) -> bool:
    """Return whether tokens are a supported selector."""
    try:
        return len(cssselect2.compile_selector_list(arguments, prefixes)) == 1
    except UNREADABLE:
        return False


def is_other_property(name: str) -> bool:
    """Return whether browsers support a property that no drawing here shows.

    Examples
    --------
    >>> is_other_property("backdrop-filter"), is_other_property("-webkit-user-select"), is_other_property("nothing")
    (True, True, False)
    """
    plain = name.removeprefix("-webkit-")
    return plain in OTHER_PROPERTIES and (plain == name or plain.startswith(PREFIXED))
