"""Tables of attributes replace only tables of maps."""

import geopandas
import pytest
import shapely
from click.testing import CliRunner

from vexture.cli.main import main

METRES = "EPSG:28992"


def cells(count):
    return geopandas.GeoDataFrame(
        {"code": range(count)}, geometry=[shapely.box(k, 0, k + 1, 1) for k in range(count)], crs=METRES
    )


@pytest.mark.parametrize("kind", ["parquet", "arrow"])
def test_a_table_replaces_only_tables_of_maps(kind, tmp_path):
    cells(5).to_file(tmp_path / "land.gpkg")
    command = ["map", str(tmp_path / "land.gpkg"), "-o", str(tmp_path / "land.ktx2"), "--table", kind]
    table = tmp_path / f"land.{kind}"
    (cells(3).to_parquet if kind == "parquet" else cells(3).to_feather)(table)
    before = table.read_bytes()
    done = CliRunner().invoke(main, command)
    assert done.exit_code == 1
    assert f"land.{kind} is there, and no table of a map; give another --output, or --table none" in done.output
    assert table.read_bytes() == before
    assert not (tmp_path / "land.ktx2").exists()
    table.unlink()
    assert [CliRunner().invoke(main, command).exit_code for _ in range(2)] == [0, 0]
