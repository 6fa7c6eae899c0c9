"""Gradient meshes (SVG 2's draft of 2016, 13.4, as Inkscape writes them): rows of patches with four curved sides.

A side belongs to two patches, so that only the first patch of a row has a left one of its own, and only the first row
upper ones. A patch lists the sides that it adds, clockwise from the upper one; each has the colour of its first corner.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.drawing.paint import Paint, Stop
from vexture.svg.document import local_name
from vexture.svg.gradients import BOXED, WHOLE, gradient_space, transform_of
from vexture.svg.gradients import rows as rows_of
from vexture.svg.mesh_pictures import Mesh, Values, mesh_picture
from vexture.svg.outline import ShapeOutline
from vexture.svg.path_data import GAP, NUMBER, NUMBERS, SPACE
from vexture.svg.report import Report
from vexture.svg.space import ElementPlace
from vexture.svg.style import ElementStyle
from vexture.svg.transform import Identity, Transform, about_origin, map_points
from vexture.svg.values import bounded_number

MESHES: Final = frozenset({"meshgradient", "meshGradient"})

MOST_PATCHES: Final = 4096
"""Most patches of a mesh."""

SIDE: Final = re.compile(rf"{SPACE}([CcLl]){SPACE}({NUMBER}(?:{GAP}{NUMBER})*+){SPACE}")
"""Pattern of a side: one curve or line, which may lack its last point if that is known."""

Point = tuple[float, float]


@dataclass(frozen=True, slots=True, eq=False)
class MeshGradient:
    """A mesh as defined by its element and those it refers to, without a position yet."""

    element: etree._Element
    mesh: Mesh
    boxed: bool  # True for parts of the bounding box
    moved: Transform  # `gradientTransform`
    origin: str  # origin of the transform
    font_size: float  # font size of the element

    def paint(self, place: ElementPlace, outlines: list[ShapeOutline], report: Report) -> Paint | None:
        """Return the paint of outlines at a place, in the drawing's coordinates; None if it has no area there."""
        view = WHOLE if self.boxed else place.viewport
        moved = about_origin(self.moved, self.origin, view.along(self.font_size))
        whole = gradient_space(place, outlines if self.boxed else [], moved)
        if whole is None:
            return None
        a, b, c, d = whole[:4]
        to_mesh = whole.inverse().transform(place.space.whole)
        shape = np.concatenate([map_points(outline.cubics, to_mesh) for outline in outlines])
        picture = mesh_picture(self.mesh, shape, (float(np.hypot(a, b)), float(np.hypot(c, d))))
        if picture is None:
            return None
        rows, columns = picture.pixels.shape[:2]
        report.simplification(f"gradient mesh sampled at {columns:,} x {rows:,} points", self.element)
        return Paint.from_picture(picture.after(rows_of(whole.inverse())))


def read_mesh(
    chain: list[etree._Element], style: ElementStyle, stop: Callable[[etree._Element, float], Stop], report: Report
) -> MeshGradient | None:
    """Read the first of some mesh elements, each of which refers to the next; None if it has no patches to paint."""

    def attribute(name: str, initial: str) -> str:
        return next((text for element in chain if (text := element.get(name)) is not None), initial)

    holder = next((element for element in chain if children(element, "meshrow")), None)
    if holder is None:
        return None
    texts = {name: attribute(name, "0") for name in ("x", "y")}
    start = [WHOLE.length(text, 1.0, style.font_size) for text in texts.values()]
    for (name, text), value in zip(texts.items(), start, strict=True):
        if value is None:
            report.invalid(name, text, chain[0])
    units = attribute("gradientUnits", "objectBoundingBox")
    if units.strip() not in BOXED:
        report.invalid("gradientUnits", units, chain[0])
    text, moved = transform_of(attribute("gradientTransform", ""), chain[0], style)
    if text and moved is None:
        report.invalid("gradientTransform", text, chain[0])
    is_smooth = attribute("type", "bilinear").strip().lower() == "bicubic"
    reader = MeshReader((start[0] or 0.0, start[1] or 0.0), stop)
    mesh = reader.mesh(holder, is_smooth, style["color-interpolation"].lower() == "linearrgb")
    if mesh is None:
        return None
    boxed = BOXED.get(units.strip(), True)
    return MeshGradient(chain[0], mesh, boxed, moved or Identity, style["transform-origin"], style.font_size)


def children(element: etree._Element, name: str) -> list[etree._Element]:
    """Return the children of a name, in any case."""
    return [child for child in element if (local_name(child) or "").lower() == name]


class MeshReader:
    """Reads the sides and corners of patches; places are (row, column) of corners and of the first corners of sides."""

    def __init__(self, start: Point, stop: Callable[[etree._Element, float], Stop]) -> None:
        self.stop = stop
        self.corners: dict[tuple[int, int], Point] = {(0, 0): start}
        self.colors: dict[tuple[int, int], tuple[float, float, float, float]] = {}
        self.across: dict[tuple[int, int], Values] = {}
        self.down: dict[tuple[int, int], Values] = {}

    def mesh(self, holder: etree._Element, is_smooth: bool, is_linear: bool) -> Mesh | None:
        """Return the mesh of an element; None if a row or a side is not as long as it must be, or not valid."""
        rows = [children(row, "meshpatch") for row in children(holder, "meshrow")]
        columns = len(rows[0])
        if not 0 < len(rows) * columns <= MOST_PATCHES or any(len(row) != columns for row in rows):
            return None
        for row, patches in enumerate(rows):
            for column, patch in enumerate(patches):
                if not self._read_patch(patch, row, column):
                    return None

        def grid(values: dict[tuple[int, int], Values], height: int, width: int) -> Values:
            return np.array([[values[row, column] for column in range(width)] for row in range(height)])

        colors = {place: np.array(color) for place, color in self.colors.items()}
        return Mesh(
            grid(self.across, len(rows) + 1, columns),
            grid(self.down, len(rows), columns + 1),
            grid(colors, len(rows) + 1, columns + 1),
            is_smooth,
            is_linear,
        )

    def _read_patch(self, patch: etree._Element, row: int, column: int) -> bool:
        """Read the sides that a patch adds; return False if one is missing or not valid."""
        low, beyond = row + 1, column + 1
        sides = [((row, beyond), (low, beyond)), ((low, beyond), (low, column))]  # right and lower, clockwise
        sides = [((row, column), (row, beyond)), *sides] if row == 0 else sides
        sides = [*sides, ((low, column), (row, column))] if column == 0 else sides
        stops = children(patch, "stop")
        if len(stops) < len(sides):
            return False
        for (begin, end), element in zip(sides, stops, strict=False):
            if begin not in self.colors:
                color = self.stop(element, 0.0)
                self.colors[begin] = (*color.color, color.opacity)
            curve = side_curve(element.get("path", ""), self.corners[begin], self.corners.get(end))
            if curve is None:
                return False
            self.corners[end] = (float(curve[3, 0]), float(curve[3, 1]))
            if end[0] == begin[0]:
                self.across[row if begin[1] < end[1] else low, column] = curve if begin[1] < end[1] else curve[::-1]
            else:
                self.down[row, beyond if end[0] > begin[0] else column] = curve if end[0] > begin[0] else curve[::-1]
        return True


def side_curve(text: str, start: Point, end: Point | None) -> NDArray[np.float64] | None:
    """Return a side as a cubic, (4, 2), from a point to another one, which may be known; None if it is not valid.

    Examples
    --------
    >>> side_curve("c 1 0 2,1", (0.0, 0.0), (3.0, 1.0)).tolist()
    [[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [3.0, 1.0]]
    >>> side_curve("L 3,3", (0.0, 0.0), None)[1].tolist()
    [1.0, 1.0]
    """
    match = SIDE.fullmatch(text)
    if match is None:
        return None
    letter, values = match[1], [bounded_number(value) for value in NUMBERS.findall(match[2])]
    points = np.array(values[: len(values) // 2 * 2]).reshape(-1, 2) + (start if letter.islower() else (0.0, 0.0))
    inner = 2 if letter in "cC" else 0
    last = points[inner] if len(points) > inner else None
    if end is not None:
        last = np.array(end)
    if len(points) < inner or last is None:
        return None
    begin = np.array(start)
    controls = points[:2] if inner else begin + (last - begin) * np.array([[1.0], [2.0]]) / 3.0
    return np.concatenate([begin[None], controls, last[None]])
