"""A pyramid of tiles: each names the feature that is there, neighbours fit, and what was killed ends with its bytes."""

import hashlib
import json
from itertools import product

import numpy as np
import pytest
import shapely
from pmtiles.reader import MmapSource, Reader, all_tiles
from tile_sources import batches_of, cells, write_source

from vexture import SourceError
from vexture_geo.base import validity
from vexture_geo.base.crs import transform_points
from vexture_geo.tiles.build import make_tiles
from vexture_geo.tiles.grid import CRS, HALF, MARGIN, Tile, last_zoom, pixel
from vexture_geo.tiles.options import TileOptions

BOX = (4.0, 51.0, 6.0, 53.0)
ZOOM = 8
LAST = last_zoom(ZOOM, 2)


def tiles_of(path):
    with path.open("rb") as file:
        return dict(all_tiles(MmapSource(file)))


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.fixture(scope="module")
def parcels():
    shapes = cells(600, BOX)
    return shapes, [f"c{k}" for k in range(len(shapes))]


@pytest.fixture(scope="module")
def source(parcels, tmp_path_factory):
    return write_source(tmp_path_factory.mktemp("source") / "parcels.geojson", *parcels)


@pytest.fixture(scope="module")
def archive(source, tmp_path_factory):
    output = tmp_path_factory.mktemp("made") / "parcels.pmtiles"
    make_tiles(source, output, TileOptions(max_zoom=ZOOM, id="parcel", name="Parcels"))
    return output


def test_a_reader_of_pmtiles_reads_it(archive):
    with archive.open("rb") as file:
        reader = Reader(MmapSource(file))
        header, about = reader.header(), reader.metadata()
    assert about["name"] == "Parcels"
    assert about["vexture"]["zooms"] == [0, 2, 4, 6]
    assert about["vexture"]["sharp"] == ZOOM
    assert about["vexture"]["margin"] == MARGIN
    assert (header["min_zoom"], header["max_zoom"], header["clustered"]) == (0, LAST, True)
    west, south, east, north = (header[name] / 1e7 for name in ("min_lon_e7", "min_lat_e7", "max_lon_e7", "max_lat_e7"))
    assert np.allclose((west, south, east, north), BOX, atol=1e-5)


def test_each_tile_names_the_features_that_are_there(archive, parcels):
    """At random points that are not within the tolerance of a border, for the sharpest views."""
    shapes, ids = parcels
    projected = shapely.transform(shapes, lambda points: transform_points(points, "EPSG:4326", CRS))
    tree, borders = shapely.STRtree(projected), shapely.STRtree(shapely.boundary(projected))
    rng = np.random.default_rng(3)
    checked = 0
    for (z, x, y), data in tiles_of(archive).items():
        if z < LAST:
            continue
        (root,) = (texture := loaded(data)).roots
        assert root.name == "map"
        assert root.crs == CRS
        points = rng.uniform(MARGIN, 1.0 - MARGIN, (400, 2))
        metres = points @ root.to_source[:, :2].T + root.to_source[:, 2]
        west, south, east, north = Tile(z, x, y).box
        assert (metres > (west, south)).all()
        assert (metres < (east, north)).all()
        where = shapely.points(metres)
        far = np.ones(len(where), bool)
        far[np.unique(borders.query(where, predicate="dwithin", distance=0.25 * pixel(ZOOM))[0])] = False
        found = np.full(len(where), "", object)
        inside = tree.query(where, predicate="within")
        found[inside[0]] = np.array(ids, object)[inside[1]]
        assert (texture.element_at(points).name[far] == found[far]).all(), (z, x, y)
        checked += int(far.sum())
    assert checked > 1000


def loaded(data):
    from vexture.texture.load import texture_from

    return texture_from(data, "a tile")


def test_neighbours_fit(archive):
    """The same points near a common side, by the tile and by its neighbour's margin, off borders."""
    tiles = {key: loaded(data) for key, data in tiles_of(archive).items() if key[0] == LAST}
    pairs = [(key, other) for key in tiles if (other := (key[0], key[1] + 1, key[2])) in tiles]
    assert pairs
    rng = np.random.default_rng(4)
    for one, other in pairs:
        _, south, east, north = Tile(*one).box
        away = Tile(*one).side * MARGIN * 0.99
        metres = np.stack([rng.uniform(east - away, east + away, 500), rng.uniform(south, north, 500)], axis=1)
        names = []
        for texture in (tiles[one], tiles[other]):
            to = texture.roots[0].to_source
            names.append(texture.element_at((metres - to[:, 2]) / to[:, :2].diagonal()).name)
        assert (names[0] != names[1]).mean() < 0.02


def test_equal_tiles_are_stored_once_and_not_one_by_one(tmp_path):
    land = shapely.segmentize(shapely.box(-170.0, -60.0, 170.0, 70.0), 30.0)
    source = write_source(tmp_path / "land.geojson", [land], ["land"])
    made = make_tiles(source, tmp_path / "land.pmtiles", TileOptions(max_zoom=8, id="parcel"))
    assert made.tiles > 2000
    assert made.contents < 400
    with (tmp_path / "land.pmtiles").open("rb") as file:
        reader = Reader(MmapSource(file))
        assert reader.header()["tile_entries_count"] < 500
        inner = reader.get(6, 30, 30)
        assert inner == reader.get(6, 40, 25)
        assert reader.get(6, 30, 0) is None
    (element,) = loaded(inner).element_at([(0.5, 0.5)]).name
    assert element == "land"


def test_bytes_do_not_depend_on_who_did_the_work(source, archive, tmp_path):
    make_tiles(source, tmp_path / "two.pmtiles", TileOptions(max_zoom=ZOOM, id="parcel", name="Parcels", processes=2))
    assert digest(tmp_path / "two.pmtiles") == digest(archive)


@pytest.mark.parametrize("box", [(179.0, -5.0, 181.0, 5.0), (-181.0, -5.0, -179.0, 5.0)])
def test_the_antimeridian_is_no_border(tmp_path, box):
    source = write_source(tmp_path / "far.geojson", [shapely.box(*box)], ["far"])
    make_tiles(source, tmp_path / "far.pmtiles", TileOptions(max_zoom=6, id="parcel"))
    tiles = tiles_of(tmp_path / "far.pmtiles")
    for z, x in product((4,), (0, 15)):
        texture = loaded(tiles[z, x, 8])
        to = texture.roots[0].to_source
        sides = np.array([(s * HALF * (180.0 + d) / 180.0, -1e4) for s in (1, -1) for d in (-0.5, 0.5)])
        unit = (sides - to[:, 2]) / to[:, :2].diagonal()
        seen = ((unit > 0.0) & (unit < 1.0)).all(axis=1)
        assert seen.sum() == 2
        assert (texture.element_at(unit[seen]).name == "far").all()


def test_beyond_the_worlds_border_there_is_nothing(tmp_path):
    source = write_source(tmp_path / "pole.geojson", [shapely.box(0.0, 80.0, 40.0, 90.0)], ["ice"])
    make_tiles(source, tmp_path / "pole.pmtiles", TileOptions(max_zoom=4, id="parcel"))
    assert set(tiles_of(tmp_path / "pole.pmtiles")) >= {(0, 0, 0), (2, 2, 0)}


def test_what_another_source_left_is_not_used(parcels, archive, tmp_path):
    shapes, ids = parcels
    source = write_source(tmp_path / "parcels.geojson", shapes[:10], ids[:10])
    output = tmp_path / "parcels.pmtiles"
    options = TileOptions(max_zoom=4, id="parcel")

    def stops(what, *_):
        if what == "parts":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        make_tiles(source, output, options, stops)
    write_source(source, shapes[10:20], ids[10:20])
    make_tiles(source, output, options)
    texture = loaded(tiles_of(output)[2, 2, 1])
    assert set(texture.roots[0].style.names) <= set(ids[10:20])


def test_a_folder_has_a_description(source, tmp_path):
    made = make_tiles(source, tmp_path / "out", TileOptions(max_zoom=6, id="parcel"))
    about = json.loads((tmp_path / "out" / "tiles.json").read_text())
    assert about["tilejson"] == "3.0.0"
    assert about["vexture"]["zooms"] == [0, 2, 4]
    assert about["tiles"][0].startswith("{z}/{x}/{y}.ktx2?v=")
    assert len(list((tmp_path / "out").rglob("*.ktx2"))) == made.tiles
    make_tiles(source, tmp_path / "out", TileOptions(max_zoom=4, id="parcel"))
    assert not (tmp_path / "out" / "4").exists()


def test_a_source_without_polygons_is_refused(tmp_path):
    source = write_source(tmp_path / "empty.geojson", [shapely.Point(4, 52)], ["a"])
    with pytest.raises(SourceError, match=r"empty\.geojson: it has lines or points \(1\), but no polygon"):
        make_tiles(source, tmp_path / "empty.pmtiles", TileOptions())
    assert {path.name for path in tmp_path.iterdir()} == {"empty.geojson"}


def test_a_polygon_of_many_holes_is_parted_and_keeps_them(monkeypatch):
    """Two combs whose teeth are cut apart by the first halves, with holes also on the lines between these."""
    monkeypatch.setattr(validity, "HEAVY", 300.0)
    west, south = (corner.ravel() for corner in np.meshgrid(*[np.arange(24) * 4.0 + 1.0] * 2))
    holes = shapely.box(west, south, west + 2.5, south + 2.5)
    teeth = shapely.box(np.arange(6) * 16.0 + 11.9, 30.0, np.arange(6) * 16.0 + 12.9, 200.0)
    gaps = shapely.union_all(np.append(teeth[::2], shapely.affinity.translate(shapely.union_all(teeth[1::2]), 0, -135)))
    whole = shapely.box(0.0, 0.0, 97.0, 97.0) - shapely.union_all([shapely.union_all(holes), gaps])
    parts = np.array(validity.split_heavy(whole))
    assert len(parts) > 20
    assert not validity.is_heavy(parts).any()
    assert shapely.is_valid(parts).all()
    assert shapely.area(parts).sum() == pytest.approx(whole.area)
    assert shapely.union_all(parts).symmetric_difference(whole).area == pytest.approx(0.0, abs=1e-9)


def test_features_in_batches_are_numbered_through(parcels, tmp_path):
    shapes, ids = parcels
    marks = tmp_path / "marks"
    marks.write_text("in memory")
    options = TileOptions(max_zoom=6)
    for size in (7, 1000):
        make_tiles(marks, tmp_path / f"{size}.pmtiles", options, batches=batches_of(shapes, ids, size=size))
    one, other = (tiles_of(tmp_path / f"{size}.pmtiles") for size in (7, 1000))
    assert {key: hashlib.sha256(data).digest() for key, data in one.items()} == {
        key: hashlib.sha256(data).digest() for key, data in other.items()
    }


def test_land_that_jumps_over_the_antimeridian_is_whole(tmp_path):
    """Its sides run across the whole map, where they cross its own: it is unwrapped before it is repaired."""
    land = [(30.0, 50.0), (175.0, 50.0), (179.9, 65.0), (-180.0, 65.1), (-170.0, 66.0), (-180.0, 69.0), (179.9, 69.1)]
    land = shapely.Polygon([*land, (100.0, 60.0), (60.0, 75.0), (30.0, 75.0)])
    assert not land.is_valid
    source = write_source(tmp_path / "land.geojson", [land], ["land"])
    made = make_tiles(source, tmp_path / "land.pmtiles", TileOptions(max_zoom=2, id="parcel"))
    assert made.notes == ()
    (tile,) = tiles_of(tmp_path / "land.pmtiles").values()
    texture = loaded(tile)
    places = np.array([(40.0, 65.0), (40.0, 69.05), (175.0, 66.0), (-176.0, 66.5), (0.0, 66.0), (-100.0, 69.0)])
    to = texture.roots[0].to_source
    unit = (transform_points(places, "EPSG:4326", CRS) - to[:, 2]) / to[:, :2].diagonal()
    assert texture.element_at(unit).name.tolist() == ["land"] * 4 + [""] * 2


CIRCLE = [(longitude, -89.999) for longitude in range(-180, 180, 10)]
COAST = [(longitude, -70.0 - abs(longitude) / 36.0) for longitude in range(175, -180, -10)]
LAKE = [(100.0, -80.0), (110.0, -80.0), (110.0, -82.0), (100.0, -82.0)]
ENDS = [(-180.0, -75.0), (180.0, -75.0)]


@pytest.mark.parametrize(
    "ice",
    [shapely.Polygon(CIRCLE, [COAST, LAKE]), shapely.Polygon(COAST, [LAKE]), shapely.Polygon([*COAST, *ENDS], [LAKE])],
    ids=["beside the pole", "around it", "around it, with a side around the world"],
)
def test_land_around_a_pole_is_there(ice, tmp_path):
    """As in atlases that have lost their cuts."""
    source = write_source(tmp_path / "ice.geojson", [ice], ["ice"])
    made = make_tiles(source, tmp_path / "ice.pmtiles", TileOptions(max_zoom=2, id="parcel"))
    assert [str(note) for note in made.notes] == ["a polygon around a pole is closed along the antimeridian"]
    (tile,) = tiles_of(tmp_path / "ice.pmtiles").values()
    texture = loaded(tile)
    on = [(0.0, -70.5), (179.9, -75.5), (-179.9, -75.5), (90.0, -84.0)]
    off = [(105.0, -81.0), (0.0, -69.5), (179.9, -74.5)]
    to = texture.roots[0].to_source
    unit = (transform_points(np.array(on + off), "EPSG:4326", CRS) - to[:, 2]) / to[:, :2].diagonal()
    assert texture.element_at(unit).name.tolist() == ["ice"] * 4 + [""] * 3
