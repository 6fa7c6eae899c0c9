"""The elements that notes of an SVG refer to: their names, and their boxes in the drawing."""

from collections.abc import Collection, Iterable

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.base.notes import Box, Subject
from vexture.drawing.drawing import Path
from vexture.svg.names import ElementNames
from vexture.svg.report import describe_element
from vexture.svg.space import ElementPlace

LONGEST_NAME = 80
"""Longest name that is kept, in letters."""

Boxes = dict[etree._Element, NDArray[np.float64]]
"""Bounding boxes of what elements paint, (2, 2) each, in the coordinates of the paths."""


def boxes_of(elements: Collection[etree._Element], painted: Iterable[tuple[Path, ElementPlace]]) -> Boxes:
    """Return the boxes of what elements paint: paths in the drawing's coordinates, each with its place.

    Content that an element shows as a clip, marker, mask or pattern of another one does not count.
    """
    boxes: Boxes = {}
    if not elements:
        return boxes
    for path, innermost in painted:
        place: ElementPlace | None = None if innermost.masks else innermost
        while place is not None:
            if place.element in elements:
                assert place.element is not None
                both = np.concatenate([path.box, boxes.get(place.element, path.box)])
                boxes[place.element] = np.stack([both.min(axis=0), both.max(axis=0)])
            place = place.outer
    return boxes


def subject_of(
    element: etree._Element, names: ElementNames, boxes: Boxes, to_source: NDArray[np.float64] | None
) -> Subject:
    """Describe an element for a note; `to_source` maps the unit square to its box's coordinates, unrotated."""
    name = (names.of(element) or describe_element(element))[:LONGEST_NAME]
    if element not in boxes or to_source is None:
        return Subject(name, None)
    corners = ((boxes[element] - to_source[:, 2]) / np.diag(to_source)).clip(0.0, 1.0)
    (left, bottom), (right, top) = np.sort(corners, axis=0).tolist()
    shown: Box = (left, bottom, right, top)
    return Subject(name, shown if left < right or bottom < top else None)
