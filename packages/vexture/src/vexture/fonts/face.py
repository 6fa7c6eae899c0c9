"""One face of a font: its names, metrics and outlines, in font units."""

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import about, read_bytes, start_of
from vexture.base.errors import SourceError
from vexture.drawing.paint import Color
from vexture.fonts.engine import harfbuzz
from vexture.fonts.files import DESCRIBING, is_sfnt, sfnt_of
from vexture.fonts.layers import GlyphLayers, glyph_layers
from vexture.fonts.places import NO_FILE

FAMILY_NAMES: Final = (16, 21, 1)
"""Name IDs of the family, in order of preference: typographic, WWS (weight, width, slope), legacy."""

VERTICAL: Final = frozenset({"vmtx", "VORG"})
"""Tables that place the glyphs of vertical text."""

OWN: Final = frozenset({4, 6})
"""Name IDs of a single face: full name and PostScript name."""

RAISED: Final = 250
"""Smallest usable weight class: older Windows emboldened smaller ones, so that light fonts state this one instead."""

LIGHTEST: Final = {"thin": 100, "hairline": 100, "extralight": 200, "ultralight": 200}
"""True weights of such fonts, by the start of the style in their PostScript names."""

POSTSCRIPT: Final = 6
"""Name ID of the PostScript name."""

MOST_FACES: Final = 1000
"""Most faces that are read from a collection."""

Contours = tuple[NDArray[np.float64], ...]


@dataclass(frozen=True, eq=False)
class Face:
    """A face of a font; if the font is variable, with values for its axes.

    All lengths are in font units, y up; `units_per_em` of them make an em.

    Parameters
    ----------
    blob : uharfbuzz.Blob
        A TrueType or OpenType font, or a collection; `faces_in` and `faces_of` make it from bytes and from files.
    index : int
        Index in the collection.
    variations : tuple of (str, float)
        Values on the axes of a variable font, such as ``("wght", 700)``; other axes keep their defaults.
    ranges : tuple of (int, int)
        First and last characters of the ranges that the face may be used for; if empty, all of its characters.
    load : callable, optional
        Function that returns the whole font, if `blob` holds only the tables that describe it.

    Raises
    ------
    SourceError
        If it is not a font. Damage in other tables is found only when a glyph is first used.
    DeviceError
        If uharfbuzz is not installed.
    """

    blob: Any
    index: int = 0
    variations: tuple[tuple[str, float], ...] = ()
    ranges: tuple[tuple[int, int], ...] = ()
    load: Callable[[], Any] | None = None

    def __post_init__(self) -> None:
        if not self.glyph_count:
            raise SourceError("the font is damaged: it has no glyphs; save it again")

    @cached_property
    def _font(self) -> Any:
        """Complete font."""
        return self._described_font if self.load is None else self._font_of(self.load())

    @cached_property
    def _described_font(self) -> Any:
        """Font that may contain only the tables that describe it."""
        return self._font_of(self.blob)

    def _font_of(self, blob: Any) -> Any:
        hb = harfbuzz()
        font = hb.Font(hb.Face(blob, self.index))
        if self.variations:
            font.set_variations(dict(self.variations))
        return font

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the family in all languages, starting with `family`."""
        face = self._described_font.face
        entries = {(entry.name_id, entry.language) for entry in face.list_names()}
        english = [face.get_name(number) for number in FAMILY_NAMES if any(number == known for known, _ in entries)]
        others = [face.get_name(number, language) for number, language in sorted(entries) if number in FAMILY_NAMES]
        return tuple(dict.fromkeys(name for name in (*english, *others) if name))

    @cached_property
    def full_names(self) -> frozenset[str]:
        """Full and PostScript names, which no other face of the family shares."""
        face = self._described_font.face
        found = (face.get_name(entry.name_id, entry.language) for entry in face.list_names() if entry.name_id in OWN)
        return frozenset(name.casefold() for name in found if name)

    @property
    def family(self) -> str:
        """Name of the family, in English if there is one; ``unnamed`` if there is none."""
        return self.names[0] if self.names else "unnamed"

    @cached_property
    def weight(self) -> int:
        """CSS weight, 1 to 1000: 400 is regular, 700 bold."""
        said = min(max(round(self._style("WEIGHT")), 1), 1000)
        if said == RAISED and not self.axes:
            style = (self._described_font.face.get_name(POSTSCRIPT) or "").partition("-")[2].casefold()
            return next((weight for start, weight in LIGHTEST.items() if style.startswith(start)), said)
        return said

    @cached_property
    def stretch(self) -> float:
        """Width as a percentage of the normal width."""
        return float(self._style("WIDTH"))

    @cached_property
    def style(self) -> str:
        """``"normal"``, ``"italic"`` or ``"oblique"``."""
        if self._style("ITALIC") > 0.0:
            return "italic"
        return "oblique" if self._style("SLANT_ANGLE") != 0.0 else "normal"

    def _style(self, name: str) -> float:
        value: float = self._described_font.get_style_value(harfbuzz().StyleTag[name])
        return value

    @cached_property
    def axes(self) -> dict[str, tuple[float, float]]:
        """Least and greatest value on each axis of a variable font."""
        return {axis.tag: (axis.min_value, axis.max_value) for axis in self._described_font.face.axis_infos}

    @property
    def units_per_em(self) -> int:
        """Font units in an em."""
        return int(self._described_font.face.upem)

    @property
    def ascender(self) -> float:
        """Height of a line above the baseline."""
        return self._metric("HORIZONTAL_ASCENDER")

    @property
    def descender(self) -> float:
        """Depth of a line below the baseline, as a negative number."""
        return self._metric("HORIZONTAL_DESCENDER")

    @property
    def line_gap(self) -> float:
        """Additional distance between lines."""
        return self._metric("HORIZONTAL_LINE_GAP")

    @property
    def x_height(self) -> float:
        """Height of an x; measured from the glyph if the font does not state it."""
        return self._metric("X_HEIGHT")

    @property
    def cap_height(self) -> float:
        """Height of an H; measured from the glyph if the font does not state it."""
        return self._metric("CAP_HEIGHT")

    @property
    def underline(self) -> tuple[float, float]:
        """Position of the middle of the underline, and its thickness."""
        return self._metric("UNDERLINE_OFFSET"), self._metric("UNDERLINE_SIZE")

    @property
    def strikeout(self) -> tuple[float, float]:
        """Position of the middle of the strikeout line, and its thickness."""
        return self._metric("STRIKEOUT_OFFSET"), self._metric("STRIKEOUT_SIZE")

    @property
    def shifts(self) -> tuple[float, float]:
        """Baselines of subscripts (negative) and of superscripts."""
        return -self._metric("SUBSCRIPT_EM_Y_OFFSET"), self._metric("SUPERSCRIPT_EM_Y_OFFSET")

    @property
    def vertical(self) -> tuple[float, float]:
        """Ascender and descender of vertical lines: the distances to the right and left of their middle."""
        return self._metric("VERTICAL_ASCENDER"), self._metric("VERTICAL_DESCENDER")

    def _metric(self, name: str) -> float:
        tag = harfbuzz().OTMetricsTag[name]
        return float(self._font.get_metric_position_with_fallback(tag))

    def has(self, codepoint: int) -> bool:
        """Return whether the face has a glyph for a character, and may be used for it."""
        if self.ranges and not any(first <= codepoint <= last for first, last in self.ranges):
            return False
        return self._described_font.get_nominal_glyph(codepoint) is not None

    @cached_property
    def characters(self) -> frozenset[int]:
        """Codes of the characters in the face's table. In a symbol font, `has` is true for further ones, too."""
        return frozenset(self._described_font.face.unicodes)

    def vertical_offset(self, glyph: int) -> float:
        """Return the correction to HarfBuzz's position of a glyph in vertical text.

        In a font without vertical metrics, HarfBuzz centres each glyph in its cell. Browsers place all glyphs of such a
        font at the same baseline, the ascent below the top, so that letters are evenly spaced.
        """
        if self._has_vertical:
            return 0.0
        return float(self._font.get_glyph_v_origin(glyph)[1]) - self.ascender

    @cached_property
    def _has_vertical(self) -> bool:
        """True if the font contains positions for vertical text."""
        return not VERTICAL.isdisjoint(self._font.face.table_tags)

    @property
    def glyph_count(self) -> int:
        """Number of glyphs."""
        return int(self._described_font.face.glyph_count)

    def outline(self, glyph: int) -> tuple[NDArray[np.float64], ...]:
        """Return the closed contours (n, 4, 2) of a glyph, filled by the nonzero rule; none if it is empty."""
        if glyph not in self._outlines:
            self._outlines[glyph] = glyph_outline(self._font, glyph)
        return self._outlines[glyph]

    @cached_property
    def _outlines(self) -> dict[int, tuple[NDArray[np.float64], ...]]:
        return {}

    def missing(self, glyph: int) -> str:
        """Return the text of a note if HarfBuzz cannot draw a glyph, which then has a box but no outline; else "".

        HarfBuzz does not draw glyphs that contain themselves, or that are composed of too many others.
        """
        if self.outline(glyph) or self._in_colour:
            return ""
        box = self._font.get_glyph_extents(glyph)
        if box is None or not (box.width and box.height):
            return ""
        return f"glyph {glyph} of font {self.family[:40]!r}, which is composed of itself or of too many others"

    def layers(self, glyph: int, foreground: Color = (0.0, 0.0, 0.0)) -> GlyphLayers | None:
        """Return the layers of a colour glyph; None for others. `foreground` is the text's own colour."""
        return glyph_layers(self._font, glyph, self.outline, foreground) if self._in_colour else None

    @cached_property
    def _in_colour(self) -> bool:
        """True if the face may have colour glyphs."""
        face = self._font.face
        return bool(face.has_color_paint or face.has_color_layers or face.has_color_svg or face.has_color_png)

    def with_style(self, weight: float, stretch: float, style: str) -> "Face":
        """Return the face at the axis values nearest to a style; the face itself if it has no such axes."""
        slant = {"italic": ("ital", 1.0), "oblique": ("slnt", -14.0)}
        targets = dict([("wght", weight), ("wdth", stretch), *([slant[style]] if style in slant else [])])
        if style == "italic" and "ital" not in self.axes:
            targets["slnt"] = slant["oblique"][1]
        places = {
            tag: min(max(value, low), high)
            for tag, value in targets.items()
            for low, high in [self.axes.get(tag, (None, None))]
            if low is not None and high is not None
        }
        return replace(self, variations=tuple(sorted(places.items()))) if places else self


def faces_in(content: bytes) -> list[Face]:
    """Return all faces in the content of a font file or collection; raise as `sfnt_of` does."""
    return _all_faces(harfbuzz().Blob(sfnt_of(content)))


def faces_of(path: Path) -> list[Face]:
    """Return all faces of a font file, which is read only as far as needed; raise as `faces_in` does."""
    if not path.is_file():  # opening a pipe would block
        raise SourceError(NO_FILE)
    start = start_of(path)
    if is_sfnt(start):
        return _all_faces(harfbuzz().Blob.from_file_path(os.fspath(path)))
    content = read_bytes(path)

    @cache
    def load() -> Any:
        with about(os.fspath(path)):
            return harfbuzz().Blob(sfnt_of(content))

    return _all_faces(harfbuzz().Blob(sfnt_of(content, DESCRIBING)), load)


def _all_faces(blob: Any, load: Callable[[], Any] | None = None) -> list[Face]:
    count = min(harfbuzz().Face(blob).count, MOST_FACES)
    if not count:
        raise SourceError("the font is damaged: it has no faces; save it again")
    return [Face(blob, index, load=load) for index in range(count)]


def glyph_outline(font: Any, glyph: int) -> Contours:
    """Return the closed contours (n, 4, 2) of a glyph in font units, y up, filled by the nonzero rule."""
    pen = OutlinePen()
    font.draw_glyph(glyph, draw_funcs(), pen)
    return tuple(np.array(points, dtype=np.float64).reshape(-1, 4, 2) for points in pen.contours if points)


class OutlinePen:
    """Pen that collects P0 to P3 of cubics, one flat list for each contour; HarfBuzz closes contours with lines."""

    def __init__(self) -> None:
        self.contours: list[list[float]] = []
        self.at = (0.0, 0.0)

    def move(self, x: float, y: float) -> None:
        """Start a contour."""
        self.contours.append([])
        self.at = (x, y)

    def line(self, x: float, y: float) -> None:
        """Add a line."""
        (a, b), dx, dy = self.at, x - self.at[0], y - self.at[1]
        if dx or dy:
            self.cubic(a + dx / 3.0, b + dy / 3.0, a + dx * (2.0 / 3.0), b + dy * (2.0 / 3.0), x, y)

    def quadratic(self, u: float, v: float, x: float, y: float) -> None:
        """Add a quadratic curve, raised to a cubic."""
        a, b = self.at
        third = 2.0 / 3.0
        self.cubic(a + (u - a) * third, b + (v - b) * third, x + (u - x) * third, y + (v - y) * third, x, y)

    def cubic(self, *points: float) -> None:
        """Add a cubic from its last three points."""
        self.contours[-1] += (*self.at, *points)
        self.at = points[4], points[5]


@cache
def draw_funcs() -> Any:
    """Return the callbacks by which HarfBuzz draws with an `OutlinePen`."""
    funcs = harfbuzz().DrawFuncs()
    funcs.set_move_to_func(lambda x, y, pen: pen.move(x, y))
    funcs.set_line_to_func(lambda x, y, pen: pen.line(x, y))
    funcs.set_quadratic_to_func(lambda u, v, x, y, pen: pen.quadratic(u, v, x, y))
    funcs.set_cubic_to_func(lambda a, b, c, d, x, y, pen: pen.cubic(a, b, c, d, x, y))
    return funcs
