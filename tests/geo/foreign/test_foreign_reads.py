"""No source leads a reader to another file or address: in Python, on the command line and on servers."""

import os
import re
import sys
import urllib.request
from pathlib import Path

import numpy as np
import pyogrio
import pytest
from click.testing import CliRunner
from floods import flooding, sea
from links import ALONE, AREAS, DEPTHS, DRAWINGS, MODELS, RELIEFS, make_source, netcdf, plain, written
from outside import message_of, one_line, raster
from server import serving

import vexture
from vexture.base.notes import Notes
from vexture.cli.main import main
from vexture.gltf.model import read_model
from vexture_geo.base.extent import Frame
from vexture_geo.flood.ground import _warp_to_frame
from vexture_geo.flood.relief import _heights_of
from vexture_geo.vector.features import feature_batches, read_features

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="inotify, which sees files that are opened, is Linux's")

FRAME = Frame((0.0, 0.0, 22_000.0, 22_000.0), "EPSG:28992", (22_000.0, 22_000.0))
UNSAID = {"an SVG that includes", "an SVG with a DTD elsewhere", "an SVG with a DTD at an address"}
"""What SVG has no meaning for, or each editor writes."""


def test_the_watch_sees_a_file_and_a_request(outside):
    Path(outside["secret.csv"]).read_text()
    with pytest.raises(OSError, match="404"):
        urllib.request.build_opener(urllib.request.ProxyHandler({})).open(outside.url)
    assert outside.take_accesses() == ["secret.csv", "GET /secret HTTP/1.1"]
    assert outside.take_accesses() == []


@pytest.mark.parametrize("way", DEPTHS)
def test_depths_lead_nowhere(way, folder, outside):
    path = make_source(DEPTHS, way, folder, outside)
    said = one_line(message_of(vexture.read_extent, path))
    assert outside.take_accesses() == []
    assert re.search(r"secret|is no TIFF", said)
    one_line(message_of(vexture.read_extent, path.read_bytes(), path.name))
    assert outside.take_accesses() == []


@pytest.mark.parametrize("way", AREAS)
def test_features_lead_nowhere(way, folder, outside):
    path = make_source(AREAS, way, folder, outside)
    said = one_line(message_of(read_features, path, notes=Notes()))
    assert outside.take_accesses() == []
    named = way in ("GeoJSON with a file for a name", "a GeoPackage with a system in a file")  # names without a file
    assert named or re.search(r"secret|not recognized|no layers|no reference system", said)
    one_line(message_of(lambda: [*feature_batches(path.read_bytes(), notes=Notes())]))
    one_line(message_of(vexture.read, path))
    assert outside.take_accesses() == []


@pytest.mark.parametrize("way", DRAWINGS)
def test_drawings_lead_nowhere(way, folder, outside):
    path = make_source(DRAWINGS, way, folder, outside)
    for given in (path, path.read_bytes()):
        said = one_line(message_of(vexture.read, given, images="trace"))
        assert outside.take_accesses() == []
        assert (said == "READ ") == (way in UNSAID)


@pytest.mark.parametrize("way", MODELS)
def test_models_lead_nowhere(way, folder, outside):
    path = make_source(MODELS, way, folder, outside)
    model = read_model(path)
    said = one_line(message_of(model.save, folder / "out.glb"))
    assert outside.take_accesses() == []
    assert "it refers to" in said


@pytest.mark.parametrize("way", RELIEFS)
def test_the_ground_leads_nowhere(way, folder, outside):
    from PIL import Image

    path = make_source(RELIEFS, way, folder, outside)
    said = one_line(message_of(_heights_of, path, FRAME, (8, 8), None))
    assert re.search("secret|is no raster that can be read", said)
    said = one_line(message_of(_warp_to_frame, path, FRAME, Image.new("RGB", (8, 8))))
    assert re.search("secret|damaged GeoTIFF", said)
    assert outside.take_accesses() == []


def sources(kinds, folder, outside):
    """A source of each way, in a folder of its own."""
    found = []
    for number, way in enumerate(kinds):
        place = folder / str(number)
        place.mkdir()
        found.append(make_source(kinds, way, place, outside))
    return found


def test_command_line_leads_nowhere(outside, folder):
    given = [str(path) for path in sources(DEPTHS | AREAS | DRAWINGS, folder, outside)]
    outcome = CliRunner().invoke(main, ["convert", *given, "-o", str(folder / "out"), "--jobs", "1"])
    assert outcome.exit_code == 1, outcome.output
    assert "Traceback" not in outcome.output
    assert outside.take_accesses() == []


@pytest.mark.parametrize(("command", "output"), [("map", "out.ktx2"), ("tiles", "out")])
@pytest.mark.parametrize("way", ["GeoJSON with a link to its system", "JSON that is commands of GDAL"])
def test_maps_on_the_command_line_lead_nowhere(command, output, way, outside, folder):
    path = make_source(AREAS, way, folder, outside)
    outcome = CliRunner().invoke(main, [command, str(path), "-o", str(folder / output)])
    assert outcome.exit_code == 1, outcome.output
    assert str(path) in outcome.output
    assert "Traceback" not in outcome.output
    assert outside.take_accesses() == []


def test_uploads_lead_nowhere(outside, folder):
    given = sources({way: DEPTHS[way] for way in ALONE} | AREAS | DRAWINGS, folder, outside)
    (folder / "shapes").mkdir()
    with serving(folder / "shapes") as server:
        for number, source in enumerate(given):
            server.put(f"a{number}", source.read_bytes())
        assert outside.take_accesses() == []
        assert server.ask("GET", "/")[0] == 200


@pytest.mark.slow
def test_uploads_to_a_flood_lead_nowhere(outside, folder, page_is_built):
    given = sea(folder / "sea.geojson", 0.5, FRAME.crs, FRAME.bounds)
    with flooding(folder, "--extent", given) as server:
        for way in ALONE[::3]:  # a GeoTIFF, and NetCDF of two kinds
            (folder / way).mkdir()
            status, answer = server.put("flood", make_source(DEPTHS, way, folder / way, outside).read_bytes())
            assert (status, outside.take_accesses()) == (422, []), answer


def test_what_leads_nowhere_is_read(folder):
    """Files beside a raster that GDAL wrote, a NetCDF-4 file with names of its own, and a GeoPackage with an index."""
    path = raster(folder / "b.tif", plain())
    raster(folder / "b.tif.ovr", plain()[::2, ::2], placed=False)
    (folder / "b.tif.aux.xml").write_text('<PAMDataset><Metadata><MDI key="a">1</MDI></Metadata></PAMDataset>')
    assert message_of(vexture.read_extent, path).startswith("READ 2,200 x 2,200 cells are too many")
    assert message_of(vexture.read_extent, netcdf(folder / "b.nc", "plain", ""), crs="EPSG:28992").startswith("READ")
    assert len(read_features(written(folder / "b.gpkg"), notes=Notes())) == 1


def test_a_world_file_beside_a_raster_places_it(folder):
    path = raster(folder / "b.tif", np.full((4, 4), 2.0, np.float32), placed=False)
    (folder / "b.tfw").write_text("10\n0\n0\n-10\n5\n35\n")
    assert vexture.read_extent(path).frame.bounds == pytest.approx((0.0, 0.0, 40.0, 40.0), abs=4.0)


def test_others_read_all_formats_of_pyogrio_afterwards(folder):
    before = pyogrio.list_drivers()
    read_features(written(folder / "b.gpkg"), notes=Notes())
    assert pyogrio.list_drivers() == before
    assert pyogrio.get_gdal_config_option("GDAL_SKIP") is None
    assert os.environ.get("GDAL_SKIP") is None
