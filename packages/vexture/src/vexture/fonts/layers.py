"""Colour glyphs as painted paths and groups."""

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
from vexture.fonts.sweeps import Box, SweepFill

MOST_PATHS: Final = 10_000
"""Most paths and groups of one glyph; groups that mask each other paint their content several times."""

BLENDS: Final = {
    "PLUS": Blend.PLUS_LIGHTER,
    "HSL_HUE": Blend.HUE,
    "HSL_SATURATION": Blend.SATURATION,
    "HSL_COLOR": Blend.COLOR,
    "HSL_LUMINOSITY": Blend.LUMINOSITY,
}
"""Blend modes whose names differ from those of `Blend`."""

WHITE: Final = Paint((1.0, 1.0, 1.0))

NOTHING, ALL, WITHIN, WITHOUT = range(4)
"""Part of a layer that remains: nothing, all, inside the opacity of the other layer, or outside it."""

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
"""Remaining parts of the lower and of the upper layer, which are added (Compositing and Blending 1, 9.1)."""


@dataclass(frozen=True, slots=True, eq=False)
class GlyphLayers:
    """The paths and groups of a colour glyph.

    Parameters
    ----------
    paths : tuple of Path
        In painting order, in font units, y up, like their gradients. `Path.group` is an index in `groups`, or -1.
    groups : tuple of Group
        Each group comes after the group around it, as in `Drawing.groups`.
    notes : tuple of Note
        Differences from the glyph that the font describes.
    """

    paths: tuple[Path, ...]
    groups: tuple[Group, ...] = ()
    notes: tuple[Note, ...] = ()


def glyph_layers(font: Any, glyph: int, outline: Callable[[int], Contours], foreground: Color) -> GlyphLayers | None:
    """Return the layers of a colour glyph; None for any other glyph."""
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
    """Return the kind of a glyph that is an image."""
    if font.face.has_color_svg and font.face.get_glyph_color_svg(glyph):
        return "SVG documents"
    if font.face.has_color_png and font.get_glyph_color_png(glyph):
        return "raster images"
    return None


def bounds_of(nodes: Sequence[Node]) -> Box:
    """Return the box (left, bottom, right, top) of the clips among nodes; unclipped content is left out."""
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
    """Return whether the content of a node composites normally with what is below, so that it needs no group."""
    if isinstance(node, Fill | SweepFill):
        return True
    return (isinstance(node, Clip) or node.mode == "SRC_OVER") and all(map(is_plain, node.children))


def is_clipped(node: Node) -> bool:
    """Return whether all content of a node is clipped by an outline."""
    return isinstance(node, Clip) or (isinstance(node, Composite) and all(map(is_clipped, node.children)))


def blacken(paint: Paint) -> Paint:
    """Return a black paint with the opacity of a paint."""
    if paint.gradient is None:
        return Paint(opacity=paint.opacity)
    return Paint.from_gradient(
        replace(paint.gradient, stops=tuple(replace(s, color=BLACK.color) for s in paint.gradient.stops))
    )


class LayerStack:
    """Builds paths and groups from the nodes of a tree; with `black`, colours are lost and only opacity remains."""

    def __init__(self, box: Box) -> None:
        self.box = box
        self.everywhere = rectangle(*box) if box[0] <= box[2] else ()
        self.paths: list[Path] = []
        self.groups: list[Group] = []
        self.count = 0

    def _count(self) -> None:
        """Count a path or group, even one that shows nothing: a chain of 50 that mask each other has 2^50."""
        check_time()
        self.count += 1
        if self.count > MOST_PATHS:
            raise SourceError(f"a glyph paints more than {MOST_PATHS:,} paths and groups; use another font")

    def group(self, group: Group) -> int:
        """Add a group; return its index."""
        self._count()
        self.groups.append(group)
        return len(self.groups) - 1

    def path(self, contours: Contours, paint: Paint, group: int, black: bool = False) -> None:
        """Paint an outline."""
        self._count()
        if contours:
            self.paths.append(Path(contours, paint=blacken(paint) if black else paint, group=group))

    def paint(self, nodes: Sequence[Node], group: int, black: bool = False) -> None:
        """Paint nodes, each over the one before."""
        for place in reversed(range(len(nodes))):
            node = nodes[place]
            if isinstance(node, Composite) and (node.mode in PORTER_DUFF or node.mode == "DEST_OVER"):
                self._combine(nodes[:place], node, group, black)
                nodes = nodes[place + 1 :]
                break
        for node in nodes:
            if isinstance(node, Fill):
                self.path(self.everywhere, node.paint, group, black)
            elif isinstance(node, SweepFill):
                if self.everywhere:
                    for contour, paint in node.triangles(self.box):
                        self.path((contour,), paint, group, black)
            elif isinstance(node, Clip):
                self._clip(node, group, black)
            else:
                self._composite(node, group, black)

    def _clip(self, clip: Clip, group: int, black: bool) -> None:
        """Paint the content of a clip: its outline if the content only fills it, else a group with a mask."""
        if all(isinstance(node, Fill) for node in clip.children):
            for node in clip.children:
                if isinstance(node, Fill):
                    self.path(clip.contours, node.paint, group, black)
            return
        content = bounds_of(clip.children) if all(map(is_clipped, clip.children)) else self.box
        left, bottom, right, top = bounds_of([clip])
        if clip.is_box and left <= content[0] and bottom <= content[1] and right >= content[2] and top >= content[3]:
            self.paint(clip.children, group, black)
            return
        inner = self.group(Group(group))
        self.paint(clip.children, inner, black)
        self.path(clip.contours, BLACK, self.group(Group(inner, mask=Mask.OPACITY)))

    def _composite(self, node: Composite, group: int, black: bool) -> None:
        """Paint a group with a blend mode; leave the group out if that makes no difference."""
        if not is_plain(node):
            mode = BLENDS.get(node.mode) or Blend["NORMAL" if node.mode == "SRC_OVER" else node.mode]
            group = self.group(Group(group, blend=Blend.NORMAL if black else mode))
        self.paint(node.children, group, black)

    def _combine(self, below: Sequence[Node], above: Composite, group: int, black: bool) -> None:
        """Paint two layers by a Porter-Duff mode."""
        if above.mode == "DEST_OVER":
            self.paint(above.children, group, black)
            self.paint(below, group, black)
            return
        kept_below, kept_above = PORTER_DUFF[above.mode]
        self._part(below, kept_below, above.children, Group(group), black)
        self._part(above.children, kept_above, below, Group(group, blend=Blend.PLUS_LIGHTER), black)

    def _part(self, nodes: Sequence[Node], region: int, other: Sequence[Node], group: Group, black: bool) -> None:
        """Paint the remaining part of a layer, in a new group; the other layer masks it."""
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
