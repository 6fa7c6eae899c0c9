"""Rings fitted by cubics, against the shapes that were rasterised."""

import tracemalloc

import contourpy
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from vexture.bezier.fit_closed import fit_closed

SAMPLES = np.linspace(0.0, 1.0, 24, endpoint=False)[:, None]
CELL_SHARE = 0.55


def along(cubics):
    """Points along a closed contour."""
    t, s = SAMPLES, 1.0 - SAMPLES
    p0, p1, p2, p3 = (cubics[:, None, k] for k in range(4))
    return (s**3 * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t**3 * p3).reshape(-1, 2)


def turns(cubics):
    """Degrees by which the direction changes where cubics meet."""
    before, after = cubics[:, 3] - cubics[:, 2], np.roll(cubics[:, 1] - cubics[:, 0], -1, axis=0)
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.abs(np.degrees(np.arctan2(cross, (before * after).sum(axis=1))))


def area(points):
    after = np.roll(points, -1, axis=0)
    return (points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0]).sum() / 2


def stairs(inside):
    """Contours of a raster that is 1 or -1."""
    lines = contourpy.contour_generator(z=np.where(inside, 1.0, -1.0)).lines(0.0)
    return [line[:-1] for line in lines]


@pytest.mark.parametrize("size", [64, 128, 256, 512])
def test_a_disc_loses_its_staircase(size):
    y, x = np.mgrid[0:size, 0:size]
    middle, radius = np.array([0.5 * size + 0.3, 0.5 * size - 0.2]), 0.37 * size
    (ring,) = stairs(np.hypot(x - middle[0], y - middle[1]) < radius)
    cubics = fit_closed(ring, CELL_SHARE)
    off = np.abs(np.hypot(*(along(cubics) - middle).T) - radius)
    assert off.max() < 0.45
    assert np.sqrt((off**2).mean()) < 0.14 < 0.23 < np.sqrt(((np.hypot(*(ring - middle).T) - radius) ** 2).mean())
    assert len(cubics) <= max(6, len(ring) / 25)
    assert turns(cubics).max() < 0.01


@pytest.mark.parametrize("size", [64, 128, 256, 512])
def test_both_banks_of_a_winding_river_lose_their_staircase(size):
    y, x = np.mgrid[0:size, -20 : size + 20]
    wave = 3.0 * np.pi / size
    half = max(2.5, 0.05 * size)

    def banks(east):
        across = np.sqrt(1.0 + (0.2 * size * wave * np.cos(wave * east)) ** 2)
        return 0.5 * size + 0.2 * size * np.sin(wave * east), half * across

    middle, reach = banks(x)
    polygons = contourpy.contour_generator(
        x=x[0].astype(float),
        y=y[:, 0].astype(float),
        z=np.where(np.abs(y - middle) < reach, 1.0, -1.0),
        fill_type="OuterOffset",
    )
    points, _ = polygons.filled(0.0, np.inf)
    ring = points[0][:-1]
    cubics = fit_closed(ring, CELL_SHARE)
    fitted = along(cubics)
    fitted = fitted[(fitted[:, 0] > 0) & (fitted[:, 0] < size - 1)]
    east = np.linspace(-20, size + 20, 40 * size)
    middle, reach = banks(east)
    truth = shapely.MultiLineString([np.column_stack([east, middle + side * reach]) for side in (1, -1)])
    off = shapely.distance(shapely.points(fitted), truth)
    assert off.max() < 0.6
    assert np.sqrt((off**2).mean()) < 0.22
    assert len(cubics) < len(ring) / 15
    assert np.sort(turns(cubics))[-5] < 0.01  # the four corners at its ends aside


def test_what_is_smooth_already_is_followed_closely():
    angle = np.linspace(0.0, 2.0 * np.pi, 300, endpoint=False)
    radius = 30.0 + 4.0 * np.cos(5.0 * angle)
    flower = radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    fitted = along(fit_closed(flower, CELL_SHARE))
    off = np.abs(np.hypot(*fitted.T) - 30.0 - 4.0 * np.cos(5.0 * np.arctan2(fitted[:, 1], fitted[:, 0])))
    assert off.max() < 0.25 * CELL_SHARE


def test_corners_that_a_raster_cut_off_come_back():
    y, x = np.mgrid[0:40, 0:60]
    (ring,) = stairs((x >= 10) & (x < 50) & (y >= 8) & (y < 30))
    cubics = fit_closed(ring, CELL_SHARE)
    corners = cubics[turns(np.roll(cubics, 1, axis=0)) > 45.0, 0]
    assert np.allclose(
        sorted(map(tuple, corners.round(3))), [(9.5, 7.5), (9.5, 29.5), (49.5, 7.5), (49.5, 29.5)], atol=0.05
    )
    assert len(cubics) <= 8


def test_fixed_points_are_kept_as_corners():
    angle = np.linspace(0.0, 2.0 * np.pi, 100, endpoint=False)
    circle = 10.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    fixed = np.zeros(100, bool)
    fixed[[13, 57]] = True
    starts = fit_closed(circle, CELL_SHARE, fixed=fixed)[:, 0]
    assert all((starts == circle[k]).all(axis=1).any() for k in (13, 57))


@pytest.mark.parametrize("radius", [0.3, 0.5, 1.0, 2.0])
def test_small_islands_survive_at_about_their_size(radius):
    diamond = radius * np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    for ring in (diamond, diamond[::-1]):
        assert area(along(fit_closed(ring, CELL_SHARE))) / area(ring) == pytest.approx(1.0, abs=0.35)


def test_rings_that_enclose_nothing_are_none():
    for ring in ([[0.0, 0.0], [1.0, 0.0]], [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], [[3.0, 3.0]] * 5):
        assert fit_closed(np.array(ring), 0.5).shape == (0, 4, 2)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.floats(0.4, 1.0), min_size=6, max_size=24),
    st.sampled_from([6.0, 20.0, 60.0]),
    st.booleans(),
)
def test_any_ring_is_followed_within_the_tolerance(shares, size, rounded):
    angle = np.linspace(0.0, 2.0 * np.pi, len(shares), endpoint=False)
    ring = size * np.array(shares)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    if rounded:
        y, x = np.mgrid[-size - 2 : size + 3, -size - 2 : size + 3]
        inside = shapely.contains_xy(shapely.Polygon(ring), x.ravel(), y.ravel()).reshape(x.shape)
        ring = max(stairs(inside), key=len, default=ring)
    cubics = fit_closed(ring, CELL_SHARE)
    assert (cubics[:, 0] == np.roll(cubics[:, 3], 1, axis=0)).all()
    fitted = along(cubics)
    # samples are a tolerance apart, so that a corner between them may be cut by half of that again
    assert shapely.distance(shapely.points(fitted), shapely.LinearRing(ring)).max() <= 1.5 * CELL_SHARE
    assert shapely.distance(shapely.points(ring), shapely.LinearRing(fitted)).max() <= 2.0 * CELL_SHARE


def test_a_needle_takes_little_memory():
    """The thinner a chain, the finer it is sampled, within a limit: a damaged mesh has needles around the world."""
    needle = np.array([[0.0, 0.0], [0.5, 1e-7], [1.0, 0.0], [0.5, -1e-7]])
    tracemalloc.start()
    try:
        cubics = fit_closed(needle, 0.1)
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert most < 100e6
    assert len(cubics)
    assert np.abs(along(cubics)[:, 1]).max() < 1e-5
