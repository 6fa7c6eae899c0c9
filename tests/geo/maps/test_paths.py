"""Paths of a map: in the unit square, one for each feature, in their order."""

import numpy as np
import pytest
import shapely

from vexture_geo.base.rings import rings_of
from vexture_geo.maps.paths import MapFit, area_paths

FIT = MapFit((100.0, 200.0, 300.0, 300.0))


def test_the_box_lies_in_the_middle_at_its_own_shape():
    assert FIT.sides == (1.0, 0.5)
    np.testing.assert_allclose(FIT.inward(np.array([[100.0, 200.0], [300.0, 300.0]])), [[0.0, 0.25], [1.0, 0.75]])
    inside = np.random.default_rng(1).uniform((100, 200), (300, 300), (20, 2))
    back = FIT.inward(inside) @ FIT.to_source[:, :2].T + FIT.to_source[:, 2]
    np.testing.assert_allclose(back, inside)


def test_each_feature_is_one_path_in_the_order_of_the_ranks():
    shapes = [
        shapely.box(100, 200, 140, 240),
        shapely.box(150, 200, 180, 220),
        shapely.box(200, 200, 300, 300) - shapely.box(220, 220, 240, 240),
        shapely.box(150, 250, 160, 260),
    ]
    rings = rings_of(np.array(shapes), str, np.array([0, 1, 2, 1]))
    colours = np.array([[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.5], [1.0, 0.0, 0.0, 1.0]])
    paths = [*area_paths(rings, np.array(["a", "b", "c"], object), colours, np.array([2, 0, 1]), FIT)]
    assert [path.element for path in paths] == ["b", "c", "a"]
    assert [len(path.contours) for path in paths] == [2, 2, 1]
    assert [path.paint.color for path in paths] == [(0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
    assert paths[0].paint.opacity == 0.5
    areas = [sum(_area(contour) for contour in path.contours) for path in paths]
    assert areas == pytest.approx(np.array([700.0, 9600.0, 1600.0]) / 200.0**2)  # a hole counts against its ring


def _area(contour):
    x, y = contour[:, 0].T
    return 0.5 * float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())


def test_no_polygons_are_no_paths():
    empty = rings_of(np.empty(0, object), str, np.empty(0, np.intp))
    assert [*area_paths(empty, np.empty(0, object), np.empty((0, 4)), np.empty(0, np.int64), FIT)] == []
