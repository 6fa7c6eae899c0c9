"""Painting of one shape: its fill and stroke become paths in the drawing's coordinates."""

from collections.abc import Callable, Iterable
from copy import copy
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.tolerance import ROUND
from vexture.bezier.arc_length import path_length
from vexture.drawing.drawing import FillRule, Path
from vexture.drawing.paint import BLACK, Paint
from vexture.svg.compositing import Veil
from vexture.svg.outline import ShapeOutline
from vexture.svg.paint_servers import PaintServers
from vexture.svg.pattern_tiles import Canvas, FirstTile, PatternTiles, is_window, visible
from vexture.svg.patterns import Tiling
from vexture.svg.properties import PARTS
from vexture.svg.report import Report, describe_element
from vexture.svg.shapes import ShapeElement, check, shape_outlines
from vexture.svg.space import ElementPlace, PlacedElement
from vexture.svg.strokes import MOST_DASHES, Stroke, dash_count, stroke_contours
from vexture.svg.text.typesetter import Text
from vexture.svg.transform import Identity, Transform, map_points, scale_of
from vexture.svg.values import number, words

if TYPE_CHECKING:  # imported at run time for drawings with texts only
    from vexture.fonts.layers import GlyphLayers

MOST_SEGMENTS = 5_000_000
"""Most cubics in one drawing."""

STROKE = "/stroke"
"""Suffix of the name of an element's stroke; no XML id contains a slash."""


class Painter:
    """Collects the painted paths in order, with the innermost veil and the place of each.

    `walk` paints the content of markers and patterns.
    """

    def __init__(
        self,
        servers: PaintServers,
        report: Report,
        canvas: Canvas,
        walk: "Callable[[list[PlacedElement], Painter], None]",
    ) -> None:
        self.servers = servers
        self.report = report
        self.canvas = canvas
        self.walk = walk
        self.paths: list[Path] = []
        self.veils: list[Veil | None] = []
        self.places: list[ElementPlace] = []
        self.filtered: list[tuple[Path, ElementPlace]] = []  # paths before filters, for the boxes of notes
        self.segments: int = 0

    def paint(self, element: etree._Element, place: ElementPlace, markers: Iterable[list[PlacedElement]] = ()) -> None:
        """Paint a shape and its markers; `place` has the shape's own style and transform."""
        style = place.style
        if style["visibility"].lower() != "visible" or place.space.flat:
            return
        if not (place.is_clip or markers) and style["fill"].lower() == style["stroke"].lower() == "none":
            return
        scale = scale_of(place.space.whole)
        size = self.canvas.size / scale
        shape = ShapeElement(element, style, place.viewport, ROUND * size, self.report)
        outlines = shape_outlines(shape)
        if outlines:
            rule = FillRule[style["clip-rule" if place.is_clip else "fill-rule"].upper()]
            self.paint_outlines(shape, outlines, outlines, place, rule, size, markers)

    def paint_text(self, text: Text, place: ElementPlace) -> None:
        """Paint a text; `place` has its transform."""
        if place.space.flat or text.box is None:
            return
        size = self.canvas.size / scale_of(place.space.whole)
        for piece in text.pieces:
            assert piece.place.element is not None
            style = piece.place.style
            if piece.layers is not None:
                if style["fill"].lower() != "none":
                    self.paint_layers(piece.layers, piece.matrix, piece.place)
                continue
            shape = ShapeElement(piece.place.element, style, place.viewport, ROUND * size, self.report)
            for outline in piece.outlines:
                check(outline.cubics)
            self.paint_outlines(shape, [*piece.outlines], [text.box], piece.place, FillRule.NONZERO, size)

    def paint_outlines(
        self,
        shape: ShapeElement,
        outlines: list[ShapeOutline],
        boxed: list[ShapeOutline],
        place: ElementPlace,
        rule: FillRule,
        size: float,
        markers: Iterable[list[PlacedElement]] = (),
    ) -> None:
        """Paint outlines and markers; `boxed` outlines determine the bounding box, `size` is as in `stroke`."""
        fill = BLACK if place.is_clip else self.servers.paint("fill", place, boxed)
        line = None if place.is_clip else self.servers.paint("stroke", place, boxed)
        style = shape.style
        for part in dict.fromkeys([*style["paint-order"].lower().split(), *PARTS]):
            if part == "fill" and fill is not None:
                self.add([outline.loop for outline in outlines], place, rule, fill, place.name)
            elif part == "stroke":
                self.stroke(shape, outlines, place, line, size)
            elif part == "markers":
                for marker in markers:
                    self.walk(marker, self)

    def paint_layers(self, layers: "GlyphLayers", matrix: Transform, place: ElementPlace) -> None:
        """Paint a colour glyph; `matrix` maps its units to those of the place."""
        space = place.space.with_transform(matrix)
        a, b, c, d, e, f = space.whole.inverse()
        opacity = place.style.opacity("fill-opacity")
        veils: dict[int, Veil | None] = {-1: place.veil}
        if opacity < 1.0:
            veils[-1] = Veil(place.veil, opacity)
        for at, group in enumerate(layers.groups):
            outer = veils[group.outer]
            veils[at] = veil = Veil(outer, group.opacity, group.blend, mask=group.mask)
            if group.mask and outer is not None:
                outer.masks.append(veil)
        for path in layers.paths:
            inner = replace(place, space=space, veil=veils[path.group])
            paint = path.paint.after(((a, c, e), (b, d, f)))
            self.add([*path.contours], inner, path.fill_rule, paint, place.name)
        for note in layers.notes:
            self.report.count(note.kind, note.message, place.element)

    def for_document(self, servers: PaintServers, walk: "Callable[[list[PlacedElement], Painter], None]") -> "Painter":
        """Return a painter of another document onto the same drawing."""
        own = copy(self)
        own.servers, own.walk = servers, walk
        return own

    def stroke(
        self,
        shape: ShapeElement,
        outlines: list[ShapeOutline],
        place: ElementPlace,
        paint: Paint | Tiling | None,
        size: float,
    ) -> None:
        """Paint along the outlines; `size` is the drawing's, in the shape's user units."""
        stroke = stroke_of(shape, outlines) if paint is not None else None
        if paint is None or stroke is None:
            return
        effect = shape.style["vector-effect"].lower()
        screen = Identity
        if effect == "non-scaling-stroke":
            screen = place.space.whole
            outlines = [replace(outline, cubics=map_points(outline.cubics, screen)) for outline in outlines]
            size *= scale_of(screen)
        elif effect != "none":
            self.report.left_out(f"vector-effect '{effect[:40]}'", shape.element)
        if size == inf:
            size = max(stroke.width, *(float(np.ptp(outline.cubics, axis=(0, 1)).max()) for outline in outlines))
        count = dash_count(outlines, stroke)
        if count > MOST_DASHES:
            text = f"{count:,} dashes; the limit is {MOST_DASHES:,}; lengthen stroke-dasharray"
            self.report.simplification(
                f"stroke of {describe_element(shape.element)} read as solid: {text}", shape.element
            )
            stroke = replace(stroke, dashes=())
        contours = stroke_contours(outlines, stroke, size)
        if screen is not Identity:
            contours = [map_points(contour, screen.inverse()) for contour in contours]
        self.add(contours, place, FillRule.NONZERO, paint, place.name and place.name + STROKE)

    def add(
        self,
        contours: list[NDArray[np.float64]],
        place: ElementPlace,
        rule: FillRule,
        paint: Paint | Tiling,
        element: str,
    ) -> None:
        """Add contours, in the units of a place, to the paths."""
        self.segments += sum(map(len, contours))
        if self.segments > MOST_SEGMENTS:
            raise SourceError(f"here the drawing exceeds the limit of {MOST_SEGMENTS:,} segments; simplify it")
        clipped = [place.space.to_drawing(contour) for contour in contours]
        clipped = [contour for contour in clipped if len(contour)]
        if not clipped:
            return
        if isinstance(paint, Tiling):
            if self.tile(clipped, place, rule, paint, element):
                return
            paint = paint.solid
        self.paths.append(Path(tuple(clipped), rule, paint, element=element))
        self.veils.append(place.veil)
        self.places.append(place)
        if place.veil is not None:
            ends = np.concatenate([contour.reshape(-1, 2) for contour in clipped])
            place.veil.add((*ends.min(axis=0), *ends.max(axis=0)))

    def tile(
        self, shape: list[NDArray[np.float64]], place: ElementPlace, rule: FillRule, tiling: Tiling, element: str
    ) -> bool:
        """Paint the tiles of a pattern over a shape; return False if there are too many, or the frame is unknown.

        The shape masks them, or cuts them if it is an upright rectangle.
        """
        if self.canvas.frame is None:
            return False
        shape, window = visible(shape, self.canvas.frame)
        if not shape:
            return True
        first = self.first_tile(place, tiling)
        if first is None:
            return False
        tiles = PatternTiles.over(first.canvas, shape, window, self.canvas)
        costs = np.array([tiles.cost(path) for path, _ in first.painted]).reshape(-1, 2)
        cubics, gradients = costs.sum(axis=0).tolist()
        if not self.servers.budget.affords(tiling.pattern.element, segments=cubics, gradients=gradients):
            return False
        first.veil.enter(place.veil, (*window[0], *window[1]))
        if is_window(shape, window):
            first.veil.opacity = tiling.opacity
        elif first.painted:
            self.paths.append(Path(tuple(shape), rule, Paint(tiling.solid.color)))
            self.veils.append(first.veil.mask_pattern(tiling.opacity))
            self.places.append(place)
        for path, veil in first.painted:
            repeated = [replace(path_copy, element=element) for path_copy in tiles.repeat_path(path)]
            self.paths += repeated
            self.veils += [veil] * len(repeated)
            self.places += [place] * len(repeated)
        return True

    def first_tile(self, place: ElementPlace, tiling: Tiling) -> FirstTile | None:
        """Return the first tile, painted once for all shapes in one coordinate system; None if it is too complex."""
        tiles, key = self.servers.tiles, tiling.key
        if key not in tiles:
            elements = sum(1 for _ in tiling.pattern.holder.iter("*"))
            if not self.servers.budget.affords(tiling.pattern.element, elements=elements):
                return None
            canvas = Canvas(tiling.tile, self.canvas.size, tiling.space.whole)
            painter, veil = Painter(self.servers, self.report, canvas, self.walk), Veil(None, 1.0)
            self.walk(tiling.first_tile_content(place, veil), painter)
            tiles[key] = FirstTile.from_paths(canvas, veil, painter.paths, painter.veils)
        return tiles[key].copy_veils()


class Ruler(Painter):
    """Collects the outlines of shapes, and of strokes if requested, to measure them; paints do not matter."""

    def __init__(
        self,
        servers: PaintServers,
        report: Report,
        walk: "Callable[[list[PlacedElement], Painter], None]",
        stroked: bool = False,
    ) -> None:
        super().__init__(servers, report, Canvas(None, inf), walk)
        self.stroked = stroked
        self.corners: list[NDArray[np.float64]] = []

    def paint(self, element: etree._Element, place: ElementPlace, markers: Iterable[list[PlacedElement]] = ()) -> None:
        """Add the outlines of a shape, in the units of the outermost place; markers do not count."""
        shape = ShapeElement(element, place.style, place.viewport, inf, self.report)
        outlines = shape_outlines(shape)
        self.measure(place, *outlines)
        stroke = stroke_of(shape, outlines) if self.stroked and outlines else None
        if stroke is not None and place.style["stroke"].lower() != "none":
            size = max(stroke.width, *(float(np.ptp(outline.cubics, axis=(0, 1)).max()) for outline in outlines))
            contours = stroke_contours(outlines, replace(stroke, dashes=()), size)  # dashes do not count (SVG 2, 8.10)
            self.corners.extend(map_points(contour, place.space.whole) for contour in contours)

    def measure(self, place: ElementPlace, *outlines: ShapeOutline) -> None:
        """Add outlines."""
        self.corners.extend(map_points(outline.cubics, place.space.whole) for outline in outlines)

    def paint_text(self, text: Text, place: ElementPlace) -> None:
        """Add the box of a text."""
        if text.box is not None:
            self.corners.append(map_points(text.box.cubics, place.space.whole))


def stroke_of(shape: ShapeElement, outlines: list[ShapeOutline]) -> Stroke | None:
    """Return the stroke of a shape; None if it has no width."""
    style = shape.style
    width = shape.length("stroke-width") or 0.0
    if width <= 0.0:
        return None
    join = style["stroke-linejoin"].lower()
    dashes = dashes_of(shape)
    offset = shape.length("stroke-dashoffset") or 0.0
    whole = number(shape.element.get("pathLength", ""))
    if dashes and whole is not None and whole > 0.0:
        factor = sum(path_length(outline.cubics) for outline in outlines) / whole
        dashes, offset = tuple(dash * factor for dash in dashes), offset * factor
    limit = max(number(style["stroke-miterlimit"]) or 0.0, 1.0)
    return Stroke(width, style["stroke-linecap"].lower(), join, limit, dashes, offset)


def dashes_of(shape: ShapeElement) -> tuple[float, ...]:
    """Return the lengths of dashes and gaps, an even number; empty for a solid line."""
    text = shape.style["stroke-dasharray"]
    if text.lower() == "none":
        return ()
    lengths = [shape.read_length("stroke-dasharray", part) or 0.0 for part in words(text)]
    if len(lengths) % 2:
        lengths *= 2
    return tuple(lengths) if sum(lengths) > 0.0 else ()
