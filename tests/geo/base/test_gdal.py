"""Files beside a raster, and metadata in it, that would lead GDAL elsewhere are refused."""

import numpy as np
import pyogrio
import pytest
import rasterio
from rasterio.transform import Affine

from vexture.base.errors import SourceError
from vexture_geo.base.gdal import open_raster, plain_place, vector_formats


def write(path, **tags):
    profile = {"driver": "GTiff", "width": 2, "height": 2, "count": 1, "dtype": "uint8", "crs": "EPSG:28992"}
    with rasterio.open(path, "w", transform=Affine(1.0, 0.0, 0.0, 0.0, -1.0, 2.0), **profile) as file:
        file.write(np.ones((1, 2, 2), np.uint8))
        for domain, about in tags.items():
            file.update_tags(ns=domain, **about)
    return path


@pytest.mark.parametrize(
    ("ending", "content", "words"),
    [
        (".tif.ovr", b"<VRTDataset/>", "is no TIFF, and can lead to other files"),
        (".tif.ovr", b"II*\0 and no more", "is damaged"),
        (".aux", b"EHFA_HEADER_TAG", "is of a format that names other files"),
        (".prj", b"+proj=longlat +nadgrids=/secret/grid", "'/secret/grid'"),
        (".tif.aux.xml", b'<PAMDataset><MDI key="overview_file">/secret/a</MDI></PAMDataset>', "'/secret/a'"),
        (".tif.aux.xml", b"<PAMDataset><SRS>file:///secret</SRS></PAMDataset>", "file:///secret"),
        (".tif.aux.xml", b"<PAMDataset", "it is no XML"),
    ],
)
def test_a_file_beside_a_raster_that_leads_elsewhere_is_refused(tmp_path, ending, content, words):
    path = write(tmp_path / "a.tif")
    (tmp_path / f"a{ending}").write_bytes(content)
    with pytest.raises(SourceError, match=words), open_raster(path):
        pass


def test_files_beside_a_raster_that_lead_nowhere_are_let_be(tmp_path):
    path = write(tmp_path / "a.tif")
    (tmp_path / "a.prj").write_text("EPSG:28992")
    (tmp_path / "other.tif.ovr").write_bytes(b"<VRTDataset/>")  # of another raster
    with open_raster(path) as file:
        assert (file.crs.to_epsg(), file.read(1).sum()) == (28992, 4)


def test_metadata_that_name_another_file_are_refused(tmp_path):
    path = write(tmp_path / "a.tif", GEOLOCATION={"X_DATASET": "/secret/x.tif"})
    with pytest.raises(SourceError, match=r"name another file, '/secret/x\.tif' \(X_DATASET\)"), open_raster(path):
        pass


def test_characters_of_addresses_in_places_are_refused(tmp_path):
    assert plain_place(tmp_path / "a.gpkg") == str(tmp_path / "a.gpkg")
    for character in "!;?#":
        with pytest.raises(SourceError, match=f"has a {'[?]' if character == '?' else character}, as addresses have"):
            plain_place(f"/data/a{character}b.gpkg")


def test_gdal_knows_some_formats_within_and_all_afterwards():
    before = set(pyogrio.list_drivers())
    with vector_formats(["GeoJSON", "CSV"]):
        assert set(pyogrio.list_drivers()) == {"GeoJSON"}  # no format that is a list of files
    assert set(pyogrio.list_drivers()) == before
