"""Depths in GRIB of editions 1 and 2."""

import ctypes
import gzip
import struct
from contextlib import suppress
from datetime import UTC, datetime

import numpy as np
import pytest
import rasterio
from gribs import DEPTH, FIELD, GEOGRAPHIC, ICE, LEVEL, SOUNDING, TEMPERATURE, first_edition, second_edition

import vexture
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture_geo.depth.grib import MOST_POINTS
from vexture_geo.readers import extent_of

CELLS = [25, 75, 130, 190]
"""Columns of the frame's grid, one in each of the field."""


def depths(content, **options):
    return [step.depth[100, CELLS].tolist() for step in extent_of(content, "run.grib2", **options).steps]


def test_depths_and_times_are_read():
    content = second_edition((DEPTH, 3), (TEMPERATURE, 0), (DEPTH, 0))
    extent = extent_of(content, "run.grib2")
    assert [step.time for step in extent.steps] == [datetime(2026, 2, 14, hour, tzinfo=UTC) for hour in (6, 9)]
    assert extent.frame.crs == "EPSG:4326"
    assert extent.frame.bounds == pytest.approx((4.0, 52.0, 4.04, 52.03))
    assert depths(content) == [[0.0, 0.5, 1.0, 2.0], [0.0, 2.0, 4.0, 8.0]]
    assert extent.notes == ()


def test_a_file_is_read_whatever_its_name_and_what_is_beside_it(tmp_path):
    (tmp_path / "run").write_bytes(second_edition((DEPTH, 0)))
    (tmp_path / "run.idx").write_text("1:99999:d=2026021406:TMP:surface:anl:\n")
    (tmp_path / "run.aux.xml").write_text("<PAMDataset><SRS>EPSG:28992</SRS></PAMDataset>")
    assert vexture.read_extent(tmp_path / "run").frame.crs == "EPSG:4326"
    assert depths(gzip.compress((tmp_path / "run").read_bytes())) == [[0.0, 0.5, 1.0, 2.0]]


def test_a_level_and_a_bed_are_a_depth():
    content = second_edition((LEVEL, 0), (LEVEL, 1)) + second_edition((SOUNDING, 0), values=FIELD[:, ::-1])
    first, second = depths(content)
    assert first == pytest.approx([2.0, 1.5, 1.5, 2.0], abs=0.1)  # the bed of the page is smooth
    assert second == pytest.approx([2.0, 2.0, 2.5, 4.0], abs=0.1)
    with pytest.raises(SourceError, match="'DSLM' holds water levels, and no variable holds heights of the bed"):
        extent_of(second_edition((LEVEL, 0)), "run.grib2")


def test_what_has_no_value_is_unknown():
    place = GEOGRAPHIC | {"transform": GEOGRAPHIC["transform"] @ rasterio.Affine.scale(0.25)}
    values = np.kron(np.where(FIELD == 1.0, -9999.0, FIELD), np.ones((4, 4)))  # GDAL packs no few values around gaps
    assert depths(second_edition((DEPTH, 0), values=values, nodata=-9999.0, place=place))[0] == pytest.approx(
        [0.0, 0.5, np.nan, 2.0], nan_ok=True
    )


def test_the_first_edition_is_read():
    extent = extent_of(first_edition() + first_edition(8, values=[1, 0, 0, 0, 0, 0]), "run.grb", variable="DIST")
    assert extent.frame.bounds == pytest.approx((3.5, 50.5, 6.5, 52.5))
    assert extent.steps[0].time == datetime(2026, 2, 14, 6, tzinfo=UTC)
    assert extent.steps[0].depth[[40, 40, -1], [20, 200, 20]].tolist() == [1.0, 0.0, 0.0]


@pytest.mark.parametrize("parameter", [TEMPERATURE, ICE])
def test_what_is_no_depth_by_the_tables_is_refused(parameter):
    with pytest.raises(SourceError, match=r"it holds '.*, (temperature \[K\]|ice thinkness \[m\])', and no depth"):
        extent_of(second_edition((parameter, 0)), "run.grib2")


def test_a_variable_is_chosen_and_must_be_a_length():
    content = second_edition((DEPTH, 0), (ICE, 1), (TEMPERATURE, 0))
    assert depths(content, variable="ICETK") == [[0.0, 1.0, 2.0, 4.0]]
    with pytest.raises(ParameterError, match=r"'TMP' is in '\[K\]', no unit of length"):
        extent_of(content, "run.grib2", variable="TMP")
    with pytest.raises(ParameterError, match="there is no 'DEPTH'; `variable` may be 'WDEPTH', 'TMP', 'ICETK'"):
        extent_of(content, "run.grib2", variable="DEPTH")


def test_levels_of_a_parameter_are_chosen_by_name():
    content = second_edition((DEPTH, 0)) + second_edition((DEPTH, 0), surface=101, values=2.0 * FIELD)
    with pytest.raises(LimitError, match="depths may be in 'WDEPTH:0-SFC', 'WDEPTH:0-MSL'; choose one by `variable`"):
        extent_of(content, "run.grib2")
    assert depths(content, variable="WDEPTH:0-MSL") == [[0.0, 1.0, 2.0, 4.0]]


def test_fields_of_one_time_are_refused():
    with pytest.raises(SourceError, match="'WDEPTH' has several fields at one time, as those of an ensemble are"):
        extent_of(second_edition((DEPTH, 0), (DEPTH, 0)), "run.grib2")


def test_fields_on_several_grids_are_refused():
    content = second_edition((DEPTH, 0)) + second_edition((DEPTH, 1), values=FIELD[:, :3])
    with pytest.raises(SourceError, match="its fields are on several grids"):
        extent_of(content, "run.grib2")


@pytest.mark.parametrize("cut", [1, 60])
def test_a_file_that_breaks_off_is_refused(cut):
    for content in (second_edition((DEPTH, 0), (DEPTH, 1)), first_edition() + first_edition(8)):
        with pytest.raises(SourceError, match=r"its message at byte \d+ says \d+ bytes, and does not end there"):
            extent_of(content[:-cut], "run.grib2")


def test_a_grid_that_is_too_large_is_refused_before_it_is_decoded():
    content = bytearray(second_edition((DEPTH, 0)))
    at = content.index(struct.pack(">II", 4, 3))
    content[at : at + 8] = struct.pack(">II", 2**16, 2**15)
    with pytest.raises(
        LimitError, match=rf"its grid has {2**31:,} points; the limit is {MOST_POINTS:,}; cut out a part"
    ):
        extent_of(bytes(content), "run.grib2")
    content[at : at + 8] = struct.pack(">II", 0xFFFFFFFF, 3)
    with pytest.raises(SourceError, match="its rows have different numbers of points"):
        extent_of(bytes(content), "run.grib2")


def test_other_editions_are_refused():
    with pytest.raises(SourceError, match="it is of edition 3 of GRIB, and editions 1 and 2 are read"):
        extent_of(b"GRIB\0\0\0\3" + bytes(60), "run.grib2")
    with pytest.raises(SourceError, match="its sections do not fill it"):
        extent_of(b"GRIB\0\0\0\2" + (40).to_bytes(8) + bytes(20) + b"7777", "run.grib2")


def test_what_gdal_prints_of_a_field_is_not_printed(capfd):
    content = bytearray(first_edition(8))
    content[25] = 255  # no unit of time
    assert extent_of(bytes(content), "run.grb", variable="DIST").steps
    with suppress(AttributeError, TypeError, OSError):
        ctypes.CDLL(None).fflush(None)
    assert capfd.readouterr() == ("", "")
