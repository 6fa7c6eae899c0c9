"""Generalising: small polygons, simplified borders that stay shared."""

import tracemalloc

import numpy as np
import pytest
import shapely
from tile_sources import cells

from vexture_geo.tiles import generalise
from vexture_geo.tiles.generalise import dissolve, generalise_polygons
from vexture_geo.tiles.pieces import FeaturePieces


def pieces_of(shapes):
    return FeaturePieces(
        np.arange(len(shapes)), np.array([str(k) for k in range(len(shapes))], object), np.array(shapes)
    )


def test_small_features_become_part_of_neighbours():
    shapes = cells(2000, (0.0, 0.0, 1000.0, 1000.0))
    found = generalise_polygons(pieces_of(shapes), (-1.0, -1.0, 1001.0, 1001.0), 1.0, 2000.0)
    assert len(found) < 500
    assert shapely.area(found.shapes).min() >= 1000.0
    whole = shapely.union_all(found.shapes)
    assert whole.area == pytest.approx(1e6, rel=1e-3)
    assert shapely.area(found.shapes).sum() == pytest.approx(whole.area, rel=1e-6)


def town():
    """Blocks of 30 m, each a feature: with streets they are 1.2 km by 1.2 km. Far off, an island of 20 m."""
    west, south = (corner.ravel() for corner in np.meshgrid(*[np.arange(36) * 100.0 / 3.0] * 2))
    blocks = shapely.box(west, south, west + 30.0, south + 30.0)
    return pieces_of([*blocks, shapely.box(5000.0, 5000.0, 5020.0, 5020.0)])


@pytest.mark.parametrize("pixel", [40.0, 100.0, 170.0, 600.0])
def test_a_town_of_small_blocks_is_seen_from_afar(pixel):
    box = (-10_240.0, -10_240.0, 10_240.0, 10_240.0)
    found = generalise_polygons(town(), box, 0.24 * pixel, pixel**2)
    area = shapely.area(found.shapes)
    blocks = shapely.area(shapely.intersection(found.shapes, shapely.box(-pixel, -pixel, 1800.0, 1800.0))).sum()
    assert blocks == pytest.approx(36**2 * 900.0, rel=0.02)
    assert len(found) <= 36**2 * 900.0 / (pixel**2 / 4.0) + 1
    assert shapely.union_all(found.shapes).area == pytest.approx(area.sum())  # no square lies on another
    assert (area.sum() > blocks + 1.0) == (pixel == 40.0)  # the island alone has less than a quarter of a larger pixel
    # beside the border of two tiles, both have the same
    border = 4.0 * pixel * round(600.0 / (4.0 * pixel))
    near = (border - 8.0 * pixel, -10_240.0, border + 8.0 * pixel, 10_240.0)
    tiles = [(-10_240.0, box[1], border + 16.0 * pixel, box[3]), (border - 16.0 * pixel, box[1], 10_240.0, box[3])]
    one, other = (generalise_polygons(town().within(tile), tile, 0.24 * pixel, pixel**2).within(near) for tile in tiles)
    assert set(shapely.to_wkb(one.shapes)) == set(shapely.to_wkb(other.shapes))
    assert len(one)


def test_a_ring_that_touches_itself_may_vanish():
    """A long loop and a tiny one that share a corner, in one ring: nothing but a side back and forth is left."""
    tiny, large = [(0.0, 0.0), (0.1, 0.1), (0.0, 0.1)], [(0.0, 0.0), (-3.0, 0.3), (-3.0, -0.3)]
    shape = shapely.Polygon([*tiny, *large, (0.0, 0.0)])
    far = shapely.box(10.0, 10.0, 20.0, 20.0)
    found = generalise_polygons(pieces_of([shape, far]), (-50.0, -50.0, 50.0, 50.0), 1.0, 0.001)
    assert shapely.area(found.shapes).max() == pytest.approx(100.0)
    assert len(FeaturePieces.of_bytes(found.to_bytes())) == len(found)


def test_borders_move_no_farther_than_the_tolerance():
    angle = np.linspace(0.0, 2.0 * np.pi, 4000, endpoint=False)
    radius = 100.0 + np.cumsum(np.random.default_rng(5).normal(0.0, 0.05, len(angle)))
    lake = shapely.Polygon(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1))
    land = shapely.Polygon([(-200, -200), (200, -200), (200, 200), (-200, 200)], [lake.exterior.coords])
    found = generalise_polygons(pieces_of([lake, land]), (-300.0, -300.0, 300.0, 300.0), 0.5, 1.0)
    assert found.points < 800
    assert shapely.area(found.shapes).sum() == pytest.approx(160_000.0, abs=1e-6)
    for shape in found.shapes[:1]:
        corners = shapely.points(shapely.get_coordinates(lake))
        assert shapely.distance(shape.exterior, corners).max() <= 0.5 + 1e-9


def test_many_points_are_simplified_in_parts(monkeypatch):
    """As if memory had no room for all at once: no border moves farther, and shared ones stay shared."""
    monkeypatch.setattr(generalise, "MOST_POINTS", 5_000)
    shapes = shapely.segmentize(cells(60, (0.0, 0.0, 1000.0, 1000.0)), 0.5)
    pieces = pieces_of(shapes)
    assert pieces.points > 50_000
    tracemalloc.start()
    box = (-1.0, -1.0, 1001.0, 1001.0)
    found = dissolve(generalise_polygons(pieces, box, 1.0, 0.0))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 100 * pieces.points
    assert found.points < 1000
    assert sorted(found.order.tolist()) == list(range(len(shapes)))
    assert shapely.area(found.shapes).sum() == pytest.approx(1e6, rel=1e-9)
    assert shapely.coverage_is_valid(found.shapes)
    before, after = shapely.boundary(shapes), shapely.boundary(found.shapes[np.argsort(found.order)])
    assert shapely.hausdorff_distance(before, after).max() <= 1.0
