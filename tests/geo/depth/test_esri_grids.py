"""Depths in Esri's grids of text and of floats."""

import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture_geo.depth.depths import read_depths
from vexture_geo.readers import extent_of

HEADER = "ncols 4\nnrows 3\nxllcorner 100000\nyllcorner 400000\ncellsize 50\nNODATA_value -9999\n"
DEPTHS = np.array([[1.0, 1.0, 1.5, -9999.0]] * 3, "<f4")


def grid(folder, name):
    if name.endswith(".flt"):
        DEPTHS.tofile(folder / name)
        (folder / name).with_suffix(".hdr").write_text(f"{HEADER}byteorder LSBFIRST\n")
    else:
        (folder / name).write_text(HEADER + "\n".join(" ".join(map(str, row)) for row in DEPTHS) + "\n")
    return folder / name


@pytest.mark.parametrize("name", ["a.asc", "a.txt", "a.flt"])
def test_depths_are_read_from_grids_of_esri(tmp_path, name):
    extent = extent_of(grid(tmp_path, name), name, crs="EPSG:28992")
    assert extent.frame.bounds == (100_000.0, 400_000.0, 100_200.0, 400_150.0)
    depth = extent.steps[0].depth
    assert depth[96, [32, 160, 224]] == pytest.approx([1.0, 1.5, np.nan], nan_ok=True)


def test_a_prj_beside_a_grid_is_its_reference_system(tmp_path):
    from pyproj import CRS

    path = grid(tmp_path, "a.asc")
    path.with_suffix(".prj").write_text(CRS("EPSG:28992").to_wkt("WKT1_ESRI"))
    assert "Rijksdriehoek" in extent_of(path, "a.asc").frame.crs or extent_of(path, "a.asc").frame.crs == "EPSG:28992"


def test_a_grid_of_floats_needs_its_header(tmp_path):
    path = grid(tmp_path, "a.flt")
    path.with_suffix(".hdr").unlink()
    with pytest.raises(SourceError, match=r"a \.hdr of its name, must be beside it"):
        read_depths(path, "a.flt", crs="EPSG:28992")
    with pytest.raises(SourceError, match="none of GeoTIFF, NetCDF, GRIB and grids of Esri"):
        read_depths(path.read_bytes(), "a.flt", crs="EPSG:28992")


def test_a_grid_that_leads_elsewhere_is_refused(tmp_path):
    path = grid(tmp_path, "a.asc")
    text = '<PAMDataset><Metadata><MDI key="OVERVIEW_FILE">b.tif</MDI></Metadata></PAMDataset>'
    path.with_name("a.asc.aux.xml").write_text(text)
    with pytest.raises(SourceError, match=r"a\.asc\.aux\.xml beside it is not to be trusted"):
        read_depths(path, "a.asc", crs="EPSG:28992")


@pytest.mark.parametrize(("rows", "nbits"), [(2, ""), (1, ""), (6, ""), (2, "nbits 32\n")])
def test_a_grid_of_floats_of_another_size_than_its_header_says_is_refused(tmp_path, rows, nbits):
    path = grid(tmp_path, "a.flt")
    np.resize(DEPTHS, (rows, 4)).astype("<f4").tofile(path)
    path.with_suffix(".hdr").write_text(f"{HEADER}{nbits}byteorder LSBFIRST\n")
    said = rf"it has {16 * rows} bytes, and its header says 3 rows of 4 numbers, which are 48 bytes of 32 bits"
    with pytest.raises(SourceError, match=said):
        read_depths(path, "a.flt", crs="EPSG:28992")


@pytest.mark.parametrize("rows", [2, 4])
def test_a_grid_of_text_with_more_or_fewer_rows_than_its_header_says_is_refused(tmp_path, rows):
    path = grid(tmp_path, "a.asc")
    path.write_text(HEADER + "1 1 1.5 -9999\n" * rows)
    with pytest.raises(SourceError, match=rf"holds {4 * rows} numbers, and its header says 3 rows of 4 numbers \(12\)"):
        read_depths(path, "a.asc", crs="EPSG:28992")


def test_numbers_of_a_long_grid_of_text_are_counted_across_blocks(tmp_path):
    path = tmp_path / "a.asc"
    header = HEADER.replace("nrows 3", "nrows 300000")
    path.write_text(header + "1.25 1 1.5 -9999\n" * 300_000)
    assert read_depths(path, "a.asc", crs="EPSG:28992").frame.metres == (200.0, 15e6)


def test_a_byte_order_mark_is_named(tmp_path):
    path = grid(tmp_path, "a.asc")
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    with pytest.raises(SourceError, match="behind a byte order mark; save it as UTF-8 without one"):
        extent_of(path, "a.asc", crs="EPSG:28992")
