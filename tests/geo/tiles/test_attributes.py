"""Attributes of features in tiles: their colours, their order and their table."""

import errno
import hashlib
import json

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import shapely
from pmtiles.reader import MmapSource, Reader, all_tiles
from tile_sources import COUNT, VALUES, write_columns, write_parcels

from vexture import ParameterError
from vexture.base.errors import DeviceError
from vexture.base.notes import Notes
from vexture.texture.load import texture_from
from vexture_geo.base.crs import transform_points
from vexture_geo.maps.colours import Scale, colours_of
from vexture_geo.tiles.attributes import TileStyle
from vexture_geo.tiles.build import make_tiles
from vexture_geo.tiles.grid import CRS
from vexture_geo.tiles.options import TileOptions

BY_VALUE = Scale("value", classes=3, no_data="#ff000080")
LOOK = TileStyle(BY_VALUE, table="parquet")


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    return write_parcels(tmp_path_factory.mktemp("source"))


def made(source, output, look, **options):
    return make_tiles(source, output, TileOptions(max_zoom=6, id="parcel", style=look, **options))


def colours_in(path):
    """The colours of all features of all tiles, by their ids."""
    found = {}
    with path.open("rb") as file:
        for _, data in all_tiles(MmapSource(file)):
            style = texture_from(data, "a tile").roots[0].style
            for name, rgba in zip(style.names, style.rgba.tolist(), strict=True):
                found.setdefault(name, set()).add(tuple(rgba))
    return found


def test_features_have_the_colours_of_their_attribute_in_all_tiles(source, tmp_path):
    made(source, tmp_path / "parcels.pmtiles", LOOK, processes=2)
    rgba, legend = colours_of(pa.table({"value": VALUES}), BY_VALUE, Notes())
    found = colours_in(tmp_path / "parcels.pmtiles")
    assert len(found) == COUNT
    for place, colour in enumerate(rgba):
        (shown,) = found[f"p{place}"]
        assert np.allclose(shown, colour, atol=0.5 / 255)
    with (tmp_path / "parcels.pmtiles").open("rb") as file:
        about = Reader(MmapSource(file)).metadata()["vexture"]
    assert about["legends"] == [{"layer": "parcels", **legend}]
    assert about["table"] == "parcels.parquet"
    table = pq.read_table(tmp_path / "parcels.parquet")
    assert table.column("id").to_pylist() == [f"p{k}" for k in range(COUNT)]
    assert table.column("value").to_pylist() == VALUES
    assert json.loads(table.schema.metadata[b"vexture.legend"]) == about["legends"]


def test_a_folder_has_its_table_within_and_one_colour_is_that_of_all(source, tmp_path):
    made(source, tmp_path / "out", TileStyle(fill="teal", columns=("value",), table="arrow"))
    about = json.loads((tmp_path / "out" / "tiles.json").read_text())["vexture"]
    assert about["table"] == "table.arrow"
    assert "legends" not in about
    with pa.memory_map(str(tmp_path / "out" / "table.arrow")) as file:
        assert pa.ipc.open_file(file).read_all().column_names == ["id", "parcel", "value"]
    tile = next((tmp_path / "out").rglob("*.ktx2"))
    rgba = texture_from(tile.read_bytes(), "a tile").roots[0].style.rgba
    assert np.allclose(rgba, (0.0, 128 / 255, 128 / 255, 1.0), atol=1e-6)


@pytest.mark.parametrize(
    "stops",
    [KeyboardInterrupt(), DeviceError("workers died"), OSError(errno.ENOSPC, "No space left on device")],
    ids=["interrupted", "an error", "a full disk"],
)
def test_what_is_finished_is_named_and_has_its_colours_and_its_table(source, tmp_path, stops):
    made(source, tmp_path / "whole.pmtiles", LOOK)
    output = tmp_path / "parcels.pmtiles"

    def told(what, *_):
        if what == "parts":
            raise stops

    options = TileOptions(max_zoom=6, id="parcel", style=LOOK, name="whole")
    says = (
        None if isinstance(stops, KeyboardInterrupt) else r"what is finished is in .*parcels\.pmtiles\.parts, and the"
    )
    with pytest.raises(KeyboardInterrupt if not says else DeviceError, match=says):
        make_tiles(source, output, options, told)
    assert (tmp_path / "parcels.pmtiles.parts").is_dir()
    made(source, output, LOOK, name="whole")
    assert colours_in(output) == colours_in(tmp_path / "whole.pmtiles")
    digests = {hashlib.sha256((tmp_path / f"{name}.parquet").read_bytes()).digest() for name in ("whole", "parcels")}
    assert len(digests) == 1
    assert len(list(tmp_path.iterdir())) == 4


@pytest.fixture(params=[1, -1], ids=["in order", "reversed"])
def overlapping(request, tmp_path):
    """Boxes that overlap; the largest feature has two, and is partly beyond the antimeridian."""
    shapes = {
        "small": shapely.box(172, 1, 173, 2),
        "big": shapely.box(171, 0, 181, 10),
        "bigger": shapely.MultiPolygon([shapely.box(176, 5, 183, 14), shapely.box(160, 5, 167, 14)]),
        "beside": shapely.box(150, 0, 155, 10),
    }
    names = list(shapes)[:: request.param]
    level = {"small": 1.5, "big": 2.5, "bigger": None, "beside": 3.5}
    columns = {"parcel": names, "level": [level[name] for name in names], "word": [name[::-1] for name in names]}
    return write_columns(tmp_path / "source.geojson", [shapes[name] for name in names], **columns)


@pytest.mark.parametrize(
    ("order", "seen"),
    [
        (None, ["small", "big", "big", "bigger", "bigger", "beside"]),  # the smaller above
        ("level", ["big", "big", "big", "bigger", "bigger", "beside"]),  # what has no value is below
        ("word", ["small", "bigger", "bigger", "bigger", "bigger", "beside"]),
    ],
)
def test_overlaps_are_in_an_order_that_is_not_that_of_the_file(overlapping, order, seen, tmp_path):
    places = [(172.5, 1.5), (177.0, 6.0), (-179.5, 6.0), (-178.0, 6.0), (163.0, 7.0), (152.0, 5.0)]
    metres = transform_points(np.array(places), "EPSG:4326", CRS)
    made(overlapping, tmp_path / "made.pmtiles", TileStyle(order=order))
    checked = 0
    with (tmp_path / "made.pmtiles").open("rb") as file:
        for (z, _, _), data in all_tiles(MmapSource(file)):
            texture = texture_from(data, "a tile")
            to = texture.roots[0].to_source
            unit = (metres - to[:, 2]) / to[:, :2].diagonal()
            there = ((unit > 0.0) & (unit < 1.0)).all(axis=1) & (z > 0)
            assert texture.element_at(unit[there]).name.tolist() == np.array(seen)[there].tolist()
            checked += int(there.sum())
    assert checked >= 2 * len(places)


@pytest.mark.parametrize(
    ("look", "says"),
    [
        (
            TileStyle(Scale("height")),
            "parcels.geojson: it has no column 'height' for `color`; there are: parcel, value",
        ),
        (TileStyle(order="height"), "parcels.geojson: it has no column 'height' for `order`; there are: parcel, value"),
        (TileStyle(Scale("parcel", "equal"), table="parquet"), "holds string, not numbers; give `scale` categories"),
    ],
)
def test_columns_that_cannot_be_colours_are_named_and_nothing_stays(source, tmp_path, look, says):
    with pytest.raises(ParameterError) as error:
        made(source, tmp_path / "parcels.pmtiles", look)
    assert says in str(error.value)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("look", "says"),
    [
        (TileStyle(BY_VALUE, fill="red"), "`color` and `fill` exclude each other"),
        (TileStyle(fill="reddish"), "`fill` is 'reddish'; give a CSS colour"),
        (TileStyle(Scale("value", palette="nope")), "the `palette` 'nope' is unknown"),
        (TileStyle(Scale("value", "steps")), "`scale` is 'steps'"),
    ],
)
def test_looks_are_refused_before_anything_is_read(look, says):
    with pytest.raises(ParameterError) as error:
        TileOptions(style=look)
    assert says in str(error.value)


def test_a_table_is_never_written_over_its_source(source, tmp_path):
    copy = tmp_path / "parcels.parquet"
    copy.write_bytes(source.read_bytes())
    with pytest.raises(ParameterError, match=r"parcels\.parquet is a source itself; give another `output`"):
        made(copy, tmp_path / "parcels.pmtiles", LOOK)
