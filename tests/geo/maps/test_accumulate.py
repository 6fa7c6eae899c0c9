"""Pictures of polygons in one pass over their sides: what shapely measures in each pixel."""

import numpy as np
import pytest
import shapely

from vexture import window
from vexture.renderers.accumulate import Sides, render_sides
from vexture_geo.base.rings import orient_rings, rings_of

SIZE = (7, 5)
ROUNDING = 1e-6
"""The picture has 24 bits."""


def sides_of(polygons):
    """Sides of polygons, each of its own colour."""
    rings = orient_rings(rings_of(np.asarray(polygons, object), str, np.arange(len(polygons))))
    owner = np.repeat(rings.feature[rings.polygon], np.diff(rings.ends, prepend=0))
    return Sides(rings.points, rings.points[rings.following], owner)


def measured(polygons, rgba, size, view):
    """Colours by the areas of the polygons in each pixel."""
    width, height = size
    matrix = view.matrix(size)
    picture = np.zeros((height, width, 4))
    for row in range(height):
        for column in range(width):
            (left, right), (top, bottom), _ = matrix @ [[column, column + 1], [row, row + 1], [1, 1]]
            square = shapely.box(left, bottom, right, top)
            parts = shapely.area(shapely.intersection(polygons, square)) / square.area
            picture[row, column] = parts @ np.concatenate([rgba[:, :3] * rgba[:, 3:], rgba[:, 3:]], axis=1)
    return picture


@pytest.mark.parametrize("view", [window(0, 0, 1, 1), window(0.3, 0.2, 0.4, 0.9), window(-0.6, -0.6, 2.5, 2)])
def test_each_pixel_has_the_colours_by_their_areas(view):
    random = np.random.default_rng(4)
    points = shapely.multipoints(random.random((40, 2)))
    cells = shapely.intersection(shapely.get_parts(shapely.voronoi_polygons(points)), shapely.box(0.05, 0.1, 1, 0.9))
    cells[3] = shapely.difference(cells[3], shapely.buffer(shapely.centroid(cells[3]), 0.02))
    cells = cells[5:][~shapely.is_empty(cells[5:])]
    rgba = random.random((len(cells), 4))
    picture = render_sides(sides_of(cells), rgba, SIZE, view)
    np.testing.assert_allclose(picture, measured(cells, rgba, SIZE, view), atol=ROUNDING)


def test_borders_that_are_shared_show_nothing_between():
    cells = [shapely.box(k / 7.3, 0, (k + 1) / 7.3, 1) for k in range(-1, 9)]
    picture = render_sides(sides_of(cells), np.tile([0.2, 0.4, 0.6, 1.0], (len(cells), 1)), (50, 50))
    assert np.ptp(picture, axis=(0, 1)).max() < ROUNDING


def test_what_overlaps_is_mixed_and_never_more_than_opaque():
    twice = [shapely.box(0, 0, 1, 1), shapely.box(0, 0, 0.5, 1)]
    picture = render_sides(sides_of(twice), np.array([[1, 0, 0, 1.0], [0, 0, 1, 1.0]]), (2, 2))
    np.testing.assert_allclose(picture[0], [[0.5, 0, 0.5, 1], [1, 0, 0, 1]], atol=ROUNDING)
