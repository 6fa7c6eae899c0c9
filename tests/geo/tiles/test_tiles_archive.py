"""Pyramids as files: an archive that pmtiles reads, and a folder with a file for each tile."""

import json
from pathlib import Path

import pytest
from pmtiles.reader import MmapSource, Reader

from vexture.base.errors import DeviceError
from vexture_geo.tiles.archive import LISTED, check_target, table_of, write_archive, write_folder
from vexture_geo.tiles.grid import Tile
from vexture_geo.tiles.store import Content

BOUNDS = (4.0, 51.5, 6.25, 53.0)
SEA, LAND = "1" * 64, "2" * 64
FIRST = Tile(2, 0, 0).number
RUNS = [(0, 1, LAND), (FIRST, 3, SEA), (FIRST + 3, 1, LAND)]


@pytest.fixture
def contents(tmp_path):
    (tmp_path / "pack").write_bytes(b"....seasland")
    return {SEA: Content(tmp_path / "pack", 4, 4), LAND: Content(tmp_path / "pack", 8, 4)}


def test_an_archive_has_each_content_once_and_all_tiles(contents, tmp_path):
    output = tmp_path / "new" / "a.pmtiles"
    size = write_archive(output, RUNS, contents, [0, 2], BOUNDS, {"name": "a"}, {})
    assert size == output.stat().st_size
    assert output.read_bytes().count(b"seas") == output.read_bytes().count(b"land") == 1
    with output.open("rb") as file:
        reader = Reader(MmapSource(file))
        header = reader.header()
        assert (header["addressed_tiles_count"], header["tile_entries_count"], header["tile_contents_count"]) == (
            5,
            3,
            2,
        )
        assert (header["min_zoom"], header["max_zoom"]) == (0, 2)
        assert [header[name] for name in ("min_lon_e7", "max_lat_e7")] == [40_000_000, 530_000_000]
        assert reader.metadata() == {"name": "a"}
        assert reader.get(0, 0, 0) == reader.get(2, *_place(FIRST + 3)) == b"land"
        assert [reader.get(2, *_place(FIRST + k)) for k in range(3)] == [b"seas"] * 3
        assert reader.get(2, *_place(FIRST + 4)) is None


def _place(number):
    return next((x, y) for x in range(4) for y in range(4) if Tile(2, x, y).number == number)


def test_a_folder_has_a_file_for_each_tile(contents, tmp_path):
    output = tmp_path / "tiles"
    size = write_folder(output, RUNS, contents, [0, 2], BOUNDS, {"name": "a"}, {})
    assert size == 8
    files = {str(path.relative_to(output).with_suffix("")): path.read_bytes() for path in output.rglob("*.ktx2")}
    wanted = {"0/0/0": b"land"} | {"2/{}/{}".format(*_place(FIRST + k)): b"seas" for k in range(3)}
    assert files == wanted | {"2/{}/{}".format(*_place(FIRST + 3)): b"land"}
    about = json.loads((output / LISTED).read_text())
    assert (about["bounds"], about["minzoom"], about["maxzoom"], about["name"]) == ([*BOUNDS], 0, 2, "a")


def test_a_file_that_cannot_be_written_leaves_what_was_there(contents, tmp_path):
    def fails(file):
        file.write(b"half")
        raise OSError("no room")

    write_folder(tmp_path / "tiles", RUNS, contents, [0, 2], BOUNDS, {"name": "before"}, {})
    with pytest.raises(OSError, match="no room"):
        write_folder(tmp_path / "tiles", RUNS[:1], contents, [0], BOUNDS, {}, {Path("table.arrow"): fails})
    assert json.loads((tmp_path / "tiles" / LISTED).read_text())["name"] == "before"
    with pytest.raises(OSError, match="no room"):
        write_archive(tmp_path / "a.pmtiles", RUNS, contents, [0, 2], BOUNDS, {}, {tmp_path / "a.arrow": fails})
    assert sorted(path.name for path in tmp_path.iterdir()) == ["pack", "tiles"]


def test_targets_that_hold_something_else_are_refused(tmp_path):
    (tmp_path / "mine").mkdir()
    check_target(tmp_path / "mine")  # it is empty
    (tmp_path / "mine" / "thesis.txt").touch()
    with pytest.raises(DeviceError, match="holds something else than tiles"):
        check_target(tmp_path / "mine")
    (tmp_path / "mine" / LISTED).touch()
    check_target(tmp_path / "mine")
    (tmp_path / "a.pmtiles").mkdir()
    with pytest.raises(DeviceError, match="is a folder; name a file"):
        check_target(tmp_path / "a.pmtiles")


def test_a_table_is_beside_an_archive_and_in_a_folder():
    assert table_of(Path("out/a.PMTILES"), "parquet") == Path("out/a.parquet")
    assert table_of(Path("out/a"), "arrow") == Path("out/a/table.arrow")
    assert table_of(Path("out/a"), "none") is None
