"""Strokes of shapes: within 1e-5 of the drawing, joined and capped by their style."""

import numpy as np
import pytest

from vexture.base.tolerance import ROUND
from vexture.bezier.convert import ellipse_cubics
from vexture.svg.outline import ShapeOutline
from vexture.svg.strokes import Stroke, dash_count, stroke_contours

T = np.linspace(0, 1, 41)[:, None]


def points_on(cubics: np.ndarray) -> np.ndarray:
    s = 1 - T
    p0, p1, p2, p3 = np.moveaxis(cubics[:, None], 2, 0)
    return (s**3 * p0 + 3 * s * s * T * p1 + 3 * s * T * T * p2 + T**3 * p3).reshape(-1, 2)


def line(*points: tuple[float, float], closed: bool = False) -> ShapeOutline:
    return ShapeOutline.polygon(np.array(points, dtype=np.float64), closed)


def area(contours: list[np.ndarray]) -> float:
    """Signed area, from many points."""
    total = 0.0
    for contour in contours:
        x, y = points_on(contour).T
        total += float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)
    return total


@pytest.mark.parametrize("radius", [40.0, 10.0, 1.0, 0.1])
@pytest.mark.parametrize("center", [50.0, -3000.0])
def test_a_stroked_circle_is_round(radius: float, center: float) -> None:
    circle = ShapeOutline(ellipse_cubics((center, center), (radius, radius), 1e-4), closed=True)
    outer, inner = stroke_contours([circle], Stroke(radius / 5), 100.0)
    for contour, expected in ((outer, radius * 1.1), (inner, radius * 0.9)):
        distance = np.hypot(*(points_on(contour) - center).T)
        error = min(np.abs(distance - expected).max(), np.abs(distance - radius * 2 + expected).max())
        assert error < ROUND * 100.0
        assert (contour[:, 3] == np.roll(contour[:, 0], -1, axis=0)).all()


def test_a_stroked_curve_keeps_its_distance() -> None:
    curve = np.array([[[10.0, 10.0], [10.0, 90.0], [90.0, 90.0], [90.0, 20.0]]])
    t = np.linspace(0, 1, 20001)[:, None]
    s = 1 - t
    middle = s**3 * curve[0, 0] + 3 * s * s * t * curve[0, 1] + 3 * s * t * t * curve[0, 2] + t**3 * curve[0, 3]
    (contour,) = stroke_contours([ShapeOutline(curve, closed=False)], Stroke(8.0), 100.0)
    bent = contour[~np.isclose(contour[:, 0], contour[:, 3]).all(axis=1)]
    distance = np.array([np.hypot(*(middle - point).T).min() for point in points_on(bent)])
    assert distance.max() < 4.0 + ROUND * 100.0
    side = distance[distance > 3.9]
    assert len(side) > 300
    assert side.min() > 4.0 - ROUND * 100.0 - 1e-4 or np.quantile(side, 0.05) > 4.0 - ROUND * 100.0


@pytest.mark.parametrize(("cap", "expected"), [("butt", 80.0), ("square", 96.0), ("round", 80.0 + np.pi * 4.0)])
def test_caps(cap: str, expected: float) -> None:
    contours = stroke_contours([line((0, 0), (20, 0))], Stroke(4.0, cap), 20.0)
    assert abs(area(contours)) == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize(("cap", "expected"), [("butt", 0.0), ("square", 16.0), ("round", np.pi * 4.0)])
def test_a_point_has_only_its_cap(cap: str, expected: float) -> None:
    contours = stroke_contours([line((5, 5))], Stroke(4.0, cap), 20.0)
    assert abs(area(contours)) == pytest.approx(expected, rel=2e-4, abs=1e-9)  # 2e-4 is the accuracy, of 20 * 1e-5


@pytest.mark.parametrize(
    ("join", "limit", "tip"),
    [("miter", 4.0, 2 * 2**0.5), ("miter", 1.2, 2**0.5), ("bevel", 4.0, 2**0.5), ("round", 4.0, 2.0)],
)
def test_joins(join: str, limit: float, tip: float) -> None:
    """How far a right angle reaches beyond its corner, along the diagonal."""
    contours = stroke_contours([line((-20, -20), (0, 0), (20, -20))], Stroke(4.0, "butt", join, limit), 40.0)
    assert max(points_on(contour)[:, 1].max() for contour in contours) == pytest.approx(tip, abs=1e-3)


def test_steps_without_length_make_no_joins() -> None:
    """Rounding in relative path data must not point a miter anywhere."""
    plain = stroke_contours([line((0, 0), (10, 0), (10, 10))], Stroke(2.0), 20.0)
    noisy = stroke_contours([line((0, 0), (10, 0), (10 + 2e-6, -3e-6), (10, 10), (10, 10))], Stroke(2.0), 20.0)
    assert [len(contour) for contour in noisy] == [len(contour) for contour in plain]
    assert abs(area(noisy)) == pytest.approx(abs(area(plain)), rel=1e-6)


@pytest.mark.parametrize("end", [(80.0, 0.0), (80.0, 0.01)])
def test_dashes(end: tuple[float, float]) -> None:
    contours = stroke_contours([line((0, 0), end)], Stroke(6.0, dashes=(8.0, 8.0)), 100.0)
    assert len(contours) == 5
    assert sum(abs(area([contour])) for contour in contours) == pytest.approx(5 * 8 * 6, rel=1e-4)
    starts = sorted(contour[..., 0].min() for contour in contours)
    np.testing.assert_allclose(starts, [0, 16, 32, 48, 64], atol=2e-2)


def test_a_shape_of_several_subpaths_starts_its_dashes_anew() -> None:
    lines = [line((0, y), (20, y)) for y in (0, 10)]
    contours = stroke_contours(lines, Stroke(2.0, dashes=(6.0, 4.0), dash_offset=-2.0), 100.0)
    assert sorted(contour[..., 0].min() for contour in contours) == pytest.approx([2.0, 2.0, 12.0, 12.0])


def test_dashes_are_counted_up_to_a_limit() -> None:
    assert dash_count([line((0, 0), (80, 0))], Stroke(1.0, dashes=(5e-6, 5e-6))) == 8_000_000
    assert dash_count([line((0, 0), (80, 0)), line((0, 0), (20, 0))], Stroke(1.0, dashes=(1.0, 1.0, 2.0, 0.0))) == 50
    assert dash_count([line((0, 0), (80, 0))], Stroke(1.0, dashes=(1e-320, 0.0))) == 10**15
