"""What `vexture tiles` says where a pyramid cannot be made."""

import errno
import os
import subprocess
import sys

import geopandas
import pytest
import shapely
from click.testing import CliRunner
from pmtiles.reader import MmapSource, Reader
from tile_sources import write_columns, write_parcels

from vexture import SourceError
from vexture.base.errors import DeviceError, LimitError
from vexture.cli.main import main
from vexture_geo.tiles.attributes import TileStyle
from vexture_geo.tiles.build import make_tiles
from vexture_geo.tiles.options import TileOptions


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    return write_parcels(tmp_path_factory.mktemp("source"))


def made(source, output, look, **options):
    return make_tiles(source, output, TileOptions(max_zoom=6, id="parcel", style=look, **options))


@pytest.mark.parametrize("option", ["--source-crs", "--crs"])
def test_the_system_of_a_source_is_named_as_in_maps(tmp_path, option):
    """By its former name, too."""
    shape = shapely.box(80_000, 440_000, 90_000, 450_000)
    geopandas.GeoDataFrame({"parcel": ["a"]}, geometry=[shape], crs="EPSG:28992").to_file(tmp_path / "metres.shp")
    (tmp_path / "metres.prj").unlink()
    words = ["tiles", str(tmp_path / "metres.shp"), "-o", str(tmp_path / "out.pmtiles"), "--max-zoom", "4"]
    wrong = CliRunner().invoke(main, words)
    assert "give --source-crs EPSG:..." in wrong.stderr
    done = CliRunner().invoke(main, [*words, option, "EPSG:28992"])
    assert done.exit_code == 0, done.stderr
    with (tmp_path / "out.pmtiles").open("rb") as file:
        assert 4.2e7 < Reader(MmapSource(file)).header()["min_lon_e7"] < 4.4e7
    assert option == "--source-crs" or option not in CliRunner().invoke(main, ["tiles", "--help"]).stdout.split()


def test_no_processes_are_refused(source, tmp_path):
    words = ["tiles", str(source), "-o", str(tmp_path / "out.pmtiles"), "--processes", "0"]
    assert "--processes is 0; it must be at least 1" in CliRunner().invoke(main, words).stderr


def test_lines_and_points_are_left_out_and_said(tmp_path):
    shapes = [shapely.box(4, 51, 5, 52), shapely.LineString([(4, 51), (5, 52)]), shapely.Point(4, 52)]
    mixed = write_columns(tmp_path / "mixed.geojson", shapes, parcel=["a", "b", "c"])
    (note,) = made(mixed, tmp_path / "mixed.pmtiles", TileStyle()).notes
    assert note.count == 2
    assert note.message == "a line or point is left out, as tiles have polygons only: vexture map draws them"
    lines = write_columns(tmp_path / "lines.geojson", shapes[1:], parcel=["b", "c"])
    with pytest.raises(
        SourceError, match=r"lines\.geojson: it has lines or points \(2\), but no polygon, .* draw it by"
    ):
        made(lines, tmp_path / "lines.pmtiles", TileStyle())


def test_a_wrong_scheduler_is_refused_before_anything_is_begun(source, tmp_path):
    with pytest.raises(DeviceError, match="`scheduler` foo: no Dask scheduler answers there") as error:
        make_tiles(source, tmp_path / "parcels.pmtiles", TileOptions(scheduler="foo"))
    assert "finished" not in str(error.value)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "error", [MemoryError(), OSError(errno.ENOMEM, "no"), shapely.errors.GEOSException("bad_alloc")]
)
def test_too_little_memory_is_said_with_what_helps(source, tmp_path, error):
    def told(what, *_):
        if what == "parts":
            raise error

    remedy = "not enough memory; give `processes` 1, a larger `max_zoom`, which parts it finer, or .* `where`; what is"
    with pytest.raises(LimitError, match=remedy):
        make_tiles(source, tmp_path / "parcels.pmtiles", TileOptions(), told)


@pytest.mark.parametrize(
    ("number", "remedy"),
    [(errno.ENOSPC, "make room, or choose another disk"), (errno.EACCES, "correct that, or write elsewhere")],
)
def test_only_a_full_disk_needs_room(source, tmp_path, number, remedy):
    def told(*_):
        raise OSError(number, "as the disk says")

    with pytest.raises(
        DeviceError, match=f"{os.strerror(number)}; {remedy}; nothing of it is finished, and reading begins anew"
    ):
        make_tiles(source, tmp_path / "parcels.pmtiles", TileOptions(), told)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="it has no limits of files")
def test_a_disk_that_is_full_is_one_line(source, tmp_path):
    """A limit of a file's size stands for a full disk."""
    output = tmp_path / "parcels.pmtiles"
    words = [sys.executable, "-m", "vexture", "tiles", source, "-o", output, "--id", "parcel", "--processes", "1"]

    def limit():
        import resource

        resource.setrlimit(resource.RLIMIT_FSIZE, (20480, 20480))

    done = subprocess.run(words, preexec_fn=limit, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    (line,) = (line for line in done.stderr.splitlines() if "compiling" not in line)
    assert line.startswith(f"vexture: {output}: File too large; make room, or choose another disk; what is finished is")
    subprocess.run(words, check=True, capture_output=True)
    assert {path.name for path in tmp_path.iterdir()} == {"parcels.pmtiles", "parcels.parquet"}
