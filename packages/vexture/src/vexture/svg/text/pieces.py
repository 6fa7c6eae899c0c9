"""The painted parts of a text: outlines and colour glyphs, each with the style that paints it."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.bezier.bounds import bounds
from vexture.drawing.colors import parse_color
from vexture.fonts.layers import GlyphLayers
from vexture.svg.outline import ShapeOutline
from vexture.svg.report import Report
from vexture.svg.space import ElementPlace
from vexture.svg.strokes import Stroke, stroke_contours
from vexture.svg.text.baselines import extent
from vexture.svg.text.layout import TextChunk
from vexture.svg.text.runs import GlyphCluster
from vexture.svg.text.tree import Span
from vexture.svg.transform import Identity, Transform, map_points

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


EMBOLDENING: Final = ((9.0, 1 / 24), (36.0, 1 / 32))
"""Font sizes, each with the width by which Skia emboldens a face, as a fraction of the size."""


@dataclass(frozen=True, slots=True, eq=False)
class TextPiece:
    """Outlines, or a colour glyph, painted with the style of a place."""

    place: ElementPlace
    outlines: tuple[ShapeOutline, ...] = ()
    layers: GlyphLayers | None = None
    matrix: Transform = Identity  # from the layers to the units of the place


def pieces(chunks: Sequence[TextChunk], vertical: bool, report: Report) -> Iterator[TextPiece]:
    """Yield the painted parts of a text, in painting order (CSS Text Decoration 3, 2.4)."""
    for chunk in chunks:
        for span, held in members(chunk):
            check_time()
            if is_hidden(span):
                continue
            lines = {word: decoration(span, word, report) for word in WORDS}
            for word in WORDS[:2]:
                yield from line_pieces(held, word, lines[word], vertical)
            yield from glyph_pieces(span, held, report)
            yield from line_pieces(held, WORDS[2], lines[WORDS[2]], vertical)


def is_hidden(span: Span) -> bool:
    """Return whether a span paints nothing; in a clip, outlines count whatever their opacity."""
    place = span.place
    if place.style["visibility"].lower() != "visible" or not place.chosen:
        return True
    return not place.is_clip and any(around.place.style.opacity("opacity") == 0.0 for around in span.around)


def line_pieces(members: Sequence[Member], word: str, decor: Decoration | None, vertical: bool) -> Iterator[TextPiece]:
    """Yield the lines of a kind along the clusters of a span."""
    outlines = line_outlines(members, word, decor, vertical) if decor is not None else ()
    if decor is not None and outlines:
        yield TextPiece(decor.place, outlines)


def members(chunk: TextChunk) -> list[tuple[Span, list[Member]]]:
    """Return the runs of one element in a chunk, in logical order, with the clusters of each in visual order."""
    stretches: list[tuple[Span, list[Member]]] = []
    homes: dict[GlyphCluster, list[Member]] = {}
    for cluster in sorted(chunk.clusters, key=lambda one: one.start):
        if not stretches or stretches[-1][0] is not cluster.span:
            stretches.append((cluster.span, []))
        homes[cluster] = stretches[-1][1]
    before: list[Member] | None = None
    for cluster, matrix, moved in zip(chunk.clusters, chunk.matrices, chunk.moved, strict=True):
        if not cluster.hidden:
            homes[cluster].append((cluster, matrix, moved or before is not homes[cluster]))
        before = None if cluster.hidden else homes[cluster]
    return stretches


def glyph_pieces(span: Span, members: Sequence[Member], report: Report) -> Iterator[TextPiece]:
    """Yield the glyphs of a span: all outlines together, and each colour glyph by itself."""
    together: list[ShapeOutline] = []
    for cluster, matrix, _ in members:
        style = span.place.style
        color = (style.solid(style["fill"]) or style.color).rgb  # own colour in a colour font, as in browsers
        x = y = 0.0
        for glyph in cluster.glyphs:
            right, down = (x + glyph.offset[0]) * cluster.scale, -(y + glyph.offset[1]) * cluster.scale
            units = matrix.translate(right, down).transform(
                Transform(cluster.scale, 0.0, cluster.slant * cluster.scale, -cluster.scale, 0.0, 0.0)
            )
            x, y = x + glyph.advance[0], y + glyph.advance[1]
            layers = cluster.face.layers(glyph.glyph, color)
            if layers is not None and not span.place.is_clip:
                if together:
                    yield TextPiece(span.place, tuple(together))
                    together = []
                yield TextPiece(span.place, layers=layers, matrix=units)
                continue
            contours = list(cluster.face.outline(glyph.glyph))
            if not contours and (missing := cluster.face.missing(glyph.glyph)):
                report.left_out(missing, span.element)
            if cluster.bolder and contours:
                contours += bold_strokes(contours, cluster)
            together += [ShapeOutline(map_points(contour, units), closed=True) for contour in contours]
    if together:
        yield TextPiece(span.place, tuple(together))


def bold_strokes(contours: list[NDArray[np.float64]], cluster: GlyphCluster) -> list[NDArray[np.float64]]:
    """Return the strokes that embolden contours, in font units; they wind as the contours do."""
    em = cluster.face.units_per_em
    sizes, parts = zip(*EMBOLDENING, strict=True)
    width = em * float(np.interp(em * cluster.scale, sizes, parts))
    outlines = [ShapeOutline(contour, closed=True) for contour in contours]
    strokes = stroke_contours(outlines, Stroke(width, join="miter"), float(em))
    areas = [sum(map(turning, shapes)) for shapes in (contours, strokes)]
    return strokes if areas[0] * areas[1] > 0.0 else [stroke[::-1, ::-1] for stroke in strokes]


def turning(contour: NDArray[np.float64]) -> float:
    """Return the area of a contour's control polygon; its sign is the direction of winding."""
    (x0, y0), (x1, y1) = contour[:, :3].reshape(-1, 2).T, contour[:, 1:].reshape(-1, 2).T
    return float((x0 * y1 - x1 * y0).sum())


def cells(chunks: Sequence[TextChunk]) -> ShapeOutline | None:
    """Return the outline of the box around the cells of all glyphs (SVG 2, 11.10.3); None if there are none."""
    corners = []
    for chunk in chunks:
        for cluster, matrix in zip(chunk.clusters, chunk.matrices, strict=True):
            if not cluster.hidden:
                over, under = extent(cluster)
                right = cluster.width / cluster.stretch
                cell = np.array([(0.0, -over), (right, -over), (right, under), (0.0, under)])
                corners.append(map_points(cell, matrix))
    if not corners:
        return None
    points = np.concatenate(corners)
    left, top, right, bottom = bounds(np.repeat(points[:, None], 4, axis=1))
    return ShapeOutline.polygon(np.array([(left, top), (right, top), (right, bottom), (left, bottom)]), closed=True)
