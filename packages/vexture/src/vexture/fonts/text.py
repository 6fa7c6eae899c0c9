"""Drawings of text."""

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Final, Literal, TypeAlias

import numpy as np

from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, ParameterError, SourceError, shorten_text
from vexture.base.notes import Note, Notes, warn_of
from vexture.bezier.bounds import bounds
from vexture.drawing.affine import Affine
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Group
from vexture.drawing.paint import BLACK, Paint
from vexture.fonts.layers import GlyphLayers
from vexture.fonts.library import GENERIC, Fonts
from vexture.fonts.lines import FaceChoice, Placed, Typesetting, is_seen, line_of_glyphs
from vexture.fonts.matching import NORMAL_STRETCH
from vexture.fonts.places import font_places

Places: TypeAlias = "str | os.PathLike[str] | Sequence[str | os.PathLike[str]]"
"""One or several font files or folders of fonts."""

Box: TypeAlias = tuple[float, float, float, float]

MOST_PARTS: Final = 5_000_000
"""Most cubics and groups of a text; a glyph of a colour font may have 10,000."""

MOST_CHARACTERS: Final = 100_000

LARGEST: Final = 1e9
"""Largest size, width in percent and line height; beyond it, float64 has no digits left for curves."""

LONGEST_NAME: Final = 60
"""Longest name, in characters, that a drawing takes from its text."""

ALIGN: Final = {"start": 0.0, "center": 0.5, "end": 1.0}
"""Fraction of a line's free space before its start."""

BLANKS: Final = {ord("\t"): " "} | dict.fromkeys((*range(9), *range(11, 32), 127))
"""Replacements of control characters: a tab becomes a space; others vanish."""


@dataclass(frozen=True, slots=True)
class TextOptions:
    """Options for drawing a text; see `text`."""

    font: Places = ()
    family: str | Sequence[str] = ()
    weight: float = 400
    style: str = "normal"
    stretch: float = 100.0
    size: float = 1.0
    features: Sequence[str] = ()
    direction: str = "auto"
    language: str | None = None
    align: str = "start"
    line_height: float | None = None
    paint: Paint = BLACK
    name: str | None = None

    def __post_init__(self) -> None:
        font_places(self.font, "font")
        if isinstance(self.features, str) or not all(isinstance(feature, str) for feature in self.features):
            raise ParameterError(f"`features` is {self.features!r:.80}; it must be several, as ['smcp', '-liga']")
        for name, known in (
            ("style", ("normal", "italic", "oblique")),
            ("direction", ("auto", "ltr", "rtl")),
            ("align", tuple(ALIGN)),
        ):
            if getattr(self, name) not in known:
                raise ParameterError(f"`{name}` is {getattr(self, name)!r}; it must be {', '.join(known)}")
        if not (isinstance(self.weight, int | float) and 1.0 <= self.weight <= 1000.0):
            raise ParameterError(f"`weight` is {format_value(self.weight)}; it must be 1 to 1000")
        given = {"size": self.size, "stretch": self.stretch}
        if self.line_height is not None:
            given["line_height"] = self.line_height
        for name, value in given.items():
            if not (isinstance(value, int | float) and 0.0 < value < LARGEST):
                raise ParameterError(f"`{name}` is {format_value(value)}; it must be above 0 and below {LARGEST:g}")
        if not isinstance(self.paint, Paint):
            raise ParameterError(f"`paint` is {self.paint!r}; it must be a Paint, such as Paint((1.0, 0.0, 0.0))")

    @property
    def families(self) -> list[str]:
        """Names of the families in order of preference."""
        return [self.family] if isinstance(self.family, str) else [*self.family]

    def choice(self, notes: Notes, characters: Iterable[str]) -> FaceChoice:
        """Return the available faces; note the requested properties that the first face lacks."""
        places = [self.font] if isinstance(self.font, str | os.PathLike) else [*self.font]
        fonts, request = Fonts(places), (self.families, round(self.weight), self.style, self.stretch)
        choice = FaceChoice(fonts.faces(*request, characters), notes, is_asked=bool(places or self.families))
        face = choice.first
        first = next(iter(self.families), face.family)
        if first.lower() not in GENERIC and first.casefold() not in {name.casefold() for name in face.names}:
            notes.simplification(f"font {first!r} drawn in {face.family}")
        if self.style != "normal" and face.style == "normal":
            notes.simplification(f"{self.style} style, which {face.family} lacks, drawn upright")
        if file := fonts.substitute(*request):
            requested = style_of(round(self.weight), self.style, self.stretch)
            taken = f"{face.family}, {style_of(face.weight, face.style, face.stretch)}"
            choose = "choose another by `weight` and `style`, or give its file"
            notes.remark(f"no face has {requested}, so that {file.name} is used ({taken}); {choose}")
        return choice


def style_of(weight: int, style: str, stretch: float) -> str:
    """Describe a weight, a style and a width for a message; the normal width is left out.

    Examples
    --------
    >>> style_of(400, "normal", 100.0), style_of(700, "italic", 75.0)
    ('weight 400, normal', 'weight 700, italic, stretch 75')
    """
    return f"weight {weight}, {style}" + ("" if stretch == NORMAL_STRETCH else f", stretch {stretch:g}")


def format_value(value: object) -> str:
    """Format a value for a message."""
    return f"{value:g}" if isinstance(value, int | float) else repr(value)


def text(
    text: str,
    *,
    font: Places = (),
    family: str | Sequence[str] = (),
    weight: float = 400,
    style: str = "normal",
    stretch: float = 100.0,
    size: float = 1.0,
    features: Sequence[str] = (),
    direction: Literal["auto", "ltr", "rtl"] = "auto",
    language: str | None = None,
    align: Literal["start", "center", "end"] = "start",
    line_height: float | None = None,
    paint: Paint = BLACK,
    name: str | None = None,
) -> Drawing:
    """Draw a text: shaped and kerned, in any script, with the colours of a colour font.

    Parameters
    ----------
    text : str
        A word, or several lines separated by newlines.
    font : path or sequence of path
        Font files (TrueType, OpenType, WOFF, WOFF2) and folders of font files. They take precedence over the default
        font, Noto Sans, and the fonts of the system.
    family : str or sequence of str
        Family names in order of preference, as in CSS, or generic names such as ``"serif"``; by default the first
        family of `font`. A character that they lack is drawn in the first other font that has it.
    weight, style, stretch : float, {"normal", "italic", "oblique"}, float
        Style of the face, as in CSS: weight 1 to 1000, with 700 for bold; stretch is the width in percent.
    size : float
        Size of an em in units of the source. `Drawing.to_source` leads to these units: y down, with the origin at the
        left end of the first baseline.
    features : sequence of str
        OpenType features: ``"smcp"`` switches on, ``"-liga"`` off; ``"salt=2"`` selects an alternative.
    direction : {"auto", "ltr", "rtl"}
        Direction of the whole text; by default the direction of its first letter.
    language : str, optional
        BCP 47 tag, such as ``"nl"``, for fonts with letters that depend on the language.
    align : {"start", "center", "end"}
        Alignment of lines, in the direction of the text.
    line_height : float, optional
        Distance between baselines in ems; by default that of the font.
    paint : Paint
        Paint of the text, except for the colours of a colour font.
    name : str, optional
        By default the text, or its start if it has more than 60 characters.

    Returns
    -------
    Drawing
        Its box contains the lines, each from the font's ascender to its descender, and all glyphs that extend beyond
        them. A path's `element` is the characters that it draws. Its `notes` name missing characters and fonts, with
        their replacements.

    Raises
    ------
    SourceError
        If a font cannot be read, there is no font, or none has any character of the text.
    ParameterError
        If a parameter is out of range.
    LimitError
        If the text is too long.
    DeviceError
        If ``vexture[text]`` is not installed.

    Warns
    -----
    SourceWarning
        Once, with all notes.

    Examples
    --------
    >>> drawing = text("Harbour")
    >>> [path.element for path in drawing.paths]
    ['H', 'a', 'r', 'b', 'o', 'u', 'r']
    """
    options = TextOptions(
        font, family, weight, style, stretch, size, features, direction, language, align, line_height, paint, name
    )
    drawing = text_drawing(text, options)
    warn_of(drawing.name, drawing.notes)
    return drawing


def text_drawing(text: str, options: TextOptions) -> Drawing:
    """Draw as `text` does, but without a warning."""
    if not isinstance(text, str):
        raise ParameterError(f"`text` is {text!r}; it must be text")
    if len(text) > MOST_CHARACTERS:
        raise LimitError(f"`text` has {len(text):,} characters, of at most {MOST_CHARACTERS:,}; draw it in parts")
    notes = Notes()
    choice = options.choice(notes, text)
    base = base_level(text, options.direction)
    setting = Typesetting(base, options.language, options.features)
    lines = [line_of_glyphs(line.translate(BLANKS), choice, setting) for line in text.splitlines() or [""]]
    if (seen := [*dict.fromkeys(filter(is_seen, text))]) and notes.boxes.issuperset(seen):
        missing = shorten_text("".join(seen), LONGEST_NAME)
        raise SourceError(f"no font has any of the characters {missing!r}; give a `font` that has them")
    face, widest = choice.first, max(width for _, width in lines)
    high, low, gap = (part / face.units_per_em for part in (face.ascender, face.descender, face.line_gap))
    leading = high - low + gap if options.line_height is None else options.line_height
    part = 1.0 - ALIGN[options.align] if base else ALIGN[options.align]
    canvas = TextCanvas(options.size, options.paint, notes)
    for row, (glyphs, width) in enumerate(lines):
        for placed in glyphs:
            canvas.draw(placed, part * (widest - width), -row * leading)
    box = (0.0, -high * options.size, widest * options.size, ((len(lines) - 1) * leading - low) * options.size)
    return canvas.drawing(box, options.name or shorten_text(" ".join(text.split()), LONGEST_NAME) or "text")


def base_level(text: str, direction: str) -> int:
    """Return the embedding level of a whole text: that of a direction, or of its first letter."""
    if direction != "auto":
        return int(direction == "rtl")
    from fontTools.unicodedata import bidirectional

    kinds = (bidirectional(character) for character in text)
    return next((int(kind != "L") for kind in kinds if kind in ("L", "R", "AL")), 0)


class TextCanvas:
    """Canvas that collects glyphs as paths and groups, y down; an em is `size` units of the source."""

    def __init__(self, size: float, paint: Paint, notes: Notes) -> None:
        self.size = size
        self.paint = paint
        self.notes = notes
        self.paths: list[Path] = []
        self.groups: list[Group] = []
        self.parts = 0

    def draw(self, placed: Placed, x: float, y: float) -> None:
        """Draw a glyph of a line that starts at (x, y) in ems, y up."""
        check_time()
        face, glyph = placed.glyph.face, placed.glyph.glyph
        scale = self.size / face.units_per_em
        left, down = (placed.x + x) * self.size, -(placed.y + y) * self.size
        to_font: Affine = ((1.0 / scale, 0.0, -left / scale), (0.0, -1.0 / scale, down / scale))
        layers = face.layers(glyph, self.paint.color)
        paths = (Path(face.outline(glyph)),) if layers is None else layers.paths
        if layers is None and (missing := face.missing(glyph)):
            self.notes.left_out(missing)
        outer, start = (-1, 0) if layers is None else self._open_groups(layers)
        self.parts += len(self.groups) - start if layers else 0
        self.parts += sum(len(contour) for path in paths for contour in path.contours)
        if self.parts > MOST_PARTS:
            raise LimitError(f"`text` has more than {MOST_PARTS:,} segments and groups; draw it in parts")
        for path in paths:
            contours = tuple(contour * (scale, -scale) + (left, down) for contour in path.contours)
            paint = self.paint if layers is None else path.paint.after(to_font)
            group = start + path.group if path.group >= 0 else outer
            if contours:
                self.paths.append(replace(path, contours=contours, paint=paint, group=group, element=placed.text))

    def _open_groups(self, layers: GlyphLayers) -> tuple[int, int]:
        """Add the groups of a colour glyph; return the indices of the outermost, or -1, and of the glyph's first."""
        for note in layers.notes:
            self.notes.count(note.kind, note.message)
        outer = -1
        if self.paint.opacity < 1.0:
            outer = len(self.groups)
            self.groups.append(Group(opacity=self.paint.opacity))
        start = len(self.groups)
        self.groups += [
            replace(group, outer=start + group.outer if group.outer >= 0 else outer) for group in layers.groups
        ]
        return outer, start

    @property
    def painted_box(self) -> Box:
        """Box (left, top, right, bottom) of all paths, in units of the source; empty without paths."""
        if not self.paths:
            return inf, inf, -inf, -inf
        return bounds(np.concatenate([contour for path in self.paths for contour in path.contours]))

    def drawing(self, box: Box, name: str) -> Drawing:
        """Return the drawing; its box holds all paths and `box` (left, top, right, bottom), in units of the source."""
        if not self.paths:
            return Drawing((), name=name, notes=(*self.notes.in_order, Note("remark", "nothing in it is painted")))
        left, top = (min(pair) for pair in zip(box[:2], self.painted_box[:2], strict=True))
        right, bottom = (max(pair) for pair in zip(box[2:], self.painted_box[2:], strict=True))
        drawing = Drawing.from_source(self.paths, (left, top, right - left, bottom - top), name, tuple(self.groups))
        return replace(drawing, notes=self.notes.in_order)
