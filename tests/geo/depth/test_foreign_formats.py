"""Files of flood models that are not read: the error names the format and what to do."""

import zipfile

import h5py
import numpy as np
import pytest
import xarray

from vexture.base.errors import SourceError
from vexture.conversion.reading import read_drawing
from vexture_geo.depth.depths import read_depths
from vexture_geo.readers import extent_of

SELAFIN = b"\0\0\0\x50" + b"Breach of a dam".ljust(72) + b"SERAFIN " + b"\0\0\0\x50"
MIKE = b"DHI_DFS_ MIKE Zero - this file contains binary data, do not edit\x1a"
STARTS = [
    ("run.slf", SELAFIN, "Selafin of TELEMAC, which is not read; add it to QGIS as a mesh layer"),
    ("run.slf", SELAFIN.replace(b"\0\0\0\x50", b"\x50\0\0\0").replace(b"SERAFIN ", b"SERAFIND"), "Selafin of TELEMAC"),
    ("run.dfs0", MIKE, r"a \.dfs0 of MIKE, which is not read; it is of points"),
    ("run.dfs2", MIKE, r"a \.dfs2 of MIKE, which is not read; write it as NetCDF by mikeio"),
    ("run.dfsu", MIKE, r"a \.dfsu of MIKE, which is not read; bring it onto a grid"),
    ("run.dat", (3000).to_bytes(4, "little") + bytes(60), "a dataset of SMS, as TUFLOW writes, which is not read"),
    ("run.2dm", b"MESH2D\nE3T 1 1 2 3 1\n", "as TUFLOW writes, which is not read"),
]


@pytest.mark.parametrize(("name", "content", "said"), STARTS)
@pytest.mark.parametrize("reader", [extent_of, lambda content, name: read_drawing(content, name=name)])
def test_formats_are_known_by_their_first_bytes(reader, name, content, said):
    with pytest.raises(SourceError, match=said):
        reader(content, name)


def test_results_of_hec_ras_are_known(tmp_path):
    with h5py.File(tmp_path / "run.p01.hdf", "w") as file:
        file.attrs["File Type"] = np.bytes_("HEC-RAS Results")
        file.create_group("Results/Unsteady").create_dataset("Depth", data=np.ones((2, 3)))
    with pytest.raises(SourceError, match=r"HDF of HEC-RAS \(HEC-RAS Results\), which is not read; .*RAS Mapper"):
        extent_of(tmp_path / "run.p01.hdf", "run.p01.hdf")  # the suffix says nothing


def test_results_of_tuflow_are_known(tmp_path):
    with h5py.File(tmp_path / "run.xmdf", "w") as file:
        file.create_dataset("File Type", data=np.array([b"Xmdf"]))
    with pytest.raises(SourceError, match="XMDF, as TUFLOW writes, which is not read; add it to QGIS"):
        extent_of(tmp_path / "run.xmdf", "run.xmdf")


def test_results_of_anuga_and_3di_are_known(tmp_path):
    points = {name: ("points", np.zeros(3)) for name in ("x", "y", "elevation")}
    tables = {"volumes": (("volumes_", "corners"), [[0, 1, 2]]), "stage": (("steps", "points"), np.ones((1, 3)))}
    xarray.Dataset({**points, **tables}).to_netcdf(tmp_path / "run.sww", format="NETCDF3_64BIT")
    with pytest.raises(SourceError, match=r"an \.sww of ANUGA, which is not read; add it to QGIS"):
        extent_of(tmp_path / "run.sww", "run.sww")
    levels = {"Mesh2D_s1": (("time", "nodes"), np.ones((1, 2)))}
    xarray.Dataset(levels, attrs={"threedicore_version": "3.2"}).to_netcdf(tmp_path / "results_3di.nc")
    with pytest.raises(SourceError, match=r"a result of 3Di, which is not read; .*threedidepth"):
        extent_of(tmp_path / "results_3di.nc", "results_3di.nc")


def test_unknown_data_are_told_all_that_is_read():
    with pytest.raises(SourceError, match=r"none of GeoJSON, .*, GeoTIFF, NetCDF, GRIB and Esri's \.asc and \.flt"):
        extent_of(b"\x81\x82\x83", "run.bin")


def test_a_zip_of_a_raster_of_depths_is_to_be_unzipped(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("run/depth.tif", b"II*")
    with pytest.raises(SourceError, match=r"run/depth\.tif is not read in a zip; unzip it, and give the file itself"):
        extent_of(tmp_path / "a.zip", "a.zip")


def test_depths_of_hdf5_without_places_say_what_to_write(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["depth"] = np.ones((3, 4))
    with pytest.raises(SourceError, match="it has 'depth'; write x and y, the coordinates of columns and rows"):
        read_depths(tmp_path / "a.h5", "a.h5")
