"""Distances from an outline, and the first samples of the thesis."""

import numpy as np
import pytest

from vexture.drawing.drawing import Drawing, Path
from vexture_evidence.measures.outline import first_samples, off_outline

QUARTER = Drawing.polygon([(0.1, 0.1), (0.4, 0.1), (0.4, 0.35), (0.1, 0.35)])
CIRCLE = 0.5522847498


def disc(radius=0.3):
    """Four cubics that are a circle but for 3e-4 of its radius."""
    quarter = radius * np.array([(1.0, 0.0), (1.0, CIRCLE), (CIRCLE, 1.0), (0.0, 1.0)])
    turn = np.array([(0.0, 1.0), (-1.0, 0.0)])
    cubics = np.stack([quarter @ np.linalg.matrix_power(turn, k) for k in range(4)]) + 0.5
    cubics[:, 3] = np.roll(cubics[:, 0], -1, axis=0)
    return Drawing((Path((cubics,)),))


def test_distances_from_an_outline_are_those_of_the_circle():
    rng = np.random.default_rng(6)
    points = rng.uniform(0.0, 1.0, (200, 2))
    radial = abs(np.hypot(*(points - 0.5).T) - 0.3)
    assert np.allclose(off_outline(points, disc()), radial, atol=1e-4)


def test_distances_of_points_far_from_everything_are_those_of_the_nearest_chord():
    tiny = Drawing.polygon([(0.9, 0.9), (0.91, 0.9), (0.91, 0.91)])
    assert off_outline(np.array([(0.0, 0.9), (0.9, 0.0), (0.905, 0.9)]), tiny) == pytest.approx([0.9, 0.9, 0.0])


def test_nearest_chord_is_found_beyond_the_margin():
    right = [(0.53, 0.4), (0.53, 0.6), (0.56, 0.5)]
    left = [(0.4834, 0.4), (0.4834, 0.6), (0.45, 0.5)]
    point = np.array([(0.5001, 0.5)])
    assert off_outline(point, Drawing.polygon(right)) == pytest.approx([0.0299])
    assert off_outline(point, Drawing.polygon(right, left)) == pytest.approx([0.0167])


@pytest.mark.parametrize("off", [1e-3, 1e-7])
def test_distances_are_found_to_rounding(off):
    cubic = np.array([(0.1, 0.1), (0.1, 0.1001), (0.9, 0.2), (0.9, 0.9)])  # starts slowly
    back = np.linspace(cubic[3], cubic[0], 4)
    t = np.linspace(0.01, 0.99, 33)[:, None]
    s = 1.0 - t
    p0, p1, p2, p3 = cubic
    point = s**3 * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t**3 * p3
    tangent = 3 * s * s * (p1 - p0) + 6 * s * t * (p2 - p1) + 3 * t * t * (p3 - p2)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1) / np.linalg.norm(tangent, axis=1)[:, None]
    drawing = Drawing((Path((np.stack([cubic, back]),)),))
    assert off_outline(point + off * normal, drawing) == pytest.approx(off, rel=1e-6)


def test_first_samples_lie_on_the_outline_and_are_as_dense_as_the_thesis_has_them():
    points = first_samples(QUARTER)
    assert off_outline(points, QUARTER).max() < 1e-12
    assert len(points) == sum(np.ceil(256 * side).astype(int) for side in (0.3, 0.25, 0.3, 0.25))
