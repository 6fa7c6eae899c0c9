"""The painted parts of a text: outlines and colour glyphs, each with the style that paints it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.bezier.bounds import bounds
from vexture.fonts.layers import GlyphLayers
from vexture.svg.outline import ShapeOutline
from vexture.svg.report import Report
from vexture.svg.space import ElementPlace
from vexture.svg.strokes import Stroke, stroke_contours
from vexture.svg.text.baselines import extent
from vexture.svg.text.decorations import WORDS, Decoration, Member, decoration, line_outlines
from vexture.svg.text.layout import TextChunk
from vexture.svg.text.runs import GlyphCluster
from vexture.svg.text.tree import Span
from vexture.svg.transform import Identity, Transform, map_points

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
