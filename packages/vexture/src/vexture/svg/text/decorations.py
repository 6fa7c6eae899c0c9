"""Underlines, overlines and line-throughs of a text (CSS Text Decoration 4; SVG 2, 11.10)."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.colors import parse_color
from vexture.svg.outline import ShapeOutline
from vexture.svg.report import Report
from vexture.svg.space import ElementPlace
from vexture.svg.strokes import Stroke, stroke_contours
from vexture.svg.text.baselines import extent
from vexture.svg.text.runs import GlyphCluster
from vexture.svg.text.tree import Span
from vexture.svg.transform import Transform, map_points

WORDS: Final = ("underline", "overline", "line-through")
STYLES: Final = ("solid", "dashed", "dotted", "double", "wavy")

DECORATION: Final = ("text-decoration", "text-decoration-line", "text-decoration-style")
LOOK: Final = ("text-decoration-color", "text-decoration-thickness")
USUAL: Final = frozenset({*WORDS, *STYLES, "none", "blink", "auto", "from-font", "currentcolor"})
"""Words that need no note: lines, styles, and defaults such as the text's paint or the font's thickness."""

WORD = re.compile(r"[^\s(]+(?:\([^)]*\))?")

LONGEST: Final = 200
"""Longest value of a property that is read, in characters."""

DASHES: Final = {"dashed": (3.0, 2.0), "dotted": (0.0, 2.0)}
"""Lengths of dashes and gaps in line thicknesses; dashes of zero length have round caps."""

APART: Final = 2.0
"""Distance between the centres of a double line, in line thicknesses."""

TINY: Final = 1e-3
"""Length of a dot without its caps, in line thicknesses; a dash of zero length would have no direction."""

WAVE, HEIGHT = 6.0, 1.5
"""Length of a wave, and its height above the middle, in line thicknesses."""

MOST_PERIODS: Final = 2_000
"""Most dashes or waves along a line; with more they are invisible, and the line is plain."""

Member = tuple[GlyphCluster, Transform, bool]
"""A visible cluster, its matrix, and True if a line starts at it."""


@dataclass(frozen=True, slots=True, eq=False)
class Decoration:
    """Style of the lines of a span."""

    place: ElementPlace  # its style paints the lines
    style: str  # one of `STYLES`
    thickness: float | None  # user units; None for the font's own


def decoration(span: Span, word: str, report: Report) -> Decoration | None:
    """Return the style of a line of a span, from the nearest element that declares it; None without one.

    A line declared outside the text is painted like the text.
    """
    place: ElementPlace | None = span.place
    text = next(each for each in span.around if each.outer is None).place
    inside = True
    while place is not None:
        if word in words_of(place, DECORATION):
            own = replace(place if inside else text, name=span.place.name, chosen=True, veil=span.place.veil)
            return read_decoration(own, place, report)
        inside = inside and place is not text
        place = place.outer
    return None


def words_of(place: ElementPlace, properties: Sequence[str]) -> list[str]:
    """Return the words of some properties at a place; a function with its arguments is one word."""
    return WORD.findall(" ".join(place.style[name][:LONGEST] for name in properties).lower())


def read_decoration(target: ElementPlace, place: ElementPlace, report: Report) -> Decoration:
    """Return a decoration that is painted in one place, with the style that another place declares.

    A colour applies to the whole line, which then has no stroke.
    """
    style, thickness = STYLES[0], None
    unknown = []
    size = place.style.font_size
    for word in words_of(place, DECORATION) + words_of(place, LOOK):
        if word in STYLES[1:]:
            style = word
        elif word not in USUAL and parse_color(word) is not None:
            paint = {"fill": word, "fill-opacity": "1", "stroke": "none"}
            target = replace(target, style=replace(target.style, inherited=target.style.inherited | paint))
        elif word not in USUAL:
            length = place.viewport.length(word, size, size)
            thickness = length if length is not None and length > 0.0 else thickness
            if length is None:
                unknown.append(word)
    unknown += [word for word in words_of(place, ("text-underline-offset",)) if word not in USUAL]
    if unknown:
        what = f"text-decoration {' '.join(unknown)[:40]}"
        report.simplification(f"{what} drawn where and as the font says", place.element)
    return Decoration(target, style, thickness)


def line_outlines(members: Sequence[Member], word: str, decor: Decoration, vertical: bool) -> tuple[ShapeOutline, ...]:
    """Return the outlines of a kind of line along the clusters of a span."""
    outlines: list[ShapeOutline] = []
    begin: tuple[GlyphCluster, Transform] | None = None
    width = 0.0
    for cluster, matrix, begins in [*members, (None, None, True)]:
        if begins and begin is not None:
            outlines += line(begin[0], begin[1], width, word, decor, vertical)
        if cluster is None or matrix is None:
            break
        if begins:
            begin, width = (cluster, matrix), 0.0
        width += cluster.advance
    return tuple(outlines)


def line(
    cluster: GlyphCluster, matrix: Transform, width: float, word: str, decor: Decoration, vertical: bool
) -> list[ShapeOutline]:
    """Return the outlines of a line of a given width that starts at a cluster."""
    over, under = extent(cluster)
    position, usual = (part * cluster.scale for part in cluster.face.underline)
    thickness = usual if decor.thickness is None else decor.thickness
    if word == "overline":
        position = over
    elif word == "line-through":
        position = cluster.face.strikeout[0] * cluster.scale
    elif vertical:  # next to the characters, as in browsers, where no line crosses them
        position = -under
    if cluster.upright:  # the line stays in the direction of the text, whose origin is in the middle
        matrix, position = matrix.rotate(np.pi / 2.0), position - (over - under) / 2.0
    right = width / cluster.stretch
    contours = looks(decor, -position, right, thickness, word)
    return [ShapeOutline(map_points(contour, matrix), closed=True) for contour in contours]


def looks(decor: Decoration, y: float, right: float, thickness: float, word: str) -> list[NDArray[np.float64]]:
    """Return the contours of a line from 0 to the right; the second line of a double one is away from the text."""
    if right <= 0.0 or thickness <= 0.0:
        return []
    if decor.style == "double":
        first = {"underline": y, "overline": y - APART * thickness}.get(word, y - APART * thickness / 2.0)
        return [bar(right, first, thickness), bar(right, first + APART * thickness, thickness)]
    size = decor.place.viewport.diagonal
    period = {"wavy": WAVE}.get(decor.style, sum(DASHES.get(decor.style, ())))
    if right > MOST_PERIODS * period * thickness:
        return [bar(right, y, thickness)]
    if decor.style == "wavy":
        return stroke_contours([wave(right, y, thickness)], Stroke(thickness, join="round"), size)
    if decor.style in DASHES:
        dash, gap = (part * thickness for part in DASHES[decor.style])
        middle = ShapeOutline.polygon(np.array([(0.0, y), (right, y)]), closed=False)
        cap = "butt" if dash else "round"
        offset = 0.0 if dash else -thickness / 2.0
        stroke = Stroke(thickness, cap, dashes=(dash or thickness * TINY, gap), dash_offset=offset)
        return stroke_contours([middle], stroke, size)
    return [bar(right, y, thickness)]


def bar(right: float, y: float, thickness: float) -> NDArray[np.float64]:
    """Return the contour of a straight line, with half of its thickness on each side of a height."""
    return ShapeOutline.rectangle(0.0, y - thickness / 2.0, right, thickness).cubics


def wave(right: float, y: float, thickness: float) -> ShapeOutline:
    """Return as many half waves about a height as fit, the first one downwards."""
    count = max(1, round(right / (WAVE * thickness / 2.0)))
    ends = np.linspace(0.0, right, count + 1)
    signs = np.where(np.arange(count) % 2, -1.0, 1.0)
    arms = y + signs * HEIGHT * thickness * 4.0 / 3.0  # the middle of a cubic reaches 3/4 of the height of its arms
    middles = (ends[:-1] + ends[1:]) / 2.0
    flat = np.full(count, y)
    points = [(ends[:-1], flat), (middles, arms), (middles, arms), (ends[1:], flat)]
    return ShapeOutline(np.stack([np.stack(point, axis=1) for point in points], axis=1), closed=False)
