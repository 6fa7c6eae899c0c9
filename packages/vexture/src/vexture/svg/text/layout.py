"""Positions of the clusters of a text (SVG 2, 11.5): spacing, `textLength`, anchored chunks, and paths."""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from math import pi, radians
from typing import Final

from vexture.fonts.levels import CURSIVE, visual_order
from vexture.svg.document import local_name
from vexture.svg.report import Report
from vexture.svg.style import ElementStyle
from vexture.svg.text.baselines import baseline
from vexture.svg.text.runs import GlyphCluster
from vexture.svg.text.track import Track
from vexture.svg.text.tree import Characters, Span
from vexture.svg.transform import Identity, Transform

SEPARATORS: Final = frozenset(" \u00a0\u1361\U00010100\U00010101\U0001039f\U0001091f")
"""Word separators (CSS Text 3, 7.1)."""

VERTICAL: Final = frozenset({"vertical-rl", "vertical-lr", "sideways-rl", "sideways-lr", "tb", "tb-rl", "tb-lr"})

FLATTEST: Final = 1e-3
"""Least width of squeezed glyphs, as a fraction of their own; a smaller `textLength` is ignored."""

ANCHORS: Final = {"start": 0.0, "middle": 0.5, "end": 1.0}


@dataclass(frozen=True, slots=True, eq=False)
class TextChunk:
    """Consecutive clusters that start at a position of their own, in visual order, with their positions.

    A cluster's matrix maps its own coordinates, with its origin at (0, 0), its advance along x and y down, to those of
    the text. `moved` is True for clusters that do not directly follow the one before.
    """

    clusters: tuple[GlyphCluster, ...]
    matrices: tuple[Transform, ...]
    moved: tuple[bool, ...]


def is_vertical(style: ElementStyle) -> bool:
    """Return whether a text runs from top to bottom."""
    return style["writing-mode"].lower() in VERTICAL


def lay_out(found: Characters, clusters: list[GlyphCluster], vertical: bool, report: Report) -> list[TextChunk]:
    """Return the chunks of a text with all clusters positioned; `clusters` are in logical order."""
    edges = {at for at in range(len(found.text)) if found.starts_chunk(at)}
    groups: list[list[GlyphCluster]] = []
    for cluster in clusters:
        if not groups or (cluster.start in edges and cluster.start != groups[-1][-1].start):
            groups.append([])
        groups[-1].append(cluster)
    for group in groups:
        space(found, group)
    fit(found, clusters, vertical, report)
    chunks, at = [], (0.0, 0.0)
    for group in groups:
        visual = [group[k] for k in visual_order([cluster.level for cluster in group])]
        chunk, at = chunk_of(found, group[0].start, visual, vertical, at)
        chunks.append(chunk)
    return chunks


def space(found: Characters, group: Sequence[GlyphCluster]) -> None:
    """Add `letter-spacing` and `word-spacing` to the clusters of a chunk, in logical order."""
    for cluster in group:
        style = cluster.span.place.style
        letter, word = (pixels(style[name]) for name in ("letter-spacing", "word-spacing"))
        separates = found.text[cluster.start] in SEPARATORS
        if (separates or cluster.script not in CURSIVE) and cluster is not group[-1]:
            cluster.advance += letter
        if separates:
            cluster.advance += word


def pixels(spacing: str) -> float:
    """Return the length of a spacing, which the cascade has converted to user units."""
    return 0.0 if spacing == "normal" else float(spacing)


def fit(found: Characters, clusters: Sequence[GlyphCluster], vertical: bool, report: Report) -> None:
    """Fit the clusters of each element with a `textLength` into it, the innermost elements first (SVG 2, 11.5)."""
    starts = [cluster.start for cluster in clusters]
    for span in reversed(found.spans):
        text = span.element.get("textLength")
        if text is None or local_name(span.element) == "a":
            continue
        place = span.place
        length = place.viewport.length(text, place.viewport.width, place.style.font_size)
        inside = clusters[bisect_left(starts, span.start) : bisect_left(starts, span.end)]
        if length is None or length < 0.0:
            report.invalid("textLength", text, span.element)
            continue
        if inside:
            fit_span(span, inside, length, found.dy if vertical else found.dx)


def fit_span(span: Span, inside: Sequence[GlyphCluster], length: float, shifts: dict[int, float]) -> None:
    """Fit clusters into a length; those already fitted for an inner element move together.

    As in browsers, there is also a gap after the last cluster, which an anchor ignores. `shifts` along the text, by
    character, count for the length, except that of the first cluster.
    """
    later = [at for at in range(inside[0].start + 1, inside[-1].start + 1) if at in shifts]
    width = sum(cluster.advance for cluster in inside) + sum(shifts[at] for at in later)
    if length == 0.0:  # browsers ignore it
        return
    if span.element.get("lengthAdjust", "").strip() == "spacingAndGlyphs":
        factor = length / width if length > FLATTEST * width > 0.0 else 1.0
        for cluster in inside:
            cluster.stretch *= factor
            cluster.advance *= factor
            cluster.width *= factor
        for at in later:
            shifts[at] *= factor
        return
    loose = [
        cluster for cluster, after in pairwise(inside) if cluster.fitted is None or cluster.fitted is not after.fitted
    ]
    for cluster in loose and [*loose, inside[-1]]:
        cluster.gap = (length - width) / len(loose)
        cluster.advance += cluster.gap
    for cluster in inside:
        cluster.fitted = span


def chunk_of(
    found: Characters, first: int, visual: Sequence[GlyphCluster], vertical: bool, at: tuple[float, float]
) -> tuple[TextChunk, tuple[float, float]]:
    """Return the chunk of clusters in visual order that starts at a character, and the position after it, from `at`."""
    style, track = found.holders[first].place.style, found.holders[first].track
    steps = shifts(found, visual, vertical)
    length = sum(cluster.advance for cluster in visual) - visual[-1].gap + sum(step[vertical] for step in steps[1:-1])
    part = ANCHORS[style["text-anchor"].lower()]
    if style["direction"].lower() == "rtl":
        part = 1.0 - part
    if track is not None:
        begin = (found.y if vertical else found.x).get(first, 0.0)
        return on_track(found, visual, vertical, track, track.start + begin - part * length)
    origin = found.x.get(first, at[0]), found.y.get(first, at[1])
    flow = Identity.translate(*origin).rotate(pi / 2.0 if vertical else 0.0)
    along, across = -part * length, 0.0
    matrices, moved = [], []
    for cluster, (dx, dy) in zip(visual, steps, strict=False):
        along, across = (along + dy, across - dx) if vertical else (along + dx, across + dy)
        turn = radians(found.rotate.get(cluster.start, 0.0))
        matrix = flow.translate(along, across + baseline(cluster, vertical))
        matrices.append(matrix.rotate(turn).transform(cluster_transform(cluster)))
        moved.append(bool(dx or dy or turn))
        along += cluster.advance
    dx, dy = steps[-1]
    along, across = (along + dy, across - dx) if vertical else (along + dx, across + dy)
    end = flow.transformPoint((along, across))  # type: ignore[attr-defined]
    return TextChunk(tuple(visual), tuple(matrices), tuple(moved)), end


def on_track(
    found: Characters, visual: Sequence[GlyphCluster], vertical: bool, track: Track, along: float
) -> tuple[TextChunk, tuple[float, float]]:
    """Return the chunk along a path, with each cluster turned about the middle of its advance; see `chunk_of`.

    The text after a path continues at the path's end (SVG 2, 11.5, "Position on path").
    """
    matrices, across = [], 0.0
    for cluster, (dx, dy) in zip(visual, shifts(found, visual, vertical), strict=False):
        along, across = (along + dy, across - dx) if vertical else (along + dx, across + dy)
        half = cluster.width / 2.0
        point = track.at(along + half)
        if point is None:
            cluster.hidden = True
            matrices.append(Identity)
        else:
            turn = radians(found.rotate.get(cluster.start, 0.0))
            matrix = Identity.translate(point.x, point.y).rotate(point.turn)
            matrix = matrix.translate(-half, across + baseline(cluster, vertical))
            matrices.append(matrix.rotate(turn).transform(cluster_transform(cluster)))
        along += cluster.advance
    return TextChunk(tuple(visual), tuple(matrices), (True,) * len(visual)), track.end


def cluster_transform(cluster: GlyphCluster) -> Transform:
    """Return the transform that stretches a cluster, and turns it if it is upright in vertical text."""
    matrix = Identity.scale(cluster.stretch, 1.0)
    return matrix.rotate(-pi / 2.0) if cluster.upright else matrix


def shifts(found: Characters, visual: Sequence[GlyphCluster], vertical: bool) -> list[tuple[float, float]]:
    """Return the shifts by `dx` and `dy` before each cluster of a chunk, and after the last one.

    Each character is shifted by the sum of shifts up to it in logical order, regardless of direction, and a cluster by
    that of its first character (SVG 2, 11.5, "Adjust positions: dx, dy"). The chunk starts at its first character's
    position.
    """
    start, end = min(cluster.start for cluster in visual), max(cluster.end for cluster in visual)
    end = max(end, start + 1)  # a font may have no glyph for the first of several characters
    sums = [list(accumulate(places.get(at, 0.0) for at in range(start, end))) for places in (found.dx, found.dy)]
    both = []
    for along, total in zip((not vertical, vertical), sums, strict=True):
        places = [total[cluster.start - start] for cluster in visual]
        begin = total[0] if along else places[0]
        steps = [begin, *(after - before for before, after in pairwise(places))]
        both.append([*steps, total[-1] - places[-1] + places[0] - begin])
    return list(zip(*both, strict=True))
