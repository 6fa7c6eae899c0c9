"""Glyphs in colour as painted paths and groups."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Any, Final

import numpy as np

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError
from vexture.base.notes import Note, Notes
from vexture.drawing.drawing import Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import BLACK, Color, Paint
from vexture.fonts.paint_tree import Clip, Composite, Contours, Fill, Node, paint_tree, rectangle

MOST_PATHS: Final = 10_000
"""Of one glyph, with its groups; groups that mask each other paint what they hold several times."""

BLENDS: Final = {
    "PLUS": Blend.PLUS_LIGHTER,
    "HSL_HUE": Blend.HUE,
    "HSL_SATURATION": Blend.SATURATION,
    "HSL_COLOR": Blend.COLOR,
    "HSL_LUMINOSITY": Blend.LUMINOSITY,
}
"""Modes whose names differ from those of `Blend`."""

WHITE: Final = Paint((1.0, 1.0, 1.0))

NOTHING, ALL, WITHIN, WITHOUT = range(4)
"""What is left of a layer: nothing, all, what is within the other one's opacity, what is without it."""

PORTER_DUFF: Final = {
    "CLEAR": (NOTHING, NOTHING),
    "SRC": (NOTHING, ALL),
    "DEST": (ALL, NOTHING),
    "SRC_IN": (NOTHING, WITHIN),
    "DEST_IN": (WITHIN, NOTHING),
    "SRC_OUT": (NOTHING, WITHOUT),
    "DEST_OUT": (WITHOUT, NOTHING),
    "SRC_ATOP": (WITHOUT, WITHIN),
    "DEST_ATOP": (WITHIN, WITHOUT),
    "XOR": (WITHOUT, WITHOUT),
}
"""What is left of the layer below and of the layer above, which add up (Compositing and Blending 1, 9.1)."""


@dataclass(frozen=True, slots=True, eq=False)
class GlyphLayers:
    """The paths and groups of a glyph in colour.

    Parameters
    ----------
    paths : tuple of Path
        In painting order, in font units, y up; so are their gradients. `Path.group` is a place in `groups`, or -1.
    groups : tuple of Group
        Each after the group around it, as in `Drawing.groups`.
    notes : tuple of Note
        What of it is not as it should be.
    """

    paths: tuple[Path, ...]
    groups: tuple[Group, ...] = ()
    notes: tuple[Note, ...] = ()


def glyph_layers(font: Any, glyph: int, outline: Callable[[int], Contours], foreground: Color) -> GlyphLayers | None:
    """Layers of a glyph in colour; None of any other glyph."""
    face = font.face
    notes = Notes()
    if (face.has_color_paint and face.glyph_has_color_paint(glyph)) or (
        face.has_color_layers and face.get_glyph_color_layers(glyph)
    ):
        tree = paint_tree(font, glyph, outline, foreground, notes)
        layers = LayerStack(bounds_of(tree.children))
        layers.paint(tree.children, -1)
        return GlyphLayers(tuple(layers.paths), tuple(layers.groups), notes.in_order)
    kind = other_kind(font, glyph)
    if kind is None:
        return None
    shown = outline(glyph)
    message = f"glyphs that are {kind}"
    (notes.simplification if shown else notes.left_out)(f"{message}, shown as outlines" if shown else message)
    return GlyphLayers((Path(shown, paint=Paint(foreground)),) if shown else (), (), notes.in_order)


def other_kind(font: Any, glyph: int) -> str | None:
    """Kind of a glyph that is a picture."""
    if font.face.has_color_svg and font.face.get_glyph_color_svg(glyph):
        return "SVG documents"
    if font.face.has_color_png and font.get_glyph_color_png(glyph):
        return "raster images"
    return None


Box = tuple[float, float, float, float]


def bounds_of(nodes: Sequence[Node]) -> Box:
    """Box (left, bottom, right, top) of the clips of some nodes; what is not clipped has no part in it."""
    boxes = []
    for node in nodes:
        if isinstance(node, Clip) and node.contours:
            joined = np.concatenate(node.contours)
            boxes.append((*joined.min(axis=(0, 1)).tolist(), *joined.max(axis=(0, 1)).tolist()))
        elif isinstance(node, Composite):
            boxes.append(bounds_of(node.children))
    lefts, bottoms, rights, tops = zip(*boxes, strict=True) if boxes else ((inf,), (inf,), (-inf,), (-inf,))
    return min(lefts), min(bottoms), max(rights), max(tops)


def is_plain(node: Node) -> bool:
    """Whether all in it goes on what is below as if it were there by itself."""
    if isinstance(node, Fill):
        return True
    return (isinstance(node, Clip) or node.mode == "SRC_OVER") and all(map(is_plain, node.children))


def is_clipped(node: Node) -> bool:
    """Whether all in it is within some outline."""
    return isinstance(node, Clip) or (isinstance(node, Composite) and all(map(is_clipped, node.children)))


def blacken(paint: Paint) -> Paint:
    """A paint in black, with its opacity."""
    if paint.gradient is None:
        return Paint(opacity=paint.opacity)
    return Paint.from_gradient(
        replace(paint.gradient, stops=tuple(replace(s, color=BLACK.color) for s in paint.gradient.stops))
    )


class LayerStack:
    """Paths and groups that the nodes of a tree become; `black` leaves of what they paint only its opacity."""

    def __init__(self, box: Box) -> None:
        self.box = box
        self.everywhere = rectangle(*box) if box[0] <= box[2] else ()
        self.paths: list[Path] = []
        self.groups: list[Group] = []
        self.count = 0

    def _count(self) -> None:
        """Count a path or group, also one that shows nothing: a chain of 50 that mask each other has 2^50."""
        check_time()
        self.count += 1
        if self.count > MOST_PATHS:
            raise SourceError(f"a glyph paints more than {MOST_PATHS:,} paths and groups; use another font")

    def group(self, group: Group) -> int:
        """Place of a new group."""
        self._count()
        self.groups.append(group)
        return len(self.groups) - 1

    def path(self, contours: Contours, paint: Paint, group: int, black: bool = False) -> None:
        """Paint an outline."""
        self._count()
        if contours:
            self.paths.append(Path(contours, paint=blacken(paint) if black else paint, group=group))

    def paint(self, nodes: Sequence[Node], group: int, black: bool = False) -> None:
        """Paint nodes one on another."""
        for place in reversed(range(len(nodes))):
            node = nodes[place]
            if isinstance(node, Composite) and (node.mode in PORTER_DUFF or node.mode == "DEST_OVER"):
                self._combine(nodes[:place], node, group, black)
                nodes = nodes[place + 1 :]
                break
        for node in nodes:
            if isinstance(node, Fill):
                self.path(self.everywhere, node.paint, group, black)
            elif isinstance(node, Clip):
                self._clip(node, group, black)
            else:
                self._composite(node, group, black)

    def _clip(self, clip: Clip, group: int, black: bool) -> None:
        """Paint what is in a clip: its outline, where that is filled, or else a group with a mask."""
        if all(isinstance(node, Fill) for node in clip.children):
            for node in clip.children:
                if isinstance(node, Fill):
                    self.path(clip.contours, node.paint, group, black)
            return
        held = bounds_of(clip.children) if all(map(is_clipped, clip.children)) else self.box
        left, bottom, right, top = bounds_of([clip])
        if clip.is_box and left <= held[0] and bottom <= held[1] and right >= held[2] and top >= held[3]:
            self.paint(clip.children, group, black)
            return
        inner = self.group(Group(group))
        self.paint(clip.children, inner, black)
        self.path(clip.contours, BLACK, self.group(Group(inner, mask=Mask.OPACITY)))

    def _composite(self, node: Composite, group: int, black: bool) -> None:
        """Paint a group whose mode is a blend mode; without a group where that makes no difference."""
        if not is_plain(node):
            mode = BLENDS.get(node.mode) or Blend["NORMAL" if node.mode == "SRC_OVER" else node.mode]
            group = self.group(Group(group, blend=Blend.NORMAL if black else mode))
        self.paint(node.children, group, black)

    def _combine(self, below: Sequence[Node], above: Composite, group: int, black: bool) -> None:
        """Paint two layers by a mode of Porter and Duff."""
        if above.mode == "DEST_OVER":
            self.paint(above.children, group, black)
            self.paint(below, group, black)
            return
        kept_below, kept_above = PORTER_DUFF[above.mode]
        self._part(below, kept_below, above.children, Group(group), black)
        self._part(above.children, kept_above, below, Group(group, blend=Blend.PLUS_LIGHTER), black)

    def _part(self, nodes: Sequence[Node], region: int, other: Sequence[Node], group: Group, black: bool) -> None:
        """Paint in a new group what is left of a layer beside another one."""
        if region == NOTHING:
            return
        inner = self.group(group)
        self.paint(nodes, inner, black)
        if region == WITHIN:
            self.paint(other, self.group(Group(inner, mask=Mask.OPACITY)), black=True)
        elif region == WITHOUT:
            mask = self.group(Group(inner, mask=Mask.LUMINANCE))
            self.path(self.everywhere, WHITE, mask)
            self.paint(other, mask, black=True)
