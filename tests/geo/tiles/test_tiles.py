"""A pyramid of tiles: each names the feature that is there, neighbours fit, and what was killed ends with its bytes."""

import hashlib
import json
import tracemalloc
from itertools import product

import numpy as np
import pytest
import shapely
from pmtiles.reader import MmapSource, Reader, all_tiles
from pmtiles.tile import tileid_to_zxy
from tile_sources import batches_of, cells, write_source

from vexture import ParameterError, SourceError
from vexture_geo.base import validity
from vexture_geo.base.crs import transform_points
from vexture_geo.base.rings import cut, rings_of
from vexture_geo.tiles import generalise
from vexture_geo.tiles.build import make_tiles
from vexture_geo.tiles.generalise import dissolve, generalise_polygons
from vexture_geo.tiles.grid import CRS, HALF, MARGIN, Tile, last_zoom, pixel, span, zooms_of
from vexture_geo.tiles.options import TileOptions
from vexture_geo.tiles.pieces import FeaturePieces

BOX = (4.0, 51.0, 6.0, 53.0)
ZOOM = 8
LAST = last_zoom(ZOOM, 2)


def pieces_of(shapes):
    return FeaturePieces(
        np.arange(len(shapes)), np.array([str(k) for k in range(len(shapes))], object), np.array(shapes)
    )


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


def test_a_corner_beside_the_side_of_a_box_is_cut():
    """A part of a real coast, whose corner is beside the box by a rounding: GEOS cuts it the slow way only."""
    box = (1242560.3318038252, 5312679.21393289, 1575214.2789009123, 5645333.161029977)
    coast = [
        *((1582731.435982602, 5642401.414837995), (1575214.278900912, 5632022.741133708)),
        *((1576422.8332481321, 5630837.162048986), (1570718.0830371152, 5617258.616825198)),
        *((1565708.9097834935, 5613058.958254781), (1567925.5836037635, 5619090.803442381)),
        *((1565980.685884063, 5621451.823123742), (1550497.9411547433, 5590409.206972675)),
        *((1548179.3512967597, 5593294.348699385), (1549564.56010935, 5584531.630844645)),
        (1540936.518216582, 5597087.135539901),
    ]
    found = pieces_of([shapely.Polygon(coast)]).within(box)
    wanted = shapely.intersection(shapely.Polygon(coast), shapely.box(*box)).area
    assert shapely.area(found.shapes).sum() == pytest.approx(wanted)
    rings = cut(rings_of(np.array([shapely.Polygon(coast)]), str), box)
    assert shapely.area(rings.shapes).sum() == pytest.approx(wanted)


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


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"max_zoom": 21}, "`max_zoom` is 21; it must be in 0..20"),
        ({"min_zoom": 13}, "`min_zoom` is 13; it must be in 0..10"),
        ({"step": 4}, "`step` is 4; it must be 2 or 3"),
        ({"processes": 0}, "`processes` is 0"),
    ],
)
def test_wrong_options_are_named(given, says):
    with pytest.raises(ParameterError, match=says.replace("..", r"\.\.")):
        TileOptions(**given)


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
