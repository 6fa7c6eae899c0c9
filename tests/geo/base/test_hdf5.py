"""Links in HDF5: those out of a file are refused with their names, those within it are not."""

import h5py
import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture_geo.base.hdf5 import refuse_links_of_netcdf


@pytest.fixture
def path(tmp_path):
    with h5py.File(tmp_path / "a.nc", "w") as file:
        file["group/depth"] = np.arange(6.0)
    return tmp_path / "a.nc"


def test_links_within_a_file_are_followed(path):
    with h5py.File(path, "a") as file:
        file["again"] = h5py.SoftLink("/group/depth")
        file["same"] = file["group/depth"]
        file["group"].attrs["of"] = file["group/depth"].ref
        file["group/back"] = file["/"]  # a circle, which must end
        layout = h5py.VirtualLayout((6,), "f8")
        layout[:] = h5py.VirtualSource(".", "group/depth", shape=(6,))
        file.create_virtual_dataset("virtual", layout)
    refuse_links_of_netcdf(path)
    with h5py.File(path, "a") as file:
        file["group/back/again_out"] = h5py.ExternalLink("/secret/b.nc", "/depth")
    with pytest.raises(SourceError, match="'again_out' is in another file"):
        refuse_links_of_netcdf(path)


def test_an_external_link_is_named(path):
    with h5py.File(path, "a") as file:
        file["group/other"] = h5py.ExternalLink("/secret/b.nc", "/depth")
    with pytest.raises(SourceError, match=r"'group/other' is in another file, '/secret/b\.nc'"):
        refuse_links_of_netcdf(path)


def test_values_in_another_file_are_named(path):
    with h5py.File(path, "a") as file:
        file.create_dataset("raw", (4,), "f8", external=[("/secret/raw.bin", 0, 32)])
    with pytest.raises(SourceError, match=r"'raw' has its values in another file, '/secret/raw\.bin'"):
        refuse_links_of_netcdf(path)


def test_a_virtual_dataset_of_another_file_is_named(path):
    with h5py.File(path, "a") as file:
        layout = h5py.VirtualLayout((6,), "f8")
        layout[:] = h5py.VirtualSource("/secret/c.nc", "depth", shape=(6,))
        file.create_virtual_dataset("parts", layout)
    with pytest.raises(SourceError, match=r"'parts' has its values in another file, '/secret/c\.nc'"):
        refuse_links_of_netcdf(path)


def test_other_files_are_not_opened(tmp_path):
    (tmp_path / "classic.nc").write_bytes(b"CDF\x01 and no HDF5")
    refuse_links_of_netcdf(tmp_path / "classic.nc")
    (tmp_path / "cut.nc").write_bytes(b"\x89HDF\r\n\x1a\n")
    with pytest.raises(SourceError, match="cannot be read as NetCDF"):
        refuse_links_of_netcdf(tmp_path / "cut.nc")
