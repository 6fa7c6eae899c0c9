"""Snapping: borders that polygons were meant to share become identical, and nothing else changes."""

import json

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

import vexture
from vexture.base.errors import ParameterError
from vexture.base.notes import Notes
from vexture.conversion.reading import read_drawing
from vexture.tree.planar.build import build_map
from vexture_geo.base.snap import DEFAULT_SNAP, MOST_SNAP, snap_borders

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def voronoi(count, seed):
    rng = np.random.default_rng(seed)
    cells = shapely.voronoi_polygons(shapely.multipoints(rng.random((count, 2)))).geoms
    unit = shapely.box(0, 0, 1, 1)
    return [shapely.get_coordinates(cell.intersection(unit))[:-1] for cell in cells]


def moved(rings, by, seed=0):
    rng = np.random.default_rng(seed)
    return [np.clip(ring + rng.uniform(-by, by, ring.shape), 0, 1) for ring in rings]


def geojson(rings, colours=True):
    rng = np.random.default_rng(1)
    features = [
        {
            "type": "Feature",
            "properties": {"fill": f"#{rng.integers(1 << 24):06x}"} if colours else {},
            "geometry": {"type": "Polygon", "coordinates": [[*np.asarray(ring).tolist(), list(map(float, ring[0]))]]},
        }
        for ring in rings
    ]
    return json.dumps({"type": "FeatureCollection", "features": features}).encode()


def snap(rings, distance=None, size=1.0):
    notes = Notes()
    ends = np.cumsum([len(ring) for ring in rings])
    points, after = snap_borders(np.concatenate(rings), ends, size, distance, notes)
    return np.split(points, after[:-1]), notes.in_order


def texels(content, distance=None):
    drawing = read_drawing(content, snap=distance)
    return build_map(drawing).texels, drawing.notes


@pytest.mark.parametrize(("by", "distance", "worst"), [(1e-6, None, 1.1), (1e-4, 2.9e-4, 2.5)])
def test_a_map_of_foreign_polygons_costs_what_it_would_with_common_corners(by, distance, worst):
    rings = voronoi(150, 3)
    clean, notes = texels(geojson(rings))
    assert not notes
    foreign = geojson(moved(rings, by))
    with_slivers, none = texels(foreign, 0)
    again, (told,) = texels(foreign, distance)
    assert not none
    assert with_slivers > worst * clean
    assert again - clean < 0.2 * (with_slivers - clean)
    assert told.kind == "remark"
    assert "corners snapped to borders beside them, by up to" in told.message


def test_sides_get_the_corners_of_their_neighbours():
    turn = np.array([[np.cos(0.3), np.sin(0.3)], [-np.sin(0.3), np.cos(0.3)]])
    bricks = [
        np.round((np.array([(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]) / 9) @ turn, 6)
        for y in range(5)
        for x in np.arange(5) + 0.37 * (y % 2)
    ]
    rings, _ = snap(bricks)
    sides = [{tuple(map(tuple, side)) for side in zip(ring, np.roll(ring, -1, axis=0), strict=True)} for ring in rings]
    listed = [side for own in sides for side in own]
    shared = [side for side in listed if side[::-1] in listed]
    assert len(shared) == 2 * (5 * 4 + 4 * 9)  # beside one another, and above: nine parts on each of four courses


def test_what_one_ring_has_by_itself_stays():
    fine = [(0, 0), (1e-7, 0), (2e-7, 1e-7), (1, 0), (1, 1), (1 - 1e-7, 1), (1e-7, 1e-8), (0, 1)]
    rings, notes = snap([np.array(fine, float), np.array(SQUARE, float) + 2])
    assert rings[0].tolist() == [list(point) for point in fine]
    assert not notes


def test_rings_narrower_than_the_distance_vanish():
    rings, _ = snap([np.array(SQUARE, float), np.array([(1, 0), (1.0005, 0), (1.0005, 1), (1, 1)])], 0.001)
    assert [len(ring) for ring in rings] == [4, 0]
    drawing = vexture.read(geojson([SQUARE, [(0.2, 0.2), (0.2, 0.2005), (0.2005, 0.2)], [(0.2, 0.2)] * 3]), snap=0)
    assert len(drawing.paths) == 2


corner = st.tuples(*[st.builds(lambda k, d: k / 6 + d, st.integers(0, 6), st.floats(-0.004, 0.004))] * 2)


@given(st.lists(st.lists(corner, min_size=3, max_size=6), min_size=2, max_size=5), st.sampled_from([1e-3, 1e-2]))
def test_an_area_changes_only_along_its_outline(polygons, distance):
    rings = [np.array(ring) for ring in polygons]
    assume(all(shapely.Polygon(ring).area > 1e-9 for ring in rings))
    after, _ = snap(rings, distance)
    reach = 6 * distance  # up to five rounds of corners, after one of moves
    for old, new in zip(rings, after, strict=True):
        before = shapely.make_valid(shapely.Polygon(old))
        now = shapely.make_valid(shapely.Polygon(new)) if len(new) else shapely.Polygon()
        if shapely.is_valid(shapely.Polygon(old)):  # what a ring that crosses itself encloses may change by any move
            assert shapely.buffer(before.symmetric_difference(now), -reach).is_empty
        outline = shapely.linearrings(old)
        assert all(shapely.distance(outline, shapely.points(corner)) <= reach for corner in new)


def test_far_too_many_corners_stay_as_they_are():
    rng = np.random.default_rng(2)
    ring = [np.array(SQUARE, float), *(rng.random((300, 2)) * 1e-5 for _ in range(4))]
    rings, (told,) = snap(ring, 1e-3)
    assert all((old == new).all() for old, new in zip(ring, rings, strict=True))
    assert "give a smaller `snap`" in told.message


def test_borders_of_wet_areas_are_snapped_too():
    left, right = SQUARE, [(1.000001, 0), (2, 0), (2, 1), (1.000001, 1)]
    content = geojson([left, right], colours=False)
    with pytest.warns(vexture.base.errors.SourceWarning, match="2 corners snapped"):
        extent = vexture.read_extent(content, "lake.geojson")
    ends = np.concatenate([contour[:, 0] for contour in extent.steps[0].drawing.paths[0].contours])
    assert len(np.unique(ends, axis=0)) == 6
    extent = vexture.read_extent(content, "lake.geojson", snap=0)
    ends = np.concatenate([contour[:, 0] for contour in extent.steps[0].drawing.paths[0].contours])
    assert len(np.unique(ends, axis=0)) == 8


@pytest.mark.parametrize("distance", [-1e-9, 2 * MOST_SNAP, float("nan")])
def test_a_distance_is_in_range(distance):
    with pytest.raises(ParameterError, match=r"`snap` is .*; it must be in 0..0.01"):
        vexture.read(geojson([SQUARE]), snap=distance)


def test_snapping_is_for_maps():
    with pytest.raises(ParameterError, match="`snap` 3e-06 is for the borders of polygons in a map; leave it out"):
        vexture.read(b'<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></svg>', snap=DEFAULT_SNAP)
