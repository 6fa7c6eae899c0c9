"""Borders as arcs: what two polygons share is simplified once, and stays shared."""

import numpy as np
import pytest
import shapely

from vexture_geo.tiles.generalise import simplify_borders

BOX = (-1.0, -1.0, 101.0, 101.0)


def neighbours(wave):
    """Two halves of a square of 100 m with a wavy border of many points between them."""
    y = np.linspace(0.0, 100.0, 401)
    border = np.stack([50.0 + wave * np.sin(y), y], axis=1)
    west = shapely.Polygon([(0, 0), *border, (0, 100)])
    east = shapely.Polygon([*border[::-1], (100, 0), (100, 100)])
    return np.array([west, shapely.normalize(east)])


def test_a_shared_border_stays_shared_and_moves_no_farther_than_the_tolerance():
    before = neighbours(0.4)
    west, east = simplify_borders(before, BOX, 1.0, 0.0)
    assert shapely.get_num_coordinates([west, east]).tolist() == [5, 5]
    assert west.area + east.area == pytest.approx(10_000.0)
    assert shapely.intersection(west, east).area == 0.0
    assert shapely.hausdorff_distance(shapely.boundary(west), shapely.boundary(before[0])) <= 1.0


def test_a_border_that_moves_more_keeps_its_waves():
    before = neighbours(3.0)
    found = simplify_borders(before, BOX, 0.5, 0.0)
    assert shapely.coverage_is_valid(found)
    assert 32 < shapely.get_num_coordinates(found[0]) < 100  # of 32 crests
    assert shapely.hausdorff_distance(shapely.boundary(found), shapely.boundary(before)).max() <= 0.5


def test_corners_on_the_box_stay():
    zigzag = shapely.Polygon([(0, 0), (10, 0.1), (20, 0), (20, 20), (0, 20)])
    (within,) = simplify_borders(np.array([zigzag]), (-1.0, -1.0, 21.0, 21.0), 1.0, 0.0)
    (on_it,) = simplify_borders(np.array([zigzag]), (-1.0, 0.1, 21.0, 21.0), 1.0, 0.0)
    assert not shapely.intersects_xy(shapely.boundary(within), 10.0, 0.1)
    assert shapely.intersects_xy(shapely.boundary(on_it), 10.0, 0.1)


def test_small_holes_and_thin_polygons_go():
    holed = shapely.box(0, 0, 50, 50) - shapely.box(10, 10, 12, 12) - shapely.box(20, 20, 30, 30)
    thin = shapely.Polygon([(60, 0), (99, 0.2), (60, 0.4)])
    found = simplify_borders(np.array([holed, thin]), BOX, 1.0, 5.0)
    assert found[0].area == pytest.approx(2500.0 - 100.0)
    assert found[1].is_empty
