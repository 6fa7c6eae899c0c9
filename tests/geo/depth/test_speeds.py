"""Speeds of the water beside its depths."""

import numpy as np
import pytest
from floods import write_speeds

from vexture_geo.depth.depths import read_depths

EDGES = (0.4, 0.8)
DIMS = ("time", "y", "x")


def speeds_of(path):
    return [step.speed for step in read_depths(path, path.name).steps]


@pytest.mark.parametrize(
    "variables",
    [
        {"ucmag": (DIMS, 1.5, {"units": "m s-1"})},
        {"u": (DIMS, 0.9, {"units": "m/s"}), "v": (DIMS, -1.2, {"units": "m/s"})},
        {"a": (DIMS, 90.0, {"units": "cm s-1", "standard_name": "eastward_sea_water_velocity"}),
         "b": (DIMS, 120.0, {"units": "cm/s", "standard_name": "northward_sea_water_velocity"})},
        {"speed": (("y", "time", "x"), -1.5, {})},
        {"speed": (DIMS, 5.4, {"units": "km h-1"})},
        {"speed": (DIMS, 1.5 * 3600 / 1852, {"units": "knots"})},
    ],
)  # fmt: skip
def test_speeds_are_read_as_such_or_from_their_parts(variables, tmp_path):
    for speed in speeds_of(write_speeds(tmp_path / "run.nc", EDGES, **variables)):
        np.testing.assert_allclose(speed, 1.5, rtol=1e-6)


@pytest.mark.parametrize(
    "variables",
    [
        {},
        {"u": (DIMS, 0.9, {})},  # without the other part
        {"speed": (("y", "x"), 0.9, {})},  # the greatest of all times
        {"speed": (("time", "layer", "y", "x"), 0.9, {})},
        {"u": (("time", "y", "edge"), 0.9, {}), "v": (("time", "edge", "x"), 0.9, {})},
    ],
)
def test_speeds_of_other_places_times_and_layers_are_left_out(variables, tmp_path):
    assert speeds_of(write_speeds(tmp_path / "run.nc", EDGES, **variables)) == [None, None]


def test_what_is_no_speed_is_unknown(tmp_path):
    parts = {"u": (DIMS, -999.0, {}), "v": (DIMS, 1.0, {})}
    assert not np.isfinite(speeds_of(write_speeds(tmp_path / "run.nc", EDGES, **parts))).any()
