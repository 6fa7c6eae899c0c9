"""Hazard of floods: the speeds that files hold beside their depths, and the ratings on the page."""

import base64
from io import BytesIO

import numpy as np
import pytest
from floods import depths, flood, scene_of, series, write_speeds
from PIL import Image

from vexture_geo.depth.depths import read_depths
from vexture_geo.flood.hazard import HAZARDS, UNIT, hazard_png, rating

EDGES = (0.4, 0.8)
DIMS = ("time", "y", "x")


@pytest.mark.usefixtures("page_is_built")
def test_the_page_has_the_rating_of_each_step(tmp_path):
    path = write_speeds(tmp_path / "run.nc", EDGES, speed=(DIMS, 1.5, {"units": "m s-1"}))
    assert flood("--extent", path, "--time-dim", "time", "-o", tmp_path / "page.html").returncode == 0
    told = scene_of(tmp_path / "page.html")["flood"]
    assert [(one["from"], one["color"]) for one in told["hazards"]] == [(one.least, one.color) for one in HAZARDS]
    size = told["relief"]["columns"], told["relief"]["rows"]
    for step, edge in zip(told["steps"], EDGES, strict=True):
        assert step["facts"]["hazard"] == {"unit": UNIT}
        with Image.open(BytesIO(base64.b64decode(step["views"]["hazard"].partition(",")[2]))) as picture:
            assert picture.size == size
            numbers = np.asarray(picture).astype(float)
        row = numbers[size[1] // 2]
        wanted = rating(depths(edge)[0], np.array(1.5))  # 40 cells to a row
        for cell in (2, 8, 14):
            near = row[round(size[0] * (cell + 0.5) / 40)]
            assert (near - 1.0) * UNIT == pytest.approx(min(wanted[cell], 2.54), abs=0.06)
        assert row[-10] == 0.0  # dry


@pytest.mark.usefixtures("page_is_built")
def test_without_speeds_there_is_no_rating(tmp_path):
    path = series(tmp_path / "run.nc", EDGES)
    assert flood("--extent", path, "--time-dim", "time", "-o", tmp_path / "page.html").returncode == 0
    for step in scene_of(tmp_path / "page.html")["flood"]["steps"]:
        assert "hazard" not in step["views"]
        assert step["facts"]["hazard"] is None


def test_a_step_that_is_dry_or_has_no_known_speed_has_no_picture(tmp_path):
    (step, _) = read_depths(write_speeds(tmp_path / "run.nc", EDGES, speed=(DIMS, np.nan, {})), "run.nc").steps
    assert hazard_png(step, (40, 20), 0.01) is None
    (step, _) = read_depths(write_speeds(tmp_path / "run.nc", EDGES, speed=(DIMS, 1.0, {})), "run.nc").steps
    assert hazard_png(step, (40, 20), 50.0) is None
