"""Filters on elements: their content is painted by itself, filtered, and painted in its place."""

from collections.abc import Callable
from copy import copy
from dataclasses import replace
from functools import partial
from typing import Final, TypeAlias

from lxml import etree

from vexture.svg.compositing import Veil, group_paths
from vexture.svg.filter_content import FilterContent, FilterLimitError, check_count
from vexture.svg.filter_graph import FilterGraph, FilterScene, FilterSubject
from vexture.svg.filter_primitives import PRIMITIVES
from vexture.svg.filters import filter_elements, filter_label
from vexture.svg.gradients import rows
from vexture.svg.masks import MeasuredScene
from vexture.svg.painter import Painter
from vexture.svg.space import ElementPlace, PlacedElement, Space
from vexture.svg.style import ElementStyle
from vexture.svg.values import TooLargeError

DEEPEST: Final = 12
"""Deepest nesting of elements with filters."""

MARGIN: Final = 0.5
"""Part of the drawing, on each side, that patterns fill beyond it: filters may move it into view."""

PaintContent: TypeAlias = Callable[[ElementPlace, Painter], list[PlacedElement]]
"""Function that paints the content of an element, or returns the elements to paint."""


def note_effects(scene: MeasuredScene, element: etree._Element, style: ElementStyle) -> str | None:
    """Note an unsupported motion or an invalid filter; return the name of the filter, as `filter_label` does."""
    if style["offset-path"].lower() != "none":
        scene.report.left_out("offset-path", element)
    value = style["filter"]
    if value.lower() == "none":
        return None
    label = filter_label(value, scene.servers)
    if label is None:
        scene.report.invalid("filter", value, element)
    return label


def paint_filtered(
    scene: FilterScene, element: etree._Element, place: ElementPlace, painter: Painter, label: str, paint: PaintContent
) -> list[PlacedElement]:
    """Paint an element, at the place inside it, with its filter, and note what is not exact.

    `paint` paints its content at a place, or returns the elements to paint, in order. Return those of an element whose
    filter is not drawn.
    """
    filters = filter_elements(place.style["filter"], scene.servers, place)
    if filters is None:
        scene.report.invalid("filter", place.style["filter"], element)
        return paint(place, painter)
    if place.filters >= DEEPEST:
        scene.report.left_out(f"{label} (filters are nested more than {DEEPEST} deep)", element)
        return paint(place, painter)
    if place.space.flat:
        return []
    content = source = content_of(scene, place, painter, paint)
    subject = FilterSubject(scene, element, place, partial(content_of, scene, place, painter))
    try:
        check_count(len(source.paths))
        scene.sources.spend(len(source.paths))
        for each in filters:
            content = FilterGraph(each, subject, content).run(PRIMITIVES)
    except (FilterLimitError, TooLargeError) as error:
        scene.report.left_out(f"{label} ({error})" if str(error) else label, element)
        content = source
    else:
        for remark in subject.remarks:
            scene.report.simplification(f"{label} ({remark})", element)
    paint_content(content, place, painter)
    return []


def content_of(scene: FilterScene, place: ElementPlace, painter: Painter, paint: PaintContent) -> FilterContent:
    """Return what an element paints, in its user units, beyond the viewports around it, too."""
    whole = place.space.whole
    free = replace(place, space=Space(whole, whole=whole), veil=None, filters=place.filters + 1)
    own = copy(painter)
    own.paths, own.veils, own.places = [], [], []
    if painter.canvas.frame is not None:
        x, y, width, height = painter.canvas.frame
        frame = (x - MARGIN * width, y - MARGIN * height, (1 + 2 * MARGIN) * width, (1 + 2 * MARGIN) * height)
        own.canvas = replace(painter.canvas, frame=frame)
    scene.walk([*reversed(paint(free, own))], own)
    painter.segments = own.segments
    painter.filtered += zip(own.paths, own.places, strict=True)
    paths, groups = group_paths(own.paths, own.veils)
    return FilterContent(tuple(paths), groups).move(whole.inverse())


def paint_content(content: FilterContent, place: ElementPlace, painter: Painter) -> None:
    """Paint a content at a place, whose viewports cut it; notes show what it was before."""
    place = replace(place, masks=max(place.masks, 1))
    to_user = rows(place.space.whole.inverse())
    veils: dict[int, Veil | None] = {-1: place.veil}
    for at, group in enumerate(content.groups):
        outer = veils[group.outer]
        veils[at] = veil = Veil(outer, group.opacity, group.blend, mask=group.mask, is_pattern=group.pattern)
        if group.mask and outer is not None:
            outer.masks.append(veil)
    for path in content.paths:
        inner = replace(place, veil=veils[path.group])
        painter.add([*path.contours], inner, path.fill_rule, path.paint.after(to_user), path.element)
