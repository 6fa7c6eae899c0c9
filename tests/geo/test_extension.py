"""What vexture calls by its entry point: each function takes what is its own, and leaves the rest."""

import io
import zipfile

import pytest
from test_interrupt import check_early_end

from vexture.base.content import FileKind
from vexture.base.errors import SourceError
from vexture_geo import extension

POND = b'{"type": "Polygon", "coordinates": [[[4, 52], [5, 52], [5, 53], [4, 53], [4, 52]]]}'


def zipped(**files):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, data in files.items():
            archive.writestr(name.replace("_", "."), data)
    return content.getvalue()


def test_a_zip_is_what_it_holds_and_other_files_are_themselves():
    assert extension.unpack(zipped(pond_geojson=POND, readme_txt=b"of the pond"), "a.zip") == POND
    assert extension.unpack(POND, "pond.geojson") is POND
    with pytest.raises(SourceError, match="the zip holds no shapefile"):
        extension.unpack(zipped(readme_txt=b"nothing"), "a.zip")


def test_only_files_in_several_parts_are_packed(tmp_path):
    (tmp_path / "pond.geojson").write_bytes(POND)
    assert extension.pack(tmp_path / "pond.geojson") is None
    assert extension.describe_tiles(tmp_path / "pond.geojson") is None


def test_areas_are_read_with_their_name():
    drawing = extension.read_drawing(FileKind.GEOJSON, POND, "pond.geojson", "pond", names=None, snap=None)
    assert (drawing.name, drawing.segments) == ("pond", 4)


def test_what_is_no_flood_has_no_widget():
    assert extension.flood_widget("pond.geojson", {}) is None
    assert extension.flood_widget(b"", {"height": 300}) is None


def test_ctrl_c_ends_a_command_while_its_module_is_imported():
    check_early_end("vexture_geo.cli.map", "map")
