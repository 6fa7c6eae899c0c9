"""The source in parts of the world: each part has all that is in its tile and around it."""

import numpy as np
import pytest
import shapely
from tile_sources import cells

from vexture_geo.tiles import partitions
from vexture_geo.tiles.grid import MARGIN, Tile, widen_box
from vexture_geo.tiles.partitions import partition_source
from vexture_geo.tiles.pieces import FeaturePieces


def pieces():
    shapes = cells(300, Tile(1, 1, 0).box)
    return FeaturePieces(np.arange(300), np.array([str(k) for k in range(300)], object), shapes)


def read(folder, part):
    return FeaturePieces.of_bytes((folder / f"{part.tile.name}.parquet").read_bytes())


def test_a_small_source_is_one_part(tmp_path):
    found = partition_source([pieces()], tmp_path, 2, 2)
    assert [part.tile for part in found] == [Tile(0, 0, 0)]
    assert sorted(read(tmp_path, found[0]).order.tolist()) == list(range(300))


def test_parts_of_a_large_source_have_what_is_in_their_tiles(tmp_path, monkeypatch):
    monkeypatch.setattr(partitions, "WEIGHT", 200)
    whole = pieces()
    found = partition_source([whole.take(slice(0, 100)), whole.take(slice(100, 300))], tmp_path, 6, 2)
    tiles = [part.tile for part in found]
    assert len(tiles) > 4
    assert tiles == sorted(tiles)
    assert all(tile.z % 2 == 0 for tile in tiles)
    assert sorted(path.stem for path in tmp_path.iterdir()) == sorted(tile.name for tile in tiles)
    for part in found:
        inside = read(tmp_path, part)
        around = shapely.box(*widen_box(part.tile.box, MARGIN * part.tile.side))
        wanted = shapely.area(shapely.intersection(whole.shapes, around))
        area = np.bincount(inside.order, shapely.area(inside.shapes), 300)
        np.testing.assert_allclose(area, wanted, atol=1e-6 * around.area)
    shares = [shapely.intersection(shapely.box(*tile.box), shapely.box(*Tile(1, 1, 0).box)).area for tile in tiles]
    assert sum(shares) == pytest.approx(shapely.box(*Tile(1, 1, 0).box).area)
