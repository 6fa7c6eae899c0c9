"""Basic shapes: their outlines by the formulas of SVG 2, and lengths that refer to the viewport."""

from math import pi

import numpy as np
import pytest
import shapely

from vexture.drawing.drawing import Drawing
from vexture.svg.read import svg_drawing


def drawn(body: str) -> Drawing:
    root = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100" width="200">'
    return svg_drawing(f"{root}{body}</svg>".encode(), "a.svg")


def box(body: str) -> list[float]:
    """Left, top, right and bottom of the one path of a drawing, in user units."""
    (path,) = drawn(body).paths
    left, low, right, high = (200.0 * path.box).ravel().tolist()
    return [left, 150.0 - high, right, 150.0 - low]


def area(body: str) -> float:
    """Area in square user units, of a polygon of many points of its curves."""
    (path,) = drawn(body).paths
    t = np.arange(64)[:, None] / 64
    weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3]
    points = [sum(weight * point for weight, point in zip(weights, cubic, strict=True)) for cubic in path.contours[0]]
    return float(shapely.Polygon(np.concatenate(points)).area * 200.0**2)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('<rect x="10" y="20" width="30" height="40"/>', [10, 20, 40, 60]),
        ('<rect x="10%" y="10%" width="50%" height="50%"/>', [20, 10, 120, 60]),
        ('<circle cx="50" cy="40" r="30"/>', [20, 10, 80, 70]),
        ('<ellipse cx="50" cy="40" rx="30" ry="auto"/>', [20, 10, 80, 70]),
        ('<ellipse cx="50" cy="40" rx="30" ry="10"/>', [20, 30, 80, 50]),
        ('<polygon points="10,20 30,20 30,50"/>', [10, 20, 30, 50]),
        ('<line x1="10" y1="20" x2="30" y2="20" stroke="red" stroke-width="4"/>', [10, 18, 30, 22]),
        ("<path style=\"d: path('M10 20h30v40z')\"/>", [10, 20, 40, 60]),
    ],
)
def test_shapes_lie_where_their_attributes_say(body: str, expected: list[float]) -> None:
    assert box(body) == pytest.approx(expected, abs=1e-6)


def test_a_radius_in_percent_refers_to_the_diagonal() -> None:
    radius = 0.1 * ((200.0**2 + 100.0**2) / 2.0) ** 0.5
    assert box('<circle cx="50" cy="50" r="10%"/>')[2] == pytest.approx(50.0 + radius)


@pytest.mark.parametrize(
    ("radii", "corners"),
    [
        ('rx="5"', (4 - pi) * 25),
        ('rx="5" ry="10"', (4 - pi) * 50),
        ('ry="10"', (4 - pi) * 100),
        ('rx="500" ry="10"', (4 - pi) * 200),  # cut to half of the width
        ('rx="0" ry="10"', 0.0),
    ],
)
def test_round_corners_take_their_part_of_a_rectangle(radii: str, corners: float) -> None:
    assert area(f'<rect x="10" y="10" width="40" height="60" {radii}/>') == pytest.approx(2400 - corners, rel=2e-4)


@pytest.mark.filterwarnings("ignore::vexture.SourceWarning")
@pytest.mark.parametrize(
    "body",
    [
        *('<rect width="9"/>', '<rect width="-9" height="9"/>', '<circle r="0"/>', '<ellipse rx="9" ry="0"/>'),
        *('<polygon points="1 2"/>', '<path d="none"/>', '<polyline points=""/>'),
    ],
)
def test_shapes_without_a_size_paint_nothing(body: str) -> None:
    assert drawn(body).paths == ()


def test_points_are_used_up_to_their_first_error() -> None:
    drawing = drawn('<polygon points="10 20 30 20 30 50 x 90 90"/>')
    assert [str(note) for note in drawing.notes] == ["points='...x 90 90' of <polygon> in line 1"]
    assert len(drawing.paths[0].contours[0]) == 3


def test_coordinates_that_are_too_large_lose_the_element() -> None:
    drawing = drawn('<polygon points="0 0 1e13 0 0 9"/><rect width="9" height="9"/>')
    assert len(drawing.paths) == 1
    assert "it has a coordinate of 1e+13; the limit is 1e+12" in str(drawing.notes[0])
