"""Damage that GDAL and netCDF do not name is found and told."""

import json

import pytest

from vexture.base.content import SHAPEFILE
from vexture.base.errors import SourceError
from vexture_geo.base.damage import missing_arcs, netcdf_error, refuse_cut


def header(words):
    """The first 100 bytes of a .shp of so many words of two bytes."""
    return SHAPEFILE + bytes(24 - len(SHAPEFILE)) + words.to_bytes(4) + bytes(72)


def test_a_shapefile_must_have_the_bytes_that_it_says():
    refuse_cut("a.shp", header(100), 200)
    refuse_cut("a.shp", header(100), 201)  # what follows is nobody's
    with pytest.raises(SourceError, match=r"a\.shp is damaged: it has 199 of the 200 bytes"):
        refuse_cut("a.shp", header(100), 199)
    refuse_cut("a.shp", b"no shapefile" + bytes(100), 0)


def topology(count, *geometries):
    return json.dumps({"arcs": [[]] * count, "objects": {"all": {"geometries": geometries}}}).encode()


def test_arcs_are_counted_from_either_end():
    assert missing_arcs(topology(2, {"arcs": [[0, 1, -1, -2]]})) == 0
    assert missing_arcs(topology(2, {"arcs": [[-3]]}, {"arcs": [[[2]]]}, {"arcs": [1]})) == 2


def test_geometries_in_collections_are_looked_at():
    inner = {"type": "GeometryCollection", "geometries": [{"arcs": [5]}, {"arcs": [[5, 6]]}]}
    assert missing_arcs(topology(1, {"type": "GeometryCollection", "geometries": [inner]})) == 2


@pytest.mark.parametrize(
    "content", [b"{", b"[]", b'{"arcs": 3, "objects": {}}', b'{"arcs": [], "objects": []}', b"\xff"]
)
def test_what_is_no_topology_misses_nothing(content):
    assert missing_arcs(content) == 0


def test_errors_of_the_system_are_those_of_a_header():
    for number in (7, 22):
        assert "its header says what cannot be" in str(netcdf_error(OSError(number, "Argument"), "a.nc"))
    other = str(netcdf_error(OSError(5, "Input/output error", "/secret/a.nc"), "/secret/a.nc"))
    assert other.startswith("it cannot be read as NetCDF (")
    assert "/secret" not in other
