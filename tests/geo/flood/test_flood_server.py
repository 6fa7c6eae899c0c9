"""A flood on a server: what is pushed comes into its frame, or is refused in one line."""

import io
import json
import zipfile
from contextlib import closing

import numpy as np
import pytest
from attacks import NO_REQUESTS, refusal_status, rest
from described import check_description
from floods import BOUNDS, CRS, TOKEN, depths, flooding, geotiff, scene_of, sea, series
from server import COMMAND, Stream

from vexture.server.limits import Limits
from vexture.texture.load import texture_from

pytestmark = pytest.mark.usefixtures("page_is_built")

PLACE = ["--bounds", ",".join(map(str, BOUNDS))]
PLACES = np.array([[0.2, 0.5], [0.4, 0.5], [0.6, 0.5], [0.8, 0.5]])
"""In the unit square, from west to east through the frame."""


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("flood")
    with flooding(folder, "--extent", sea(folder / "sea.geojson", 0.5), *PLACE) as running:
        yield running


def wet(server, name="flood"):
    """Which of our places are under water now."""
    return wet_in(server, server.manifest(name))


def wet_in(server, manifest):
    data = server.ask("GET", "/" + manifest["texture"].replace("../", ""))[2]
    return texture_from(data, "water").contains(PLACES).tolist()


def written(path, share, **options):
    """A file of an area up to a share of the width, in one of the formats that geographic programs write."""
    import pyogrio.raw
    import shapely

    west, south, east, north = BOUNDS
    area = shapely.box(west - 100.0, south - 100.0, west + share * (east - west), north + 100.0)
    pyogrio.raw.write(path, shapely.to_wkb(np.array([area], object)), [], [], geometry_type="Polygon", **options)
    return path.read_bytes()


def test_what_is_no_request_is_told_so_and_newer_water_is_shown(server, tmp_path):
    for sent, status in NO_REQUESTS:
        with closing(server.peer(sent)) as peer:
            assert refusal_status(rest(peer)) == status
    assert server.put("flood", sea(tmp_path / "a.json").read_bytes())[0] == 200


def test_page_tells_where_everything_is(server):
    status, headers, page = server.ask("GET", "/")
    assert status == 200
    assert "script-src 'self'" in headers["Content-Security-Policy"]
    told = scene_of(page)
    assert told["server"] == "./"
    flood = told["flood"]
    assert "flood" in flood["steps"]
    for address, kind in (
        (flood["ground"], "image/webp"),
        (flood["fold"], "image/ktx2"),
        ("flood.js", "text/javascript"),
    ):
        status, headers, content = server.ask("GET", f"/{address}")
        assert (status, headers["Content-Type"].partition(";")[0]) == (200, kind)
        again = server.ask("GET", f"/{address}", headers={"If-None-Match": headers["ETag"]})
        assert (again[0], again[2]) == (304, b"")
        assert content


def test_it_describes_itself(server):
    check_description(server.url, "flood", Limits())


def test_a_push_changes_what_everyone_sees(server, tmp_path):
    assert server.put("flood", sea(tmp_path / "a.json", 0.5).read_bytes())[0] == 200
    stream = Stream(server)
    assert stream.next()[0] == "hello"
    status, told = server.put("flood", sea(tmp_path / "b.json", 0.7).read_bytes())
    assert status == 200, told
    assert stream.next() == ("shape", {"name": "flood", "version": told["version"]})
    stream.close()
    assert wet(server) == [True, True, True, False]


@pytest.mark.parametrize(
    ("suffix", "options"),
    [(".gpkg", {"driver": "GPKG", "crs": CRS}), (".fgb", {"driver": "FlatGeobuf", "crs": CRS})],
)
def test_areas_of_every_kind(server, tmp_path, suffix, options):
    status, told = server.put("flood", written(tmp_path / f"area{suffix}", 0.7, **options))
    assert status == 200, told
    assert wet(server) == [True, True, True, False]


def test_zipped_shapefile(server, tmp_path):
    written(tmp_path / "area.shp", 0.3, driver="ESRI Shapefile", crs=CRS)
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for file in tmp_path.glob("area.*"):
            archive.write(file, file.name)
    status, told = server.put("flood", out.getvalue())
    assert status == 200, told
    assert wet(server) == [True, False, False, False]


def test_depths_in_another_reference_system(server, tmp_path):
    import rasterio.warp

    bounds = rasterio.warp.transform_bounds(CRS, "EPSG:4326", *BOUNDS)
    west, south, east, north = bounds
    wide = (west - 0.01, south - 0.01, east + 0.01, north + 0.01)
    data = geotiff(tmp_path / "d.tif", depths(0.5, 60, 120), crs="EPSG:4326", bounds=wide).read_bytes()
    status, told = server.put("flood", data)
    assert status == 200, told
    assert wet(server) == [True, True, False, False]
    facts = told["facts"]
    assert 1.0 < facts["deepest"] < 2.0
    assert (facts["dry"], facts["time"]) == (False, None)
    assert told["views"]["depth"].endswith(".png")


def test_one_step_of_a_model_with_its_time(server, tmp_path):
    status, told = server.put("flood/24", series(tmp_path / "run.nc", [0.7]).read_bytes())
    assert status in (200, 201), told
    assert told["facts"]["time"] == "2026-02-14T06:00:00+00:00"
    assert told["facts"]["label"] == "14 Feb 2026 06:00 UTC"
    assert "flood/24" in json.loads(server.ask("GET", "/shapes")[2])["shapes"]


@pytest.mark.parametrize("address", ["flood/24", "flood%2F24"])
def test_addresses_in_a_manifest_lead_to_files_however_the_slash_is_written(server, tmp_path, address):
    from urllib.parse import urljoin, urlsplit

    server.put("flood/24", sea(tmp_path / "s.json", 0.3).read_bytes())
    manifest = server.manifest(address)
    for relative, kind in ((manifest["texture"], "image/ktx2"), (manifest["texture"], "image/ktx2")):
        path = urlsplit(urljoin(f"{server.url}shapes/{address}", relative)).path
        status, headers, _ = server.ask("GET", path)
        assert (status, headers["Content-Type"]) == (200, kind)
    assert urlsplit(urljoin(f"{server.url}shapes/{address}", manifest["events"])).path == "/events"


def test_texture_of_this_frame_comes_back(server, tmp_path):
    server.put("flood", sea(tmp_path / "a.json", 0.7).read_bytes())
    manifest = server.manifest("flood")
    texture = server.ask("GET", "/" + manifest["texture"].replace("../", ""))[2]
    server.put("flood", sea(tmp_path / "b.json", 0.3).read_bytes())
    status, told = server.put("flood", texture)
    assert status == 200, told
    assert wet(server) == [True, True, True, False]
    assert told["facts"]["dry"] is False


def test_dry_push_is_shown_as_dry(server, tmp_path):
    status, told = server.put("flood", geotiff(tmp_path / "dry.tif", depths(deep=0.01)).read_bytes())
    assert status == 200, told
    assert told["facts"]["dry"]
    assert wet(server) == [False] * 4


def unfit(folder):
    """Content that is not shown, and what the one line says."""
    far = (600000.0, 5000000.0, 604000.0, 5002000.0)
    from vexture import convert
    from vexture.drawing.drawing import Drawing

    return {
        "svg": (b'<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></svg>', "has no place in the world"),
        "empty": (b" ", "the upload is empty"),
        "outside": (sea(folder / "far.json", 0.5, bounds=far).read_bytes(), "flood: "),
        "unplaced": (geotiff(folder / "u.tif", depths(), crs=None).read_bytes(), "write it into the file"),
        "series": (series(folder / "run.nc", [0.3, 0.6]).read_bytes(), "flood: "),
        "texture": (convert(Drawing.polygon([(0, 0), (1, 0), (0, 1)])).to_ktx2(), "not made in the frame"),
        "damaged": (b"II*\0" + bytes(100), "flood: "),
        "all unknown": (geotiff(folder / "n.tif", np.full((9, 9), np.nan, np.float32)).read_bytes(), "flood: "),
    }


@pytest.mark.parametrize("case", ["svg", "empty", "outside", "unplaced", "series", "texture", "damaged", "all unknown"])
def test_what_does_not_fit_is_refused_and_the_last_water_stays(server, tmp_path, case):
    server.put("flood", sea(tmp_path / "good.json", 0.7).read_bytes())
    before = server.manifest("flood")
    content, said = unfit(tmp_path)[case]
    status, told = server.put("flood", content)
    assert status == 422, told
    assert said in told["error"]
    assert "\n" not in told["error"]
    assert "`crs`" not in told["error"]
    after = server.manifest("flood")
    assert after["version"] == before["version"]
    assert after["note"] == told["error"]


def test_other_names_are_not_shown_here(server, tmp_path):
    status, told = server.put("duck", sea(tmp_path / "s.json").read_bytes())
    assert status == 422
    assert "this server shows flood and flood/NAME only" in told["error"]


@pytest.mark.parametrize("name", ["flood/../x", "flood//1", "flood/.hidden", "flood/"])
def test_names_lead_nowhere_else(server, name):
    from urllib.parse import quote

    assert server.put(quote(name, safe=""), b"{}")[0] == 400


def test_push_command(server, tmp_path):
    import subprocess

    secret = tmp_path / "secret"
    secret.write_text(TOKEN)
    file = geotiff(tmp_path / "depth.tif", depths(0.4, deep=3.0))
    command = [*COMMAND, "push", str(file), f"{server.url}shapes/flood/07", "--token-file", str(secret)]
    outcome = subprocess.run(command, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stdout.startswith("flood/07: ")
    assert wet(server, "flood/07") == [True, False, False, False]


def test_without_a_token_nobody_publishes_and_strangers_names_are_refused(tmp_path):
    extent = sea(tmp_path / "sea.geojson")
    with flooding(tmp_path, "--extent", extent, *PLACE, token=False) as server:
        assert "shows 1 step, " in server.said
        assert server.put("flood", extent.read_bytes())[0] == 403
        assert server.ask("GET", "/", headers={"Host": "evil.example"})[0] == 421
        assert server.ask("GET", "/")[0] == 200
        code, _, errors = server.stop()
        assert (code, [line for line in errors.splitlines() if "note:" not in line]) == (0, [])
