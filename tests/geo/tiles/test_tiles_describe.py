"""`vexture info` of pyramids: what is told of a file and of a folder, and of files that are damaged or of others."""

import gzip
import hashlib
import json
import shutil

import numpy as np
import pyarrow.parquet as pq
import pytest
import shapely
from click.testing import CliRunner
from pmtiles.reader import MemorySource, all_tiles
from pmtiles.tile import Compression, TileType, deserialize_header, serialize_header, zxy_to_tileid
from pmtiles.writer import Writer
from tile_sources import cells, write_source

from vexture.cli.main import main
from vexture_geo.maps.colours import Scale
from vexture_geo.tiles.attributes import TileStyle
from vexture_geo.tiles.build import make_tiles
from vexture_geo.tiles.options import TileOptions

BOX = (4.0, 51.0, 6.0, 53.0)
COUNT = 300
ZOOM = 7


def info(*words):
    return CliRunner().invoke(main, ["info", *map(str, words)])


def told(path):
    return json.loads(info(path, "--json").stdout)


def refused(path):
    """The line in which a file is refused."""
    outcome = info(path)
    assert outcome.exit_code == 1, outcome.output
    assert outcome.stderr.count("\n") == 1
    assert outcome.stdout == ""
    return outcome.stderr.removeprefix("vexture: ").rstrip()


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """Parcels, and one that covers whole tiles, so that some are equal."""
    shapes = [*cells(COUNT - 1, BOX), shapely.box(8.0, 30.0, 60.0, 60.0)]
    return write_source(tmp_path_factory.mktemp("source") / "parcels.geojson", shapes, [f"p{k}" for k in range(COUNT)])


@pytest.fixture(scope="module")
def archive(source, tmp_path_factory):
    output = tmp_path_factory.mktemp("made") / "parcels.pmtiles"
    look = TileStyle(Scale("parcel", "categories"), table="parquet")
    options = TileOptions(max_zoom=ZOOM, id="parcel", name="Parcels", attribution="a survey", style=look)
    make_tiles(source, output, options)
    return output


@pytest.fixture(scope="module")
def folder(source, tmp_path_factory):
    output = tmp_path_factory.mktemp("made") / "parcels"
    make_tiles(source, output, TileOptions(max_zoom=ZOOM, id="parcel", style=TileStyle(table="arrow")))
    return output


def test_an_archive_is_what_its_tiles_say(archive):
    facts = told(archive)
    tiles = dict(all_tiles(MemorySource(archive.read_bytes())))
    sizes = {key: len(tile) for key, tile in tiles.items()}
    assert facts["tiles"] == len(tiles)
    assert facts["contents"] == len({hashlib.sha256(tile).digest() for tile in tiles.values()}) < len(tiles)
    assert [level["zoom"] for level in facts["levels"]] == facts["zooms"]
    for level in facts["levels"]:
        here = [tile for (zoom, _, _), tile in tiles.items() if zoom == level["zoom"]]
        assert (level["tiles"], level["contents"]) == (len(here), len(set(here)))
        assert level["bytes"] == sum(map(len, set(here)))
    assert facts["largest"]["bytes"] == max(sizes.values())
    assert sizes[tuple(map(int, facts["largest"]["tile"].split("/")))] == max(sizes.values())
    assert facts["bytes"] == archive.stat().st_size
    assert (facts["name"], facts["attribution"]) == ("Parcels", "a survey")
    assert (facts["zooms"], facts["sharp"]) == ([0, 2, 4, 6], ZOOM)
    assert np.allclose(facts["bounds"], (4.0, 30.0, 60.0, 60.0), atol=1e-5)
    assert (facts["table"], facts["features"]) == ("parcels.parquet", COUNT)
    assert facts["columns"] == pq.read_schema(archive.with_suffix(".parquet")).names
    assert [legend["column"] for legend in facts["legends"]] == ["parcel"]


def test_people_get_lines(archive, tmp_path):
    said = info(archive).stdout
    assert "zoom 6      {tiles} tiles, {bytes} bytes\n".format(**told(archive)["levels"][3]) in said
    lines = dict(line.split(maxsplit=1) for line in said.splitlines())
    facts = told(archive)
    assert lines["zooms"] == "0, 2, 4, 6; exact up to views of 7"
    assert lines["tiles"] == f"{facts['tiles']}, {facts['contents']} of them different"
    assert lines["largest"] == "{tile}, {bytes} bytes".format(**facts["largest"])
    assert lines["features"] == str(COUNT)
    assert lines["legend"].startswith("parcel: categories, ")
    alone = shutil.copyfile(archive, tmp_path / "another name")  # without its table
    lines = dict(line.split(maxsplit=1) for line in info(alone).stdout.splitlines())
    assert lines["name"] == "Parcels"
    assert lines["table"] == "parcels.parquet"
    assert "features" not in lines
    assert "columns" not in lines


def test_a_folder_is_the_same_pyramid_also_where_equal_tiles_are_copies(archive, folder, tmp_path):
    one, other = told(archive), told(folder)
    alike = ("zooms", "sharp", "tiles", "contents", "features")
    assert [other[key] for key in alike] == [one[key] for key in alike]
    counts = ("zoom", "tiles", "contents")
    assert [[level[key] for key in counts] for level in other["levels"]] == [
        [level[key] for key in counts] for level in one["levels"]
    ]
    assert other["table"] == "table.arrow"
    assert np.allclose(other["bounds"], one["bounds"], atol=1e-6)
    digests = {hashlib.sha256(tile.read_bytes()).digest(): tile.stat().st_size for tile in folder.rglob("*.ktx2")}
    assert other["bytes"] == sum(digests.values())
    copied = shutil.copytree(folder, tmp_path / "copied")
    assert told(copied) == other
    (copied / "table.arrow").write_bytes(b"nothing")
    assert told(copied) == other | {"features": None, "columns": None}


def written(path, tile_type, about):
    """An archive of somebody else."""
    with path.open("wb") as file:
        writer = Writer(file)
        writer.write_tile(zxy_to_tileid(0, 0, 0), b"\0" * 9)
        header = {"tile_type": tile_type, "tile_compression": Compression.NONE, "min_zoom": 0, "max_zoom": 0}
        writer.finalize(header, about)
    return path


@pytest.mark.parametrize("kind", [TileType.MVT, TileType.PNG, TileType.WEBP])
def test_tiles_of_others_are_named(kind, tmp_path):
    path = written(tmp_path / "other.pmtiles", kind, {"name": "other"})
    assert refused(path) == f"{path}: its tiles are {kind.name}, not textures; give a pyramid of vexture tiles"


@pytest.mark.parametrize(
    ("about", "says"),
    [
        ({"name": "other"}, "its metadata have no pyramid of vexture"),
        ({"vexture": {"zooms": "all"}}, "its metadata have no pyramid of vexture"),
        ({"vexture": {"zooms": [0], "table": "../table.arrow"}}, "its table is '../table.arrow'"),
        ({"vexture": {"zooms": [0], "legends": [{"column": 1}]}}, "its legends are not those of vexture"),
        ([], "its metadata have no pyramid of vexture"),
    ],
)
def test_metadata_that_vexture_does_not_write_are_refused(about, says, tmp_path):
    assert says in refused(written(tmp_path / "other.pmtiles", TileType.UNKNOWN, about))
    (tmp_path / "tiles.json").write_text(json.dumps(about))
    assert says in refused(tmp_path)


def test_what_is_no_archive_is_refused(archive, tmp_path):
    path = tmp_path / "some.pmtiles"
    content = archive.read_bytes()
    for part, says in (
        (b"", "is no archive of tiles"),
        (b"<svg/>", "is no archive of tiles"),
        (content[:100], "is no archive of tiles"),
        (b"PMTiles\2" + content[8:], "is PMTiles 2; this program reads version 3"),
        (content[:-1], "breaks off"),
        (content[: len(content) // 2], "breaks off"),
        (content[:200], ""),
    ):
        path.write_bytes(part)
        assert says in refused(path)
    (tmp_path / "tiles.json").write_text("{")
    assert "tiles.json: is no TileJSON" in refused(tmp_path)
    (tmp_path / "tiles.json").unlink()
    assert "is a folder; name a file in it" in refused(tmp_path)


def test_directories_that_lead_to_themselves_end(archive, tmp_path):
    content = archive.read_bytes()
    header = deserialize_header(content[:127])
    loop = gzip.compress(bytes([1, 0, 0, header["root_length"], 1]))  # one entry, a directory at its own place
    header |= {"leaf_directory_offset": header["root_offset"], "root_length": len(loop)}
    loop = gzip.compress(bytes([1, 0, 0, len(loop), 1]))
    path = tmp_path / "loop.pmtiles"
    path.write_bytes(serialize_header(header) + loop + content[127 + len(loop) :])
    assert "too deep" in refused(path)


def test_damaged_archives_never_end_otherwise_than_in_a_line(archive, tmp_path):
    content = np.frombuffer(archive.read_bytes(), np.uint8)
    head = deserialize_header(content[:127].tobytes())["tile_data_offset"]
    chance = np.random.default_rng(20)
    path = tmp_path / "damaged.pmtiles"
    ends = set()
    for _ in range(300):
        damaged = content.copy()
        damaged[chance.integers(0, head, 3)] = chance.integers(0, 256, 3)
        path.write_bytes(damaged.tobytes())
        outcome = info(path)
        ends.add(outcome.exit_code)
        assert outcome.exit_code == 0 or outcome.stderr.count("\n") == 1, outcome.exception
    assert ends == {0, 1}
