"""Zips of features, and folders of geodatabases."""

import sys
import zipfile

import pytest
from vector_links import kml, zip_files

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.vector.features import read_features

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="inotify, which sees files that are opened, is Linux's")


def test_names_in_a_zip_are_no_places(folder, tmp_path):
    content = kml(folder, "").read_text()
    archive = zip_files(folder, **{"../out_kml": content})
    assert len(read_features(archive, notes=Notes())) == 1
    with zipfile.ZipFile(folder / "b.zip", "w") as packed:
        packed.writestr("../up.gdb/a00000001.gdbtable", bytes(40))
        packed.writestr("../up.gdb/../../b.txt", "b")
    with pytest.raises(SourceError, match="GDAL cannot read it"):
        read_features(folder / "b.zip", notes=Notes())
    assert sorted(path.name for path in folder.iterdir()) == ["a.kml", "a.kmz", "b.zip"]
    assert not [*folder.parent.glob("*.gdb")]


def test_a_file_without_a_name_in_a_zip_is_passed_over(folder):
    archive = zip_files(folder, a_kml=kml(folder, "").read_text(), b_kml="")
    content = archive.read_bytes()
    at = content.rindex(b"PK\x01\x02")
    assert content[at + 28 : at + 30] == b"\5\0"
    nameless = content[: at + 28] + b"\0\0\0\0\5\0" + content[at + 34 :]  # its name is a comment now
    assert len(read_features(nameless, notes=Notes())) == 1


def test_a_zip_that_says_too_much_is_refused(folder):
    archive = zip_files(folder, a_kml="<kml/>")
    content = bytearray(archive.read_bytes())
    entry = content.index(b"PK\x01\x02")
    content[entry + 24 : entry + 28] = (2**31).to_bytes(4, "little")
    with pytest.raises(SourceError, match="larger than 268,435,456 bytes"):
        read_features(bytes(content), notes=Notes())
