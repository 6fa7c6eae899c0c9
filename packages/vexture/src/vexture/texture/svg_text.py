"""Outlines as an SVG document, in the units of their source."""

import math
import re
from collections.abc import Iterable
from xml.sax.saxutils import escape

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.convert import straight
from vexture.drawing.paint import Paint
from vexture.texture.root import Root

DIGITS = 9
"""Decimal digits of a coordinate, in unit-square units: finer than the lattices of all but the smallest leaves."""

NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def svg_document(shapes: Iterable[tuple[Root, list[NDArray[np.float64]]]], name: str) -> str:
    """SVG document with the title `name` and a path for each shape, given by its closed contours in unit-square units.

    The view box holds the unit square of every shape. A source whose y points up is flipped by a `transform`.
    """
    paths, corners, digits = [], [], 0
    for root, contours in shapes:
        matrix = root.to_source
        places = _places(matrix)
        digits = max(digits, places)
        upwards = np.linalg.det(matrix[:, :2]) > 0.0
        square = np.array([(0, 0, 1), (1, 0, 1), (0, 1, 1), (1, 1, 1)]) @ matrix.T
        corners.append(square * (1, -1) if upwards else square)
        turn = ' transform="scale(1 -1)"' if upwards else ""
        data = "".join(
            _contour(contour @ matrix[:, :2].T + matrix[:, 2], straight(contour), places) for contour in contours
        )
        paths.append(f'<path{_fill(root.paint)}{turn} d="{data}"><title>{_text(root.name)}</title></path>\n')
    low, high = np.concatenate(corners).min(axis=0), np.concatenate(corners).max(axis=0)
    box = " ".join(_number(value, digits) for value in (*low, *(high - low)))
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">\n<title>{_text(name)}</title>\n'
    return head + "".join(paths) + "</svg>\n"


def _places(matrix: NDArray[np.float64]) -> int:
    """Digits after the decimal point of a coordinate."""
    scale = float(abs(matrix[:, :2]).max())
    return max(DIGITS - math.floor(math.log10(scale)), 0) if scale > 0.0 else 0


def _number(value: float, places: int) -> str:
    text = f"{value:.{places}f}"
    text = text.rstrip("0").rstrip(".") if places else text
    return "0" if text == "-0" else text


def _contour(cubics: NDArray[np.float64], is_line: NDArray[np.bool_], places: int) -> str:
    """Path data of one contour."""
    (x, y), data = cubics[0, 0], []
    for cubic, line in zip(cubics, is_line, strict=True):
        points = cubic[3:] if line else cubic[1:]
        data.append(("L" if line else "C") + " ".join(_number(value, places) for value in points.flat))
    if is_line[-1]:
        data.pop()  # Z draws it
    return f"M{_number(x, places)} {_number(y, places)}{''.join(data)}Z"


def _fill(paint: Paint | None) -> str:
    if paint is None:
        return ""
    levels = [255.0 * part for part in paint.color]
    if all(abs(level - round(level)) < 1e-9 for level in levels):
        color = "#" + "".join(f"{round(level):02x}" for level in levels)
    else:
        color = "rgb(" + ",".join(f"{_number(100.0 * part, DIGITS)}%" for part in paint.color) + ")"
    opacity = "" if paint.opacity == 1.0 else f' fill-opacity="{_number(paint.opacity, DIGITS)}"'
    return f' fill="{color}"{opacity}'


def _text(text: str) -> str:
    """Text with XML's special characters escaped and forbidden ones replaced."""
    return escape(NOT_IN_XML.sub("\ufffd", text))
