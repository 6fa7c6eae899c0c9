"""The characters of a text element, their elements, and the positions in attributes (SVG 2, 11.4)."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Final, Protocol
from unicodedata import category

from lxml import etree

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError
from vexture.drawing.group import Blend
from vexture.svg.animations import ANIMATIONS
from vexture.svg.compositing import Veil
from vexture.svg.document import applies, language, local_name
from vexture.svg.links import reference
from vexture.svg.masks import MeasuredScene
from vexture.svg.names import ElementNames
from vexture.svg.properties import BLENDS
from vexture.svg.report import describe_element
from vexture.svg.space import ElementPlace
from vexture.svg.style import ElementStyle
from vexture.svg.text.track import Track, read_track
from vexture.svg.values import SEPARATOR, number

DOTTED: Final = ("az", "tr")
"""Languages in which an i keeps its dot, or the lack of one, as a capital."""

PARTS: Final = frozenset({"a", "textPath", "tref", "tspan"})
"""Elements that contain characters of a text."""

SILENT: Final = ANIMATIONS | {"desc", "metadata", "script", "style", "title"}
"""Elements in a text that show nothing; animations and scripts have a note for the whole document."""

MOST_CHARACTERS: Final = 200_000
"""Most characters and elements of all texts; each display by `use` or a clip, and each measuring of a box, counts
again."""

APOSTROPHES: Final = "'\u2019"
"""Characters that do not end a word."""

SIGMA, FINAL_SIGMA = "\u03a3", "\u03c2"
"""The only letter with another form at the end of a word (Unicode, SpecialCasing)."""

JOINING: Final = frozenset({"Mn", "Mc", "Me", "Pc"})
"""Categories of characters in words besides letters and digits (Unicode Annex 29): marks, and _."""

PRESERVED: Final = frozenset({"pre", "pre-wrap", "break-spaces"})
"""Values of `white-space` that keep spaces."""

FLOWED: Final = ("inline-size", "shape-inside")
"""Properties that break a text into lines (SVG 2, 11.4), which no browser supports."""

WHOLE: Final = ("clip-path", "filter", "mask")
"""Properties of whole texts, which some browsers also apply to parts of them."""

POSITIONED: Final = frozenset({"text", "tref", "tspan"})
"""Elements that position single characters."""


class TextScene(MeasuredScene, Protocol):
    """The part of a scene that texts need."""

    names: ElementNames
    chosen: set[etree._Element] | None


@dataclass(slots=True, eq=False)
class Span:
    """An element of a text, with the range of its characters."""

    place: ElementPlace  # inside it, with its style and name
    outer: "Span | None"
    start: int
    end: int = 0
    track: Track | None = None  # path that its characters follow
    afresh: bool = False  # True if it starts or ends a path, so that its neighbours do not continue it

    @property
    def element(self) -> etree._Element:
        """Element of the span."""
        assert self.place.element is not None
        return self.place.element

    @property
    def around(self) -> "Iterator[Span]":
        """The span and those around it, the innermost first."""
        span: Span | None = self
        while span is not None:
            yield span
            span = span.outer


@dataclass(slots=True, eq=False)
class Characters:
    """The characters of a text that attributes can address; spans are in document order."""

    text: list[str] = field(default_factory=list)  # each after `text-transform`: one character or more
    holders: list[Span] = field(default_factory=list)  # innermost span of each
    spans: list[Span] = field(default_factory=list)
    x: dict[int, float] = field(default_factory=dict)
    y: dict[int, float] = field(default_factory=dict)
    dx: dict[int, float] = field(default_factory=dict)
    dy: dict[int, float] = field(default_factory=dict)
    rotate: dict[int, float] = field(default_factory=dict)  # degrees
    count: int = 0  # characters and elements in all texts so far
    after_space: bool = True  # True if following white space collapses

    def add(self, text: str, span: Span) -> None:
        """Add the text of a span, without collapsed white space (CSS Text 3, 4.1)."""
        style = span.place.style
        preserved = style["white-space"].lower() in PRESERVED
        transform = style["text-transform"].lower()
        dotted = transform != "none" and (language(span.element) or "").lower().partition("-")[0] in DOTTED
        for at, character in enumerate(text):
            if character in " \t\n\r":
                if self.after_space and not preserved:
                    continue
                self.after_space = not preserved
                character = " "
            else:
                goes_on = text[at + 1 : at + 2].isalpha()
                character = transform_character(character, transform, self.in_word(), goes_on, dotted)
                self.after_space = False
            self.text.append(character)
            self.holders.append(span)
            self.add_one()

    def in_word(self) -> bool:
        """Return whether a following letter continues a word; apostrophes and marks in a word belong to it."""
        before = [characters[-1] for characters in self.text[-2:]]
        if before and before[-1] in APOSTROPHES:
            before.pop()
        return bool(before) and (before[-1].isalnum() or category(before[-1]) in JOINING)

    def add_one(self) -> None:
        """Count a character or an element; raise a `SourceError` if there are too many."""
        self.count += 1
        if self.count > MOST_CHARACTERS:
            raise SourceError(f"texts have more than {MOST_CHARACTERS:,} characters; draw less text, or as outlines")

    def finish(self) -> None:
        """Remove white space at the end, and adjust the spans."""
        if self.text and self.after_space:
            del self.text[-1], self.holders[-1]
        for span in self.spans:
            span.start, span.end = min(span.start, len(self.text)), min(span.end, len(self.text))

    def starts_chunk(self, at: int) -> bool:
        """Return whether a character has its own position, so that it starts an anchored chunk."""
        return at == 0 or at in self.x or at in self.y or (self.holders[at].track is not self.holders[at - 1].track)


def transform_character(character: str, mode: str, in_word: bool, goes_on: bool, dotted: bool = False) -> str:
    """Apply `text-transform` to a character, such as SS of ß.

    `in_word` is True if a word continues with it, `goes_on` if a letter follows, and `dotted` for a language of
    `DOTTED`.

    Examples
    --------
    >>> transform_character("ß", "uppercase", True, True), transform_character("ǆ", "capitalize", False, True)
    ('SS', 'ǅ')
    >>> transform_character("Σ", "lowercase", True, False), transform_character("Σ", "lowercase", True, True)
    ('ς', 'σ')
    """
    if dotted and (mode == "uppercase" or (mode == "capitalize" and not in_word)) and character == "i":
        return "İ"
    if dotted and mode == "lowercase" and character in "Iİ":
        return "ı" if character == "I" else "i"
    if mode == "uppercase":
        return character.upper()
    if mode == "lowercase":
        return FINAL_SIGMA if character == SIGMA and in_word and not goes_on else character.lower()
    return character.title() if mode == "capitalize" and not in_word else character


def characters(scene: TextScene, element: etree._Element, place: ElementPlace, count: int) -> Characters:
    """Return the characters of a text element at a place with its style; `count` is the number before."""
    found = Characters(count=count)
    read(scene, found, Span(replace(place, element=element), None, 0))
    found.finish()
    for span in found.spans:
        if local_name(span.element) in POSITIONED:
            position(scene, found, span)
    return found


def read(scene: TextScene, found: Characters, span: Span) -> None:
    """Add the characters of a span."""
    check_time()
    element = span.element
    note_ignored(scene, span)
    found.spans.append(span)
    found.add_one()
    is_reference = local_name(element) == "tref"
    found.add(referenced_text(scene, element) if is_reference else element.text or "", span)
    for child in () if is_reference else element:
        name = local_name(child)
        if name in PARTS and applies(child):
            inner = part(scene, child, span, len(found.text))
            if inner is not None:
                read(scene, found, inner)
        elif name is not None and name not in SILENT and applies(child):
            scene.report.left_out(f"<{name[:40]}> in a text", child)
        found.add(child.tail or "", span)
    span.end = len(found.text)


def referenced_text(scene: TextScene, element: etree._Element) -> str:
    """Return all characters of the element that a `tref` refers to (SVG 1.1, 10.6)."""
    link = reference(element) or ""
    target = scene.servers.target(link)
    if target is None:
        scene.report.left_out(f"<tref> of '{link[:40]}'", element)
        return ""
    return str(target.xpath("string()"))


def note_ignored(scene: TextScene, span: Span) -> None:
    """Note properties of an element that have no effect on its characters."""
    style, outer = span.place.style, None if span.outer is None else span.outer.place.style
    kerning = style["kerning"]
    if kerning.lower() != "auto" and (outer is None or outer["kerning"] != kerning):
        scene.report.left_out(f"kerning {kerning[:40]}", span.element)
    shadow = style["text-shadow"]
    if shadow.lower() != "none" and (outer is None or outer["text-shadow"] != shadow):
        scene.report.left_out("text-shadow", span.element)
    if style["text-transform"].lower() == "full-width" and (outer is None or outer["text-transform"] != "full-width"):
        scene.report.left_out("text-transform full-width", span.element)
    for name in FLOWED if outer is None else ():
        if style[name].lower() not in ("auto", "none", "0"):
            scene.report.left_out(f"{name} of a text", span.element)
    for name in WHOLE if outer is not None else ():
        if style[name].lower() != "none":
            scene.report.left_out(f"{name} of a <{local_name(span.element)}>", span.element)
    if outer is None and style["writing-mode"].lower() == "sideways-lr":
        scene.report.simplification("writing-mode sideways-lr drawn as sideways-rl", span.element)


def part(scene: TextScene, element: etree._Element, outer: Span, start: int) -> Span | None:
    """Return the span of an element in a text; None if it shows nothing."""
    style = scene.cascade.style(element, outer.place.style)
    if style["display"].lower() == "none":
        return None
    called, is_instance = outer.place.named(scene.names.of(element), False)
    chosen = outer.place.chosen or (scene.chosen is not None and element in scene.chosen)
    place = replace(
        outer.place,
        style=style,
        element=element,
        outer=outer.place,
        depth=outer.place.depth + 1,
        name=called,
        is_instance=is_instance,
        chosen=chosen,
        veil=part_veil(style, outer.place),
    )
    track = outer.track
    if local_name(element) == "textPath":
        if any(local_name(span.element) not in ("a", "text") for span in outer.around):
            scene.report.left_out(f"{describe_element(element)}, which is not a child of <text>", element)
            return None
        track = read_track(scene, element, place)
        if track is None:
            return None
    return Span(place, outer, start, track=track)


def part_veil(style: ElementStyle, around: ElementPlace) -> Veil | None:
    """Return the veil of a part of a text, composited as in browsers: without clips, masks and filters."""
    opacity, blend = style.opacity("opacity"), BLENDS[style["mix-blend-mode"].lower()]
    if around.is_clip or (opacity == 1.0 and blend is Blend.NORMAL):
        return around.veil
    return Veil(around.veil, opacity, blend)


def position(scene: TextScene, found: Characters, span: Span) -> None:
    """Read the positions that an element gives to its characters; inner elements override them later."""
    view, font_size = span.place.viewport, span.place.style.font_size
    for name, places, whole in (
        ("x", found.x, view.width),
        ("y", found.y, view.height),
        ("dx", found.dx, view.width),
        ("dy", found.dy, view.height),
    ):
        text = span.element.get(name, "").strip()
        if text:
            lengths = [view.length(part, whole, font_size) for part in SEPARATOR.split(text, span.end - span.start)]
            read_list(scene, span, name, lengths, places)
    text = span.element.get("rotate", "").strip()
    if text:
        turns = [number(part) for part in SEPARATOR.split(text, span.end - span.start)][: span.end - span.start]
        if None not in turns and turns:  # the last value applies to all further characters (SVG 2, 11.4)
            turns += turns[-1:] * (span.end - span.start - len(turns))
        read_list(scene, span, "rotate", turns, found.rotate)


def read_list(scene: TextScene, span: Span, name: str, values: list[float | None], places: dict[int, float]) -> None:
    """Assign the values of a list to the characters of a span."""
    values = values[: span.end - span.start]
    if None in values:
        scene.report.invalid(name, span.element.get(name, ""), span.element)
        return
    places.update((span.start + k, value) for k, value in enumerate(values) if value is not None)
