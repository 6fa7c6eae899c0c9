"""Maps of data that is large, damaged or strange: each works, or ends in a line that says what to do."""

import os
import subprocess
import sys

import geopandas
import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
import shapely

from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import Notes
from vexture_geo.maps import MapLayer, Scale, convert_map
from vexture_geo.maps.colours import colours_of

METRES = "EPSG:28992"
BOXES = [shapely.box(k, 0, k + 1, 1) for k in range(4)]


def frame(values, shapes=BOXES, crs=METRES):
    return geopandas.GeoDataFrame({"v": values}, geometry=list(shapes), crs=crs)


def legend(source, column="v", **options):
    """Labels of the legend of a map."""
    done = convert_map([MapLayer(source, color=Scale(column, **options))], crs=METRES)
    entries = [entry["label"] for entry in done.legends[0]["entries"]]
    return [*entries, done.legends[0].get("no_data", {}).get("count", 0)]


@pytest.mark.parametrize(
    ("values", "labels"),
    [
        ([1.0, np.nan, np.inf, -np.inf], ["1", 3]),
        ([5, 5, 5, 5], ["5", 0]),
        ([True, False, None, True], ["False", "True", 1]),
        ([1, "a", None, 2.5], ["1", "2.5", "a", 1]),
        ([1j, 1j, 2j, 2j], ["1j", "2j", 0]),
        (pd.to_datetime(["2020-01-01", "2020-01-02", None, "2020-01-02"]).date, ["2020-01-01", "2020-01-02", 1]),
        (pd.Categorical(["a", "b", "a", None]), ["a", "b", 1]),
        (pd.Categorical(["up", "low", "up", "mid"], ["low", "mid", "up"], ordered=True), ["low", "mid", "up", 0]),
        (pd.cut([1, 2, 11, 12], [10, 20]), ["(10, 20]", 2]),
        (pd.PeriodIndex(["2020-02", "2020-01", "2020-02", None], freq="M"), ["2020-01", "2020-02", 1]),
        ([2**70, 1, 2, 3], ["1 – 1.6", "1.6 – 2.2", "2.2 – 4.72237e+20", "4.72237e+20 – 1.18059e+21", 0]),
    ],
)
def test_values_of_every_kind_have_colours(values, labels):
    assert legend(frame(values)) == labels


@pytest.mark.parametrize(
    ("values", "kind", "labels"),
    [
        ([1.0, 1.5, 2.0, 2.0, 2.0, 2.0, 2.000000000000001, 3.0], "quantiles", ["1 – 1.7", "1.7 – 3"]),
        ([1, 1, 1, 2, 2, 2], "quantiles", ["1", "2"]),
        ([1, 10], "quantiles", ["1 – 2", "3 – 10"]),
        ([0] * 85 + list(range(1, 16)), "quantiles", ["0", "1 – 15"]),
        ([0.5] * 85 + [1.5, 2.5], "quantiles", ["0.5 – 1.5", "1.5 – 2.5"]),
        ([0, None, 0, 0, None, 0, 7], "quantiles", ["0 – 1", "2 – 7"]),
        ([2020, 2021, 2022, 2023], "quantiles", ["2020", "2021", "2022", "2023"]),
        ([2020, 2021, 2022, 2023], "continuous", ["2020", "2021", "2022", "2023"]),
        ([0, 1, 100], "equal", ["0 – 19", "20 – 39", "40 – 59", "60 – 79", "80 – 100"]),
        ([28077.8, 2252281.4], "50000.25", ["28,077.8 – 50,000.2", "50,000.2 – 2,252,281"]),
        ([1, 4, 8], "100,200", ["1 – 100", "100 – 200", ">= 200"]),
        ([300, 400], "100,200", ["< 100", "100 – 200", "200 – 400"]),
        (
            [1000001, 1000003, 1000005],
            "1000002,1000004",
            ["1,000,001 – 1,000,002", "1,000,002 – 1,000,004", "1,000,004 – 1,000,005"],
        ),
        ([5, 5], "continuous", ["5"]),
        ([1.0, 2.5, 1.0], "categories", ["1", "2.5"]),
        (pd.to_datetime(["2001-01-01", "2001-01-02", None]), "categories", ["2001-01-01", "2001-01-02"]),
        (
            pd.to_datetime(["2001-01-01 00:00", "2001-01-02 12:00"]),
            "auto",
            ["2001-01-01 00:00:00", "2001-01-02 12:00:00"],
        ),
    ],
)
def test_entries_of_legends_are_told_apart_and_hold_something(values, kind, labels):
    table = pa.table({"v": pa.Array.from_pandas(pd.Series(values))})
    entries = colours_of(table, Scale("v", kind), Notes())[1]["entries"]
    assert [entry["label"] for entry in entries] == labels
    if kind == "quantiles":
        assert all(entry["count"] for entry in entries)


@pytest.mark.parametrize("layers", [MapLayer("x.gpkg"), ["x.gpkg"], "x.gpkg", frame([1] * 4)])
def test_what_is_no_list_of_layers_is_refused(layers):
    with pytest.raises(ParameterError, match="no list of layers; give one"):
        convert_map(layers)


def test_the_colour_of_a_layer_is_a_scale_or_a_column():
    assert MapLayer("x.gpkg", color="v").color == Scale("v")
    with pytest.raises(ParameterError, match="`color` is a int; give a Scale"):
        MapLayer("x.gpkg", color=3)


def test_a_series_of_geometries_has_no_attributes():
    done = convert_map([MapLayer(geopandas.GeoSeries(BOXES, crs=METRES))], crs=METRES)
    assert done.conversion.texture.roots[0].style.names == ("0", "1", "2", "3")


def test_columns_of_one_name_are_refused():
    twice = geopandas.GeoDataFrame(np.array([[1, 2]] * 4), columns=["v", "v"], geometry=BOXES, crs=METRES)
    with pytest.raises(ParameterError, match="several columns 'v'; rename"):
        convert_map([MapLayer(twice)], crs=METRES)


def test_texts_in_another_encoding_name_the_remedy_which_helps(tmp_path):
    places = frame(["Zuid", "Cura\u00e7ao", "b", "c"])
    places.to_file(tmp_path / "places.shp", encoding="latin1")
    (tmp_path / "places.cpg").unlink()
    with pytest.raises(SourceError, match=r"column 'v' are not UTF-8; .*ends in \.cpg"):
        legend(tmp_path / "places.shp")
    (tmp_path / "places.cpg").write_text("ISO-8859-1")
    assert "Cura\u00e7ao" in legend(tmp_path / "places.shp")


@pytest.mark.parametrize("where", ["source_crs", "crs"])
def test_unknown_reference_systems_name_the_right_option(where):
    source = frame([1] * 4, crs=None)
    given = {"source_crs": METRES, "crs": METRES, where: "EPSG:99999"}
    with pytest.raises((SourceError, ParameterError), match=f"name it as `{where}` EPSG"):
        convert_map([MapLayer(source, source_crs=given["source_crs"])], crs=given["crs"])


def test_a_ring_that_encloses_nothing_is_no_geometry():
    around = shapely.Polygon([(longitude, -70) for longitude in range(-90, 90, 10)])
    with pytest.raises(SourceError, match="geometry that can be drawn"):
        convert_map([MapLayer(frame([1], [around], "EPSG:4326"))])


def test_one_feature_across_the_world_and_another_over_a_pole():
    parts = [shapely.box(x, y, x + 5, y + 5) for x in range(-180, 180, 30) for y in range(-80, 80, 20)]
    pole = shapely.box(-180, -90, 180, -82)
    done = convert_map([MapLayer(frame([1, 2], [shapely.MultiPolygon(parts), pole], "EPSG:4326"), color=Scale("v"))])
    assert any("85.05 degrees" in str(note) for note in done.conversion.notes)
    texture = done.conversion.texture
    at = (np.radians([[-178, 0], [153, 2], [170, -83]]) - 0) * 6378137.0
    at[:, 1] = 6378137.0 * np.arcsinh(np.tan(np.radians([0.5, 2, -83])))
    root = texture.roots[0]
    found = texture.element_at((at - root.to_source[:, 2]) / root.to_source[0, 0]).name
    assert found.tolist() == ["0", "0", "1"]


@pytest.mark.slow
def test_a_polygon_of_a_million_corners():
    angle = np.linspace(0, 2 * np.pi, 1_000_000, endpoint=False)
    radius = 10 + np.cumsum(np.random.default_rng(0).normal(0, 1e-4, len(angle)))
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1) * radius[:, None]
    texture = convert_map([MapLayer(frame([1], [shapely.Polygon(ring)]))], crs=METRES).conversion.texture
    assert texture.element_at(np.array([[0.5, 0.5], [0.01, 0.01]])).name.tolist() == ["0", ""]


def circles(count, corners=120):
    angle = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    ring = 0.4 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    centre = np.stack([np.arange(count) % 200, np.arange(count) // 200], axis=1)
    shapes = shapely.polygons(centre[:, None] + ring)
    return geopandas.GeoDataFrame({"v": np.arange(count)}, geometry=shapes, crs="EPSG:28992")


@pytest.mark.slow
def test_a_source_larger_than_memory_ends_in_one_line_and_a_part_of_it_is_read(tmp_path):
    circles(60_000).to_parquet(tmp_path / "b.parquet")
    circles(60_000).to_file(tmp_path / "b.gpkg")
    script = "import resource, sys; from vexture.cli.main import main; n = int(sys.argv.pop(1)) << 20; "
    script += "resource.setrlimit(resource.RLIMIT_AS, (n, n)); main()"
    for name in ("b.parquet", "b.gpkg"):
        command = ["map", str(tmp_path / name), "--crs", "EPSG:28992", "-o", str(tmp_path / "m.ktx2")]
        for limit in (800, 1000, 1200, 1500):
            given = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
            run = [sys.executable, "-c", script, str(limit), *command]
            done = subprocess.run(run, capture_output=True, text=True, env=given, check=False)
            (line,) = (line for line in done.stderr.splitlines() if "compiling kernels" not in line)
            assert done.returncode == 1
            assert "more memory than there is; choose fewer features by --where" in line
        run[3] = "3500"  # of addresses, of which libraries take most
        few = subprocess.run([*run, "--where", "v < 500"], capture_output=True, text=True, env=given, check=False)
        assert few.returncode == 0, few.stderr[:2000]
