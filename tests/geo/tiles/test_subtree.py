"""Pieces of work on tiles: their names and results, and geometry for lower zooms."""

import hashlib

import numpy as np
import pytest
import shapely
from tile_sources import cells

from vexture_geo.tiles.grid import Tile, pixel
from vexture_geo.tiles.pieces import FeaturePieces
from vexture_geo.tiles.subtree import Job, JobResult, Pyramid, run_job

PYRAMID = Pyramid((0, 2), (0, 2, 4), 2, 6, np.zeros(100, np.uint32), np.arange(100, dtype=np.uint32))


def test_equal_contents_are_there_once():
    result = JobResult()
    for first, content in ((5, b"a"), (9, b"b"), (20, b"a")):
        result.add(first, 2, content)
    first, second = (hashlib.sha256(content).hexdigest() for content in (b"a", b"b"))
    assert result.runs == [(5, 2, first), (9, 2, second), (20, 2, first)]
    assert result.contents == {first: b"a", second: b"b"}


def test_the_last_tiles_are_for_the_sharpest_views():
    assert [PYRAMID.pixel(zoom) for zoom in PYRAMID.zooms] == [pixel(0), pixel(2), pixel(6)]
    assert Job("leaf", Tile(4, 3, 9), ()).name == "leaf-4-3-9"


def test_the_geometry_of_a_tile_is_that_of_its_parts_for_its_zoom():
    tile = Tile(2, 1, 1)
    shapes = shapely.segmentize(cells(40, tile.box), tile.side / 400.0)
    whole = FeaturePieces(np.arange(40), np.array([str(k) for k in range(40)], object), shapes)
    parts = tuple(whole.within(part.box).to_bytes() for part in tile.below(2))
    found = FeaturePieces.of_bytes(run_job(PYRAMID, Job("join", tile, parts)).geometry)
    assert set(found.order.tolist()) == set(range(40))
    assert shapely.area(found.shapes).sum() == pytest.approx(tile.side**2)
    assert found.points < whole.points / 4
    for number in range(40):
        off = shapely.symmetric_difference(shapely.union_all(found.shapes[found.order == number]), shapes[number]).area
        assert off < shapes[number].length * pixel(tile.z)
