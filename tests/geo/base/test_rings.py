"""Rings of many polygons: what is done to them is what shapely does to each polygon."""

import numpy as np
import pytest
import shapely

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.base.rings import cut, orient_rings, refuse_far, repair_rings, rings_of, within

HOLED = shapely.Polygon(
    [(0, 0), (6, 0), (6, 6), (0, 6)], [[(1, 1), (2, 1), (2, 2), (1, 2)], [(3, 3), (5, 3), (5, 5), (3, 5)]]
)
TRIANGLE = shapely.Polygon([(10, 0), (14, 0), (10, 2)])
FAR = shapely.box(20, 20, 21, 23)
SHAPES = np.array([HOLED, shapely.Polygon(), TRIANGLE, FAR])


def rings():
    return rings_of(SHAPES, lambda index: f"polygon {index}", np.array([7, 8, 9, 9]))


def test_polygons_go_in_and_come_out():
    found = rings()
    assert found.ends.tolist() == [4, 8, 12, 15, 19]
    assert found.polygon.tolist() == [0, 0, 0, 1, 2]
    assert found.feature.tolist() == [7, 9, 9]
    assert found.box == (0.0, 0.0, 21.0, 23.0)
    assert shapely.equals(found.shapes, SHAPES[[0, 2, 3]]).all()


def test_messages_name_a_polygon_and_its_ring_by_the_source():
    found = rings()
    assert [found.ring_name(point) for point in (0, 4, 11, 12)] == [
        "polygon 0, ring 1",
        "polygon 0, ring 2",
        "polygon 0, ring 3",
        "polygon 2, ring 1",
    ]
    found.points[9] = np.nan
    with pytest.raises(SourceError, match="polygon 0, ring 3: a point is at nan,nan; the limit is 1e"):
        refuse_far(found, "correct it")


def test_some_polygons_in_another_order_and_then_others():
    found = rings().take(np.array([2, 0])).concatenate(rings().take(np.array([1])))
    assert shapely.equals(found.shapes, np.array([FAR, HOLED, TRIANGLE])).all()
    assert found.feature.tolist() == [9, 7, 9]
    assert [found.place(index) for index in range(3)] == ["polygon 3", "polygon 0", "polygon 2"]


def test_outer_rings_are_counter_clockwise_and_holes_clockwise():
    turned = rings_of(shapely.reverse(SHAPES), str)
    for each in (rings(), turned):
        oriented = orient_rings(each)
        lines = [shapely.LinearRing(part) for part in np.split(oriented.points, oriented.ends[:-1])]
        assert [line.is_ccw for line in lines] == [True, False, False, True, True]
        assert shapely.equals(oriented.shapes, SHAPES[[0, 2, 3]]).all()


def test_polygons_are_cut_to_a_box_and_keep_their_features():
    box = (0.5, 1.5, 12.0, 4.0)
    found = cut(rings().take(np.array([0, 1])), box)
    wanted = shapely.intersection(SHAPES[[0, 2]], shapely.box(*box))
    area = np.bincount(found.feature, shapely.area(found.shapes), 10)
    assert area[[7, 9]] == pytest.approx(shapely.area(wanted))


def test_in_longitudes_polygons_a_turn_away_are_in_the_box_too():
    east = rings_of(np.array([shapely.box(170, 0, 185, 5), shapely.box(0, 0, 5, 5)]), str)
    assert not len(within(east, (-180.0, -10.0, -150.0, 10.0), None).ends)
    found = within(east, (-180.0, -10.0, -150.0, 10.0), 360.0)
    assert found.box == (-190.0, 0.0, -175.0, 5.0)


def test_broken_polygons_are_repaired_and_empty_ones_noted():
    bow, flat = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)]), shapely.Polygon([(5, 5), (6, 6), (7, 7)])
    notes = Notes()
    found = repair_rings(rings_of(np.array([TRIANGLE, bow, flat]), str, np.arange(3)), notes)
    assert np.bincount(found.feature, shapely.area(found.shapes), 3) == pytest.approx([4.0, 2.0, 0.0])
    assert shapely.is_valid(found.shapes).all()
    assert [(note.message, note.count) for note in notes.in_order] == [("polygon that encloses nothing", 1)]
