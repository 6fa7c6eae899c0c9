"""Polygons in the world's square: where they are, cut at its borders, repeated beyond the antimeridian."""

import numpy as np
import pytest
import shapely
from tile_sources import batch_of

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.tiles.grid import HALF, MARGIN
from vexture_geo.tiles.partitions import in_world


def world(shapes, crs="EPSG:4326"):
    return in_world(batch_of(shapes, [str(k) for k in range(len(shapes))], crs), 100, 4, Notes())


def test_places_are_those_of_web_mercator():
    found = world([shapely.box(0, 0, 90, 45)])
    north = 6378137.0 * np.log(np.tan(3.0 * np.pi / 8.0))  # Mercator's own formula
    assert shapely.bounds(found.shapes[0]) == pytest.approx([0.0, 0.0, HALF / 2.0, north], abs=1e-6)
    assert (found.order.tolist(), found.ids.tolist()) == ([100], ["0"])
    metres = world([shapely.box(0, 0, 1000, 2000)], "EPSG:3857")
    assert shapely.bounds(metres.shapes[0]).tolist() == [0.0, 0.0, 1000.0, 2000.0]


def test_land_beyond_the_poles_of_the_square_is_cut_off():
    found = world([shapely.box(10, 80, 20, 90), shapely.box(10, 87, 20, 90)])
    assert found.order.tolist() == [100]
    assert shapely.bounds(found.shapes)[0, 3] == pytest.approx(HALF, abs=1e-3)


@pytest.mark.parametrize("crs", ["EPSG:4326", "EPSG:3857"])
def test_what_lies_beside_the_antimeridian_is_beyond_it_on_the_other_side(crs):
    box = (177.0, 0.0, 179.0, 5.0) if crs == "EPSG:4326" else (HALF * 0.98, 0.0, HALF * 0.99, 1e5)
    bounds = shapely.bounds(world([shapely.box(*box)], crs).shapes)
    bounds = bounds[np.argsort(bounds[:, 0])]
    assert len(bounds) == 2
    np.testing.assert_allclose(bounds[1, ::2] - bounds[0, ::2], 2.0 * HALF)
    assert bounds[:, 0].min() > -HALF * (1.0 + 2.0 * MARGIN)


def test_a_box_across_the_antimeridian_has_its_whole_area_on_either_side():
    found = world([shapely.Polygon([(179, 0), (-179, 0), (-179, 5), (179, 5)])])
    east = shapely.bounds(found.shapes)[:, 0] > 0.0
    areas = shapely.area(found.shapes)
    one = shapely.area(world([shapely.box(0, 0, 2, 5)]).shapes).sum()
    assert areas[east].sum() == pytest.approx(one, rel=1e-6)
    assert areas[~east].sum() == pytest.approx(one, rel=1e-6)


def test_metres_that_are_said_to_be_degrees_are_refused():
    with pytest.raises(SourceError, match="cannot be longitudes and latitudes"):
        world([shapely.box(84_000, 447_000, 85_000, 448_000)])
