"""The CSS cascade: attributes, style sheets, `style`, `!important` and inheritance (CSS Cascade 4)."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import inf
from operator import attrgetter, itemgetter

from lxml import etree

from vexture.drawing.colors import BLACK, Color, parse_color, parse_paint
from vexture.svg.animations import names_in, values_by_element, visible_value
from vexture.svg.declarations import Declaration, expand_declaration, longhands, read_style
from vexture.svg.document import XML, local_name
from vexture.svg.font_values import SPACINGS, SYSTEM_FONTS, font_weight, in_pixels, text_size
from vexture.svg.media import Medium
from vexture.svg.page import Page
from vexture.svg.properties import CSS_ONLY, KEYWORDS, PROPERTIES, UNSET
from vexture.svg.report import Report
from vexture.svg.spatial import Attribute
from vexture.svg.stylesheets import StyleSheets
from vexture.svg.values import INITIAL_SIZE, Viewport, fraction
from vexture.svg.variables import compute_variables, refers, substitute, unknown
from vexture.svg.viewport import own_size

NOT_SUPPORTED = re.compile(
    r"(?<![\w-])(?:alpha|attr|calc-size|contrast-color|device-cmyk|env|if|progress|random|sibling-(?:count|index))\(",
    re.IGNORECASE,
)
"""Unsupported functions of CSS."""

BACK = "revert-layer"

SPACE_MODES = {"default": "normal", "preserve": "pre"}
"""Values of `white-space` to which browsers map `xml:space`."""

STRIPPED = frozenset({"g", "svg", "tspan", "use"})
"""Elements that `display: contents` replaces by their content; it hides other elements."""

BOXES, CIRCLES = frozenset({"foreignObject", "image", "rect", "svg", "symbol", "use"}), frozenset({"circle", "ellipse"})
GEOMETRY = {
    **dict.fromkeys(("x", "y", "width", "height"), BOXES),
    **dict.fromkeys(("cx", "cy"), CIRCLES),
    "r": frozenset({"circle"}),
    **dict.fromkeys(("rx", "ry"), frozenset({"ellipse", "rect"})),
}
"""Elements whose attribute of the name is a property; for others, such as gradients, it is not CSS (SVG 2, 8.1)."""

CLIPPED = frozenset({"foreignObject", "image", "marker", "pattern", "svg", "symbol"})
"""Elements that by default clip their content to their viewport, as in browsers, except the outermost element."""


@dataclass(frozen=True, slots=True, eq=False)
class ElementStyle:
    """Values of all properties at one element, as text."""

    inherited: dict[str, str]  # inherited properties that differ from their initial values, and custom properties
    own: dict[str, str]  # other properties that the element sets
    font_size: float  # in user units

    def __getitem__(self, name: str) -> str:
        value = self.own.get(name) or self.inherited.get(name)
        return PROPERTIES[name].initial if value is None else value

    def opacity(self, name: str) -> float:
        """Return the opacity that a property sets, 0..1."""
        value = fraction(self[name])
        return 1.0 if value is None else value

    def inherited_value(self, name: str) -> str:
        """Return the inherited value of a property."""
        return f"{self.font_size!r}px" if name == "font-size" else self[name]

    @property
    def color(self) -> Color:
        """Value of `currentcolor`."""
        color = parse_color(self["color"])
        return color if isinstance(color, Color) else BLACK

    @property
    def has_color(self) -> bool:
        """True if `currentcolor` has a value; otherwise it is black."""
        return "color" in self.inherited

    def solid(self, text: str) -> Color | None:
        """Return a colour that may depend on `color`; None if the text is not a colour."""
        color = parse_color(text, self.color)
        return color if isinstance(color, Color) else None


INITIAL = ElementStyle({}, {}, INITIAL_SIZE)
"""Style that the outermost element inherits without a page."""


class Cascade:
    """Computes the style of an element from its parent's style and the document's `<style>` elements."""

    def __init__(self, root: etree._Element, report: Report, page: Page) -> None:
        self.root = root
        self.report = report
        self.page = page
        self.initial: ElementStyle = replace(INITIAL, inherited=page.inherited)  # style that the root inherits
        self.broken = dict[str, str]()  # custom properties without a value, unparsed
        size = own_size(root)
        self.view = Viewport(*size)  # reference of font sizes
        self.sheets = StyleSheets(root, report, Medium(*size))
        self.animated = values_by_element(root)
        self.reveals = False  # True if anything is drawn in the state that only an animation shows

    def style(self, element: etree._Element, parent: ElementStyle) -> ElementStyle:
        """Return the style of an element; `parent` is the style of its parent, or of the `use` that shows it."""
        declared = self.declarations_of(element)
        variables = {one.name: one.value for one in declared if one.name.startswith("--")}
        inherited = compute_variables(variables, parent.inherited) if variables else parent.inherited
        self.broken.update((name, value) for name, value in variables.items() if name not in inherited)
        own = dict[str, str]()
        for name, value in self.winning_values(element, declared, inherited, parent).items():
            keyword = value.lower()
            entry = PROPERTIES[name]
            if keyword in UNSET or (keyword == "inherit" and entry.inherited):
                continue
            if keyword == "inherit":
                value = parent[name]
            elif keyword == "initial":
                value = entry.initial
            elif name == "color" and isinstance(parse_color(value), str):
                value = absolute(value, parent)
            elif keyword in ("bolder", "lighter"):
                value = f"{font_weight(value, parent[name]):g}"
            if not entry.inherited:
                own[name] = value
            elif inherited.get(name) != value:
                if inherited is parent.inherited:
                    inherited = dict(inherited)
                inherited[name] = value
        if own.get("display", "").lower() == "contents" and element is not self.root:  # CSS Display 3, B
            own = {} if local_name(element) in STRIPPED else {"display": "none"}
        font_size = parent.font_size
        if inherited is not parent.inherited and "font-size" in inherited:
            font_size = text_size(inherited.pop("font-size"), parent.font_size, self.view)
        if element is self.root:
            self.view = replace(self.view, root_font_size=font_size)
        if inherited is not parent.inherited:
            for name in SPACINGS:
                if inherited.get(name) != parent.inherited.get(name):
                    inherited[name] = in_pixels(inherited[name], font_size, self.view)
        return ElementStyle(inherited, own, font_size)

    def winning_values(
        self, element: etree._Element, declared: list[Declaration], variables: Mapping[str, str], parent: ElementStyle
    ) -> dict[str, str]:
        """Return the winning declaration of each property, or an animation's value if the own one hides the element."""
        found = self.said(element, declared, variables)
        animations = [self.animated.get(element, {})]
        animations += [self.sheets.keyframes[name] for name in self.animation_names(found)]
        lasting = {one.name for one in declared if one.important} if any(animations) else set[str]()
        for values in animations:
            for name in values.keys() & PROPERTIES.keys() - lasting:
                base = self.value_without(name, found, parent)
                dashes = self.value_without("stroke-dasharray", found, parent)
                texts = [substitute(text, variables.get) or "" for text in values[name]]
                visible = visible_value(name, base, filter(PROPERTIES[name].allows, texts), dashes)
                if visible is not None:
                    found[name] = visible
                    self.reveals = True
        return found

    def value_without(self, name: str, found: Mapping[str, str], parent: ElementStyle) -> str:
        """Return the value of a property without animations, given its declarations."""
        text = found.get(name, "unset").lower()
        if text == "inherit" or (text in UNSET and PROPERTIES[name].inherited):
            return parent.inherited_value(name)
        return PROPERTIES[name].initial if text in KEYWORDS else found[name]

    def said(
        self, element: etree._Element, declared: list[Declaration], variables: Mapping[str, str]
    ) -> dict[str, str]:
        """Return the values that an element sets: attributes, overridden by declarations in rising precedence."""
        found: dict[str, str] = {}
        kind = local_name(element) or ""
        if kind in CLIPPED and element is not self.root:
            found["overflow"] = "hidden"
        mode = SPACE_MODES.get(str(element.get(f"{{{XML}}}space")))
        if mode is not None:
            found["white-space"] = mode
        for key, value in element.attrib.items():
            name = str(key)
            if name in PROPERTIES and name not in CSS_ONLY:
                if name in GEOMETRY and kind not in GEOMETRY[name]:
                    continue
                if name == "transform":
                    found[name] = Attribute(str(value).strip())
                else:
                    self.declare(found, name, str(value), element, variables)
        for name, value, _ in declared:
            if not name.startswith("--"):
                self.declare(found, name, value, element, variables)
        return found

    def animation_names(self, found: Mapping[str, str]) -> list[str]:
        """Return the names of the keyframe animations that declarations refer to."""
        return names_in(found["animation-name"], self.sheets.keyframes) if "animation-name" in found else []

    def declare(
        self, found: dict[str, str], name: str, value: str, element: etree._Element, variables: Mapping[str, str]
    ) -> None:
        """Override earlier declarations, unless this one is invalid.

        The validity of a value with references is known too late: an invalid one leaves its properties unset, and
        earlier declarations are lost (CSS Variables 1, 3.1).
        """
        value = value.strip()
        pairs = [(name, value)] if name in PROPERTIES else []
        if refers(value):
            text = substitute(value, variables.get)
            found.update(dict.fromkeys(longhands(name), "unset"))
            if text is None and self.note_unknown(name, value, element, variables):
                return
            pairs = [] if text is None else [*expand_declaration(name, text)]
        for longhand, part in pairs:
            if PROPERTIES[longhand].allows(part) or part.lower() in KEYWORDS:
                found[longhand] = part
            else:
                self.refuse(longhand, part, element)
        if not pairs:
            self.refuse(name, value, element)

    def note_unknown(self, name: str, value: str, element: etree._Element, variables: Mapping[str, str]) -> bool:
        """Note each custom property without a value that a value refers to; return whether there is any.

        For a declared property, note those that its own value lacks. One that refers to itself lacks none.
        """
        sample = substitute(value, lambda each: variables.get(each, "black")) or ""
        helps = any(
            PROPERTIES[longhand].accepts in (parse_color, parse_paint) and PROPERTIES[longhand].allows(part)
            for longhand, part in expand_declaration(name, sample)
        )
        names, known = unknown(value, variables.get), set[str]()
        ends = list[str]()
        while names:
            each = names.pop()
            if each not in known:
                known.add(each)
                written = self.broken.get(each, "")
                names += unknown(written, variables.get)
                ends += [] if written else [each]
        for each in sorted(ends):
            self.report.once("invalid", self.page.describe_missing(f"var({each})", helps=helps), element)
        return bool(ends)

    def refuse(self, name: str, value: str, element: etree._Element) -> None:
        """Note a value without effect, because it is invalid or has an unsupported function."""
        match = NOT_SUPPORTED.search(value)
        if name == "font" and value.lower() in SYSTEM_FONTS:
            self.report.left_out(f"font {value.lower()} of the system", element)
        elif match is None:
            self.report.invalid(name, value, element)
        else:
            self.report.left_out(f"{match[0].lower()}) in {name}", element)

    def declarations_of(self, element: etree._Element) -> list[Declaration]:
        """Return declarations of style sheets and the `style` attribute, in rising precedence (CSS Cascade 5, 6.1)."""
        text = element.get("style", "")
        own = [*read_style(text)] if text else []
        ruled = [*self.sheets.declarations_of(element)]
        if not self.sheets.has_layers and not any(one.value.lower() == BACK for _, one in ruled) and BACK not in text:
            found = [one for _, one in ruled] + own
            return sorted(found, key=attrgetter("important")) if any(one.important for one in found) else found
        ranked = [((one.important, -rank if one.important else rank), one) for rank, one in ruled]
        ranked += [((one.important, inf), one) for one in own]
        return rolled_back(sorted(ranked, key=itemgetter(0)))  # the sort is stable


def rolled_back(ranked: list[tuple[tuple[bool, float], Declaration]]) -> list[Declaration]:
    """Remove declarations that are rolled back to earlier layers (CSS Cascade 5, 7.3.5)."""
    found = list[tuple[tuple[bool, float], Declaration]]()
    for key, one in ranked:
        if one.value.lower() == BACK:
            found = [(other, each) for other, each in found if other != key or each.name != one.name]
        else:
            found.append((key, one))
    return [one for _, one in found]


def absolute(color: str, parent: ElementStyle) -> str:
    """Return a value of `color` that depends on the parent's as an absolute colour."""
    (red, green, blue), alpha = parent.solid(color) or BLACK
    return f"color(srgb {red!r} {green!r} {blue!r} / {alpha!r})"
