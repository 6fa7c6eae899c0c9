"""Flood polygons that are invalid, broken or hostile: repaired, or one line that says what to do."""

import zipfile
from io import BytesIO

import numpy as np
import pytest
import shapely
from geographic import FORMATS, LAKE, POND, UTM, file, geopackage_of, only, same

from vexture.base.deadline import within
from vexture.base.errors import LimitError, SourceError, SourceWarning
from vexture_geo.readers import read_extent


@pytest.mark.parametrize("name", ["a.gpkg", "a.fgb", "a.geojson"])
def test_invalid_rings_are_repaired(tmp_path, name):
    bow = shapely.Polygon([(0, 0), (10, 10), (10, 0), (0, 10)])
    outside = shapely.Polygon([(20, 0), (30, 0), (30, 10), (20, 10)], [[(28, 2), (36, 2), (36, 4), (28, 4)]])
    doubled = shapely.Polygon([(40, 0), (40, 0), (50, 0), (50, 0), (50, 10), (40, 0)])
    path = file(tmp_path, name, [bow, outside, doubled, POND], driver=None)
    drawing = only(read_extent(path, name, crs=UTM, bounds=(0, 0, 60, 10)))
    lobes = [shapely.Polygon([(0, 0), (5, 5), (0, 10)]), shapely.Polygon([(10, 0), (10, 10), (5, 5)])]
    notched = shapely.difference(shapely.box(20, 0, 30, 10), shapely.box(28, 2, 36, 4))
    expected = shapely.union_all([*lobes, notched, shapely.Polygon([(40, 0), (50, 0), (50, 10)])])
    assert same(drawing, expected)


def test_rings_that_are_not_closed_are_closed(tmp_path):
    corners = [(0, 0), (10, 0), (10, 10), (0, 10)]
    path = geopackage_of(tmp_path / "open.gpkg", "01030000000100000004000000", corners)
    assert same(only(read_extent(path, "open.gpkg")), shapely.box(0, 0, 10, 10))


def test_a_polygon_that_encloses_nothing_is_left_out(tmp_path):
    flat = shapely.Polygon([(0, 0), (10, 10), (5, 5), (0, 0)])
    with pytest.warns(SourceWarning, match="left out: polygon that encloses nothing"):
        drawing = only(read_extent(file(tmp_path, "flat.gpkg", [flat, POND]), "flat.gpkg"))
    assert same(drawing, POND)


def test_a_tangle_whose_repair_would_not_end_is_refused(tmp_path):
    tangle = shapely.Polygon(np.random.default_rng(1).uniform(0, 1e4, (2500, 2)))
    path = file(tmp_path, "tangle.gpkg", [POND, tangle])
    with pytest.raises(LimitError, match="takes longer than"), within(1e-9):
        read_extent(path, "tangle.gpkg")
    with pytest.raises(SourceError, match=r"feature 2.*: its sides cross more than 250,000 times; correct"):
        read_extent(path, "tangle.gpkg")


@pytest.mark.parametrize("value", [np.nan, np.inf, -1e300])
@pytest.mark.parametrize("name", ["a.gpkg", "a.fgb"])
def test_a_coordinate_beyond_all_limits_is_refused_by_name(tmp_path, name, value):
    hole = [(588500, 4091000), (589500, 4091000), (value, 4092000)]
    with np.errstate(invalid="ignore"):
        bad = shapely.MultiPolygon([POND, shapely.Polygon(LAKE.exterior, [hole])])
        path = file(tmp_path, name, [LAKE, bad])
    with pytest.raises(SourceError, match=r"feature 2, polygon 2, ring 2: a point is at .*,4\.09.*; the limit"):
        read_extent(path, name)


@pytest.mark.parametrize("share", [0.02, 0.3, 0.6, 0.95, 0.999])
@pytest.mark.parametrize("name", ["lake.gpkg", "lake.fgb", "lake.zip", "lake.geojson"])
def test_a_file_that_breaks_off_is_one_line_and_nothing_on_stderr(tmp_path, name, share, capfd):
    rng = np.random.default_rng(1)
    shapes = [shapely.Point(*centre).buffer(50, 64) for centre in rng.uniform(0, 1e5, (200, 2))]
    path = file(tmp_path, name, shapes)
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    capfd.readouterr()
    with pytest.raises(SourceError) as raised:
        read_extent(path, name)
    assert str(raised.value).count("\n") == 0
    assert "/vsi" not in str(raised.value)
    assert capfd.readouterr() == ("", "")


def inside_zip(**files):
    packed = BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name, content in files.items():
            archive.writestr(name.replace("_", "."), content)
    return packed.getvalue()


VRT = b"""<OGRVRTDataSource><OGRVRTLayer name="a"><SrcDataSource>/etc/passwd</SrcDataSource></OGRVRTLayer>
</OGRVRTDataSource>"""
PIPELINE = b'{"type": "gdal_streamed_alg", "command_line": "gdal vector read /vsicurl/http://127.0.0.1/a.gpkg"}'


@pytest.mark.parametrize(
    ("content", "name", "line"),
    [
        (VRT, "a.gpkg", "none of GeoJSON, GeoPackage"),
        (VRT, "a.shp", "none of GeoJSON, GeoPackage"),
        (PIPELINE, "a.gdalg.json", "'gdal_streamed_alg' is none that GeoJSON knows"),
        (b"SQLite format 3\0" + bytes(200), "a.gpkg", "damaged"),
        (inside_zip(a_vrt=VRT), "a.zip", "holds no shapefile"),
        (inside_zip(a_shp=VRT, a_shx=VRT), "a.zip", "no layers"),
        (inside_zip(a_shp=b"\0\0\x27\x0a" + bytes(200)), "a.zip", r"lacks its a\.shx"),
        (b"PK\x03\x04", "a.zip", "damaged"),
        (b"fgb\x03fgb", "a.fgb", "no layers"),
        (b"", "a.gpkg", "none of GeoJSON, GeoPackage"),
        (b"", "a.geojson", "not JSON"),
        (b"[1, 2]", "a.geojson", "not GeoJSON"),
    ],
)
def test_only_the_formats_meant_here_are_opened(content, name, line):
    with pytest.raises(SourceError, match=line) as raised:
        read_extent(content, name)
    assert str(raised.value).count("\n") == 0


@pytest.mark.parametrize(
    "name", ["/vsicurl/http://127.0.0.1:9/a.gpkg", "http://127.0.0.1:9/a.gpkg", "absent.gpkg", "a\0.shp"]
)
def test_a_name_is_that_of_a_file_on_the_disk_or_of_none(name):
    with pytest.raises(SourceError, match="cannot be read"):
        read_extent(name, "a.gpkg")


def test_names_with_marks_are_names(tmp_path):
    folder = tmp_path / "a!b?c#d"
    folder.mkdir()
    for name in FORMATS:
        file(tmp_path, name)
    for path in list(tmp_path.glob("lake.*")):
        path.rename(folder / path.name.replace("lake", "water!lake", 1))
    for name in FORMATS:
        path = folder / f"water!{name}"
        assert same(only(read_extent(path, path.name, crs=UTM)), shapely.union(LAKE, POND)), name


def test_a_shapefile_without_its_index_says_so(tmp_path):
    path = file(tmp_path, "lake.shp")
    path.with_suffix(".shx").unlink()
    with pytest.raises(SourceError, match=r"lake\.shp lacks its lake\.shx"):
        read_extent(path, "lake.shp")


def test_a_damaged_projection_file_is_one_line(tmp_path):
    path = file(tmp_path, "lake.shp")
    text = path.with_suffix(".prj").read_text()
    for damaged in (text[:50], "EPSG:1", text.replace("PROJECTION", "PROJECTIO"), "\0" * 9):
        path.with_suffix(".prj").write_text(damaged)
        with pytest.raises(SourceError) as raised:
            read_extent(path, "lake.shp")
        assert "\n" not in str(raised.value)
