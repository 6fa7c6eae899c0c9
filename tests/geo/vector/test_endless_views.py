"""Databases whose views never end: the limit of a conversion ends GDAL, too."""

import sqlite3
from pathlib import Path

import numpy as np
import pytest
import shapely
from pyogrio import raw

import vexture.base.apart as apart_module
from typed_commands import run_command

ENDLESS = (
    "CREATE VIEW v AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT c.x AS fid, geom FROM c, t"
)


def endless_view(path: Path) -> Path:
    """A GeoPackage whose layer is a view that counts without end: SQLite never comes back from it."""
    geometry = np.array([shapely.to_wkb(shapely.box(4, 52, 5, 53))], object)
    raw.write(path, geometry, [], [], layer="t", driver="GPKG", geometry_type="Polygon", crs="EPSG:4326")
    with sqlite3.connect(path) as database:
        database.execute(ENDLESS)
        for table in ("gpkg_contents", "gpkg_geometry_columns"):
            database.execute(f"UPDATE {table} SET table_name = 'v'")
        database.execute("UPDATE gpkg_contents SET identifier = 'v'")
        for table in ("gpkg_extensions", "gpkg_ogr_contents"):
            database.execute(f"DELETE FROM {table}")
    database.close()
    return path


@pytest.fixture(autouse=True)
def short_grace(monkeypatch: pytest.MonkeyPatch) -> None:
    """What GDAL does meanwhile keeps a processor."""
    monkeypatch.setattr(apart_module, "GRACE", 0.1)


def test_a_view_without_end_meets_the_limit_and_others_are_read(tmp_path: Path) -> None:
    """It kept GDAL, and so the command, for ever: neither the limit nor Ctrl-C ended it."""
    endless, other = endless_view(tmp_path / "endless.gpkg"), tmp_path / "other.svg"
    other.write_text("<svg")
    ended = run_command("convert", endless, other, "-o", tmp_path / "out", "--max-seconds", "4", "-q")
    first, second, last = ended.stderr.splitlines()
    assert first == f"vexture: {endless}: converting takes longer than 4 s; simplify the drawing or raise --max-seconds"
    assert second.startswith(f"vexture: {other}: not well-formed XML"), "which is read all the same"
    assert (ended.returncode, last) == (1, "vexture: 2 of 2 files failed")
    assert not (tmp_path / "out").exists()


def test_a_map_of_a_view_without_end_meets_the_limit(tmp_path: Path) -> None:
    endless = endless_view(tmp_path / "endless.gpkg")
    before = sorted(tmp_path.iterdir())
    ended = run_command("map", endless, "-o", tmp_path / "map.ktx2", "--max-seconds", "0.3")
    line = f"vexture: {endless}: converting takes longer than 0.3 s; simplify the drawing or raise --max-seconds\n"
    assert (ended.returncode, ended.stdout, ended.stderr) == (1, "", line)
    assert sorted(tmp_path.iterdir()) == before
