"""Shorelines of grids of depths, against beaches, basins and channels whose shore is known."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from vexture.renderers.exact import render_exact
from vexture_geo.depth.contours import shore_values, wet_drawing

HMIN = 0.05  # typed again: the oracle
T = np.linspace(0.0, 1.0, 24, endpoint=False)[:, None]


def rings(drawing):
    found = []
    for path in drawing.paths:
        for cubics in path.contours:
            p0, p1, p2, p3 = (cubics[:, None, k] for k in range(4))
            s = 1.0 - T
            found.append((s**3 * p0 + 3 * s * s * T * p1 + 3 * s * T * T * p2 + T**3 * p3).reshape(-1, 2))
    return found


def outline(above, **options):
    """Rings of a square grid in its cells, the first sample's middle at (0, 0)."""
    size = max(above.shape)
    drawing = wet_drawing(above, lambda places: (places + 0.5) / size, **options)
    return [ring * size - 0.5 for ring in rings(drawing)]


def wet_area(found):
    return abs(sum(shapely.Polygon(ring).area * (1 if shapely.LinearRing(ring).is_ccw else -1) for ring in found))


def beach(size=60, angle=0.4, slope=0.4):
    """Height of a plane that rises to the upper right, and how far each sample is from the shore, in cells."""
    y, x = np.mgrid[0:size, 0:size]
    away = (x - size / 2) * np.cos(angle) + (y - size / 2) * np.sin(angle)
    return slope * away, away


def shore_error(above, angle, shore):
    """Largest and mean distance of the outline from a straight shore, off the border, in cells."""
    (ring,) = outline(above)
    size = above.shape[0]
    ring = ring[((ring > 4) & (ring < size - 5)).all(axis=1)]
    off = (ring - size / 2) @ (np.cos(angle), np.sin(angle)) - shore
    return np.abs(off).max(), off.mean()


@pytest.mark.parametrize("angle", [0.0, 0.2, 0.4, 0.785, 1.3])
def test_the_shore_of_a_beach_is_found_within_the_cell(angle):
    bed, _ = beach(angle=angle)
    depth, shore = np.maximum(1.5 - bed, 0.0), (1.5 - HMIN) / 0.4
    before, _ = shore_error(depth - HMIN, angle, shore)
    slope_only, _ = shore_error(shore_values(depth, HMIN), angle, shore)
    with_bed, _ = shore_error(shore_values(depth, HMIN, bed), angle, shore)
    assert with_bed < 0.12  # of which the fit may have 0.11
    assert slope_only < 0.12
    assert before > 0.2  # straight lines from depths to 0 put it too far out


@pytest.mark.parametrize("nothing", [0.0, np.nan, 0.001])
def test_however_a_file_writes_dry_the_shore_is_the_same(nothing):
    bed, _ = beach()
    depth = np.maximum(1.5 - bed, 0.0)
    dry = depth == 0.0
    depth[dry] = nothing
    assert shore_error(shore_values(depth, HMIN, bed), 0.4, 1.45 / 0.4)[0] < 0.12


def test_a_wall_is_halfway_between_wet_and_dry():
    depth = np.where(np.arange(20)[None] < 12, 3.0, 0.0) * np.ones((20, 1))
    (ring,) = outline(shore_values(depth, HMIN))
    assert ring[:, 0].max() == pytest.approx(11.5, abs=1e-6)


def test_low_ground_behind_a_dike_stays_dry():
    bed = np.where(np.arange(20)[None] < 12, 0.0, -2.0) * np.ones((20, 1))
    depth = np.where(np.arange(20)[None] < 12, 1.0, 0.0) * np.ones((20, 1))
    (ring,) = outline(shore_values(depth, HMIN, bed))
    assert ring[:, 0].max() == pytest.approx(11.5, abs=1e-6)


def test_depths_below_zero_are_taken_at_their_word():
    bed, _ = beach()
    deep = np.abs(1.5 - bed) > HMIN
    assert (shore_values(1.5 - bed, HMIN) == 1.5 - bed - HMIN)[deep].all()


@pytest.mark.parametrize("turn", [0.0, 0.3, 0.785])
def test_a_channel_of_one_cell_stays_open(turn):
    size = 50
    y, x = np.mgrid[0:size, 0:size]
    across = (y - 24.8) * np.cos(turn) - (x - 24.8) * np.sin(turn)
    ends = np.hypot(x - 24.8, y - 24.8) < 20
    depth = np.where((np.abs(across) <= 0.75) & ends, 2.0, 0.0)
    found = outline(shore_values(depth, HMIN))
    assert len(found) == 1
    far = np.hypot(*(found[0] - 24.8).T).max()
    assert far > 18.0
    assert shapely.Polygon(found[0]).is_valid
    assert wet_area(found) > 0.5 * (depth > 0).sum()


def test_islands_stay_in_their_lake():
    y, x = np.mgrid[0:60, 0:60]
    depth = np.where(np.hypot(x - 30, y - 30) < 22, 2.0, 0.0)
    depth[30, 30] = depth[20:23, 40] = 0.0
    depth[np.hypot(x - 18, y - 30) < 5.2] = 0.0
    found = outline(shore_values(depth, HMIN))
    lake = max(map(shapely.Polygon, found), key=lambda polygon: polygon.area)
    assert len(found) == 4
    assert all(shapely.Polygon(ring).within(lake) or shapely.Polygon(ring).equals(lake) for ring in found)


def test_what_goes_on_beyond_the_grid_fills_the_square():
    drawing = wet_drawing(np.ones((10, 10)), lambda places: 0.25 + (places + 0.5) / 20, (6.0, 6.0, 0.0, 6.0))
    image = render_exact(drawing, (16, 16))
    assert np.allclose(image, np.arange(16)[None] < 12, atol=1e-6)


def test_nothing_wet_is_a_drawing_without_paths():
    assert wet_drawing(np.full((5, 5), -1.0), lambda places: places / 5).paths == ()


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from([0.6, 2.0, 4.0]), st.booleans())
def test_any_terrain_has_an_outline_near_its_contour(seed, rough, known):
    random = np.random.default_rng(seed)
    size = 40
    waves = random.normal(size=(size, size))
    filter_ = np.exp(-rough * rough * np.hypot(*np.meshgrid(*[np.fft.fftfreq(size) * 2 * np.pi] * 2)) ** 2 / 2)
    bed = np.fft.ifft2(np.fft.fft2(waves) * filter_).real
    depth = np.maximum(-bed / bed.std(), 0.0)
    above = shore_values(depth, HMIN, bed / bed.std() if known else None)
    assert ((above >= 0) == (depth >= HMIN)).all()
    found = outline(above)
    close = outline(above, tolerance=0.05)
    assert len(found) == len(close)
    sides = [side for ring in close for side in np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)]
    tree = shapely.STRtree(shapely.linestrings(sides))
    _, off = tree.query_nearest(shapely.points(np.concatenate(found)[::4]), return_distance=True)
    assert off.max() < 0.8
    for ring in found:
        assert shapely.Polygon(ring).is_valid
