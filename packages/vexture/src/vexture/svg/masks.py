"""Clips and masks of an element (CSS Masking 1), painted as groups that mask the element's.

A clip by a single rectangle cuts outlines instead, so that silhouettes and layers show it, too.
"""

from collections.abc import Iterable
from dataclasses import replace
from typing import Final, Protocol

import numpy as np
from lxml import etree

from vexture.base.tolerance import ROUND
from vexture.drawing.group import Mask
from vexture.svg.clip_shapes import STROKED, VIEWED, clip_element
from vexture.svg.compositing import Veil
from vexture.svg.document import local_name
from vexture.svg.paint_servers import PaintServers
from vexture.svg.report import Report
from vexture.svg.shapes import ShapeElement, shape_outlines
from vexture.svg.space import ElementPlace, PlacedElement, Space
from vexture.svg.style import Cascade, ElementStyle
from vexture.svg.transform import Identity, Transform
from vexture.svg.viewport import Rectangle, view_box

MASKING: Final = {"clip-path": "clipPath", "mask": "mask"}
"""Properties that mask an element, with the elements to which they refer."""

REGION: Final = {"x": "-10%", "y": "-10%", "width": "120%", "height": "120%"}
"""Default region of a mask."""

NOTHING: Final = Identity.scale(0.0)


class MeasuredScene(Protocol):
    """The part of a scene that measures elements."""

    report: Report
    cascade: Cascade
    servers: PaintServers

    def transform(self, element: etree._Element, style: ElementStyle, place: ElementPlace) -> Transform:
        """Return the transform of an element, about its origin."""

    def extent(self, element: etree._Element, place: ElementPlace) -> Rectangle | None:
        """Return the box as `around` does, without strokes; None if it has no area."""

    def around(self, element: etree._Element, place: ElementPlace, stroked: bool) -> Rectangle | None:
        """Return the bounding box of an element's visible content, in the units of the place; None if there is none."""


def add_masks(
    scene: MeasuredScene, element: etree._Element, place: ElementPlace, names: Iterable[str] = MASKING
) -> tuple[ElementPlace, list[PlacedElement]]:
    """Return the place inside an element, cut by its clips, and the elements to paint as its masks.

    The element gets its own veil if it has a clip or a mask. `names` are the properties that have an effect: a clip
    counts only outlines, so a mask in it has none.
    """
    shown: list[PlacedElement] = []
    for name in names:
        target = shape_of(scene, element, place) if name == "clip-path" else None
        if target is None:
            target = scene.servers.referenced_element(name, MASKING[name], place)
        if target is not None:
            place, more = add_mask(scene, element, target, place)
            shown += more
    return place, shown


def note_outer_units(
    scene: MeasuredScene, root: etree._Element, style: ElementStyle, size: tuple[float, float] | None
) -> None:
    """Note clips and masks of the outermost element in units that browsers treat as pixels."""
    box = view_box(root.get("viewBox", ""))
    if size is None or box is None or box[2:] == size:
        return
    for name in MASKING.keys() & style.own.keys():
        if style[name].lower() != "none":
            scene.report.simplification(f"{name} of the outermost <svg> read in the units of its content", root)


def shape_of(scene: MeasuredScene, element: etree._Element, place: ElementPlace) -> etree._Element | None:
    """Return the clip by a basic shape of an element as an SVG element; None if there is none.

    Two kinds are left out: clips of the outermost element, which are in the units around it, and those of clips and
    masks themselves, whose reference box belongs to another element.
    """
    value = place.style["clip-path"]
    if value.lower() == "none" or element.getparent() is None or local_name(element) in MASKING.values():
        return None

    def box(name: str) -> Rectangle | None:
        if name == VIEWED:
            return 0.0, 0.0, place.viewport.width, place.viewport.height
        return scene.around(element, place, name == STROKED)

    return clip_element(value, box, place.viewport.root_font_size, place.style.font_size)


def add_mask(
    scene: MeasuredScene, element: etree._Element, target: etree._Element, place: ElementPlace
) -> tuple[ElementPlace, list[PlacedElement]]:
    """Add one `clipPath` or `mask` as `add_masks` does."""
    masks = place.deeper()
    is_clip, style = local_name(target) == "clipPath", scene.servers.style_of(target)
    matrix = scene.transform(target, style, place) if is_clip else Identity
    if target.get("clipPathUnits" if is_clip else "maskContentUnits") == "objectBoundingBox":
        matrix = matrix.transform(box_matrix(scene, element, place))
    space = place.space.with_transform(matrix)
    if is_clip and not space.flat:
        rectangle = only_rectangle(scene, target, style, place)
        if rectangle is not None:
            return replace(place, space=space.window(rectangle, matrix.inverse())), []
    if not is_clip:
        if style["color-interpolation"].lower() == "linearrgb":
            scene.report.simplification("mask in linear light (color-interpolation) read as one in sRGB", element)
        space = region(scene, element, target, place, matrix)
    assert place.veil is not None
    mode = place.style["mask-mode"].lower().partition(",")[0].strip()  # mode of the only layer
    kind = style["mask-type"].lower() if mode == "match-source" else mode
    by_opacity = is_clip or kind == "alpha"
    veil = Veil(place.veil, 1.0, mask=Mask.OPACITY if by_opacity else Mask.LUMINANCE)
    place.veil.masks.append(veil)
    content = ElementPlace(
        place.viewport,
        space,
        style,
        target,
        place,
        place.depth + 1,
        used=True,
        veil=veil,
        is_clip=is_clip,
        masks=masks,
        is_instance=True,
    )
    content, shown = add_masks(scene, target, content, ("clip-path",) if is_clip else tuple(MASKING))
    return place, [*shown, *((child, content) for child in target)]


def box_matrix(scene: MeasuredScene, element: etree._Element, place: ElementPlace) -> Transform:
    """Return the map from the unit square to the bounding box of an element; to a point if the box has no area."""
    box = scene.extent(element, place)
    return NOTHING if box is None else Transform(box[2], 0.0, 0.0, box[3], box[0], box[1])


def region(
    scene: MeasuredScene, element: etree._Element, target: etree._Element, place: ElementPlace, matrix: Transform
) -> Space:
    """Return the space inside a mask's region; `matrix` maps its content to the units of the element."""
    by_box = target.get("maskUnits") != "userSpaceOnUse"
    whole = (1.0, 1.0) if by_box else (place.viewport.width, place.viewport.height)
    units = box_matrix(scene, element, place) if by_box else Identity
    lengths = []
    for k, name in enumerate(REGION):
        text = target.get(name, REGION[name])
        length = place.viewport.length(text, whole[k % 2], place.style.font_size)
        if length is None:
            scene.report.invalid(name, text, target)
            length = place.viewport.length(REGION[name], whole[k % 2], place.style.font_size)
        lengths.append(length or 0.0)
    x, y, width, height = lengths
    if width <= 0.0 or height <= 0.0 or units == NOTHING:
        return place.space.with_transform(NOTHING)
    visible = (units.dx + x * units.xx, units.dy + y * units.yy, width * units.xx, height * units.yy)
    return place.space.window(visible, matrix)


def only_rectangle(
    scene: MeasuredScene, clip: etree._Element, style: ElementStyle, place: ElementPlace
) -> Rectangle | None:
    """Return the rectangle, in the units of a clip's content, if the clip shows only an upright rectangle."""
    children = [child for child in clip if local_name(child) not in (None, "title", "desc", "metadata")]
    if len(children) != 1 or local_name(children[0]) != "rect":
        return None
    own = scene.cascade.style(children[0], style)
    if (
        {*MASKING, "transform", "display"} & {*own.own}
        or {*MASKING} & {*style.own}
        or own["visibility"].lower() != "visible"
    ):
        return None
    outlines = shape_outlines(ShapeElement(children[0], own, place.viewport, ROUND, scene.report))
    if len(outlines) != 1 or len(outlines[0].cubics) != 4:
        return None
    (left, top), (right, bottom) = (limit(outlines[0].cubics, axis=(0, 1)).tolist() for limit in (np.min, np.max))
    return (left, top, right - left, bottom - top)
