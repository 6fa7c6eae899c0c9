"""No file of features in XML, a database or a zip leads to another file or address, nor to a place outside a zip."""

import sys

import pytest
from click.testing import CliRunner
from links import make_source
from outside import message_of, one_line
from server import serving
from vector_links import IGNORED, NOTED, REFUSED, geodatabase, gml, kml

import vexture
from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture.cli.main import main
from vexture.conversion.reading import content_of
from vexture_geo.base.crs import MissingReferenceError
from vexture_geo.vector.features import feature_batches, read_features

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="inotify, which sees files that are opened, is Linux's")

ALL = REFUSED | NOTED | IGNORED


@pytest.mark.parametrize("way", ALL)
def test_vectors_lead_nowhere(way, folder, outside):
    path = make_source(ALL, way, folder, outside)
    notes = Notes()
    said = one_line(message_of(read_features, path, notes=notes))
    assert outside.take_accesses() == []
    assert said.startswith("READ") == (way not in REFUSED), said
    assert any("is not read" in str(note) for note in notes.in_order) == (way in NOTED)
    one_line(message_of(lambda: [*feature_batches(path.read_bytes(), notes=Notes())]))
    one_line(message_of(vexture.read, path))
    one_line(message_of(vexture.read, path.read_bytes()))
    assert outside.take_accesses() == []


def sources(folder, outside):
    found = []
    for number, way in enumerate(ALL):
        place = folder / str(number)
        place.mkdir()
        found.append(make_source(ALL, way, place, outside))
    return found


def test_servers_and_the_command_line_are_led_nowhere(folder, outside):
    given = sources(folder, outside)
    outcome = CliRunner().invoke(main, ["convert", *map(str, given), "-o", str(folder / "out"), "--jobs", "1"])
    assert outcome.exit_code == 1, outcome.output
    assert "Traceback" not in outcome.output
    assert outside.take_accesses() == []
    (folder / "shapes").mkdir()
    with serving(folder / "shapes") as server:
        for number, source in enumerate(given):
            server.put(f"a{number}", source.read_bytes())
        assert outside.take_accesses() == []
        assert server.ask("GET", "/openapi.json")[0] == 200


@pytest.mark.parametrize("part", ["a00000009.gdbtable", "a00000009.gdbtablx", "a00000001.gdbtable", "gdb"])
def test_a_geodatabase_leads_nowhere(part, folder, outside):
    base = geodatabase(folder)
    assert len(read_features(base, notes=Notes())) == 1
    secret = outside.folder / f"secret.{part}"
    (base / part).rename(secret)
    (base / part).symlink_to(secret)
    outside.take_accesses()
    for work in (lambda path: read_features(path, notes=Notes()), vexture.read, vexture.read_extent, content_of):
        said = one_line(message_of(work, base))
        assert f"its {part} is a link to another place, and no other file is read" in said
    outcome = CliRunner().invoke(main, ["map", str(base), "-o", str(folder / "a.ktx2")])
    assert "is a link to another place" in one_line(outcome.output.strip())
    assert outside.take_accesses() == []


def test_links_within_a_geodatabase_and_to_one_are_followed(folder):
    base = geodatabase(folder)
    (base / "gdb").rename(base / "own")
    (base / "gdb").symlink_to("own")
    (folder / "b.gdb").symlink_to(base)
    assert len(read_features(folder / "b.gdb", notes=Notes())) == 1


def test_what_is_beside_a_file_of_features_is_not_read(folder):
    (folder / "a.csv").write_text("x,y\n1,2\n")
    (folder / "a.prj").write_text("EPSG:28992")
    (folder / "a.csvt").write_text('"Integer","Integer"\n')
    with pytest.raises(MissingReferenceError):
        read_features(folder / "a.csv", notes=Notes())
    before = read_features(gml(folder), notes=Notes()).table
    (folder / "a.xsd").write_text("no schema")
    (folder / "a.gfs").write_text(
        "<GMLFeatureClassList><GMLFeatureClass><Name>x</Name></GMLFeatureClass></GMLFeatureClassList>"
    )
    assert read_features(folder / "a.gml", notes=Notes()).table.equals(before)
    assert {path.name for path in folder.iterdir()} == {"a.csv", "a.prj", "a.csvt", "a.gml", "a.xsd", "a.gfs"}


def test_entities_do_not_grow(folder):
    lines = "".join(f'<!ENTITY a{k} "{f"&a{k - 1};" * 10}">' for k in range(1, 9))
    path = kml(folder, "<name>&a8;</name>", f'<!DOCTYPE kml [<!ENTITY a0 "a">{lines}]>')
    with pytest.raises(SourceError, match="its DTD, 'kml', is not read; save it without a DOCTYPE"):
        read_features(path, notes=Notes())
