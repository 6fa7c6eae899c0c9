"""Numbers of tiles, and the zooms of a pyramid."""

import numpy as np
from pmtiles.tile import tileid_to_zxy

from vexture_geo.tiles.grid import Tile, span, zooms_of


def test_numbers_are_those_of_pmtiles():
    rng = np.random.default_rng(2)
    for z in range(21):
        x, y = rng.integers(0, 1 << z, 2).tolist()
        assert tileid_to_zxy(Tile(z, x, y).number) == (z, x, y)
    first, count = span(Tile(3, 5, 2), 5)
    assert sorted(tile.number for tile in Tile(3, 5, 2).below(2)) == list(range(first, first + count))


def test_zooms_end_a_step_before_the_sharpest_views():
    assert zooms_of(0, 7, 2) == zooms_of(0, 8, 2) == [0, 2, 4, 6]
    assert zooms_of(2, 9, 3) == [3, 6]
    assert zooms_of(0, 2, 2) == zooms_of(0, 0, 3) == [0]
