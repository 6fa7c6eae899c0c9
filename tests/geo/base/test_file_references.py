"""Reference systems that name files or addresses are refused; those that name grids of PROJ are not."""

import json

import pytest

from vexture.base.errors import SourceError
from vexture_geo.base.file_references import refuse_files_of_json, refuse_files_of_system


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("+proj=longlat +nadgrids=/etc/passwd +no_defs", "/etc/passwd"),
        ("+proj=longlat +nadgrids=@../grid.gsb", "../grid.gsb"),
        ("+init=./epsg:4326", "./epsg:4326"),
        ("file:///etc/passwd", "file:///etc/passwd"),
        ("  HTTPS://example.org/crs", "HTTPS://example.org/crs"),
        ('PARAMETERFILE["Latitude and longitude difference file","\\\\server\\grid"]', "server"),
        ('EXTENSION["PROJ4_GRIDS","~/grid"]', "~/grid"),
        (json.dumps({"parameters": [{"name": "file", "value": "/tmp/grid.tif"}]}), "/tmp/grid.tif"),
        (json.dumps({"method": {"name": "PROJ grids=http://example.org/a"}}), "http://example.org/a"),
    ],
)
def test_files_and_addresses_are_named(text, named):
    with pytest.raises(SourceError, match="no other file is read") as caught:
        refuse_files_of_system(text)
    assert named in str(caught.value).replace("\\\\", "\\")


@pytest.mark.parametrize(
    "text",
    [
        "+proj=longlat +nadgrids=@conus,@null +no_defs",
        "http://www.opengis.net/def/crs/EPSG/0/4326",
        'GEOGCRS["a name / with a slash"]',
        'PARAMETERFILE["difference file","us_noaa_conus.tif"]',
        json.dumps({"name": "RD / New", "parameters": [{"name": "scale", "value": 1.0}]}),
        "{no json",
    ],
)
def test_names_of_systems_and_of_grids_are_none(text):
    assert not _is_refused(text)
    assert _is_refused(f"{text} +nadgrids=/secret/grid") == (not text.startswith("{"))  # which is no JSON any more


def _is_refused(text):
    try:
        refuse_files_of_system(text)
    except SourceError:
        return True
    return False


@pytest.mark.parametrize("key", ["crs", "CRS", "\\u0063rs"])
@pytest.mark.parametrize("kind", ["link", "URL"])
def test_links_in_geojson_are_refused_however_their_key_is_written(key, kind):
    content = f'{{"type": "Point", "{key}": {{"type": "{kind}", "properties": {{"href": "http://example.org/a"}}}}}}'
    with pytest.raises(SourceError, match=r"is a link to 'http://example\.org/a', and nothing is fetched"):
        refuse_files_of_json(content.encode())


def test_geojson_may_name_a_system_or_have_a_property_of_that_name():
    for value in ('{"type": "name", "properties": {"name": "EPSG:28992"}}', "null", '"EPSG:4326"', "3"):
        refuse_files_of_json(b'{"crs": %s, "type": "Point"}' % value.encode())
    with pytest.raises(SourceError, match="its crs, at byte 8, is no reference system"):
        refuse_files_of_json(b'{"crs": {"type"')
