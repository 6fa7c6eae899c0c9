"""Pages of files that say where water is, but not how deep: classes of depth, and masks."""

import numpy as np
import pytest
import xarray
from floods import depths, flood, geotiff, scene_of, series

from vexture_geo.flood.depth_classes import colors_of

pytestmark = pytest.mark.usefixtures("page_is_built")


def classes(path, meanings):
    """A series of classes 0, 1, 2 and so on, a meaning each, that end every half metre."""
    with xarray.open_dataset(series(path, [0.4, 0.8]), decode_cf=False) as dataset:
        data = dataset.load()
    flags = {"flag_values": np.arange(len(meanings), dtype="i1"), "flag_meanings": " ".join(meanings)}
    ranks = np.minimum(np.ceil(data["depth"] / 0.5), len(meanings) - 1).astype("i1")
    data["depth"] = ranks.assign_attrs(data["depth"].attrs | flags)
    data.to_netcdf(path)
    return path


@pytest.mark.parametrize("has_end", [False, True])
def test_a_page_of_classes_has_ranges_and_no_depths(tmp_path, has_end):
    last = "1_to_1.5" if has_end else "above_1"
    path, page = classes(tmp_path / "run.nc", ["dry", "0.1_to_0.5", "0.5_to_1", last]), tmp_path / "page.html"
    outcome = flood("--extent", path, "-o", page)
    assert outcome.returncode == 0, outcome.stderr
    told = scene_of(page)["flood"]
    shown = [{"from": low, "color": color} for low, color in zip((0.1, 0.5, 1.0), colors_of(3), strict=True)]
    assert told["depths"] == [*shown[:2], shown[2] | ({"to": 1.5} if has_end else {})]
    for step in told["steps"]:
        assert step["facts"]["ranges"] == [[0.1, 0.5], [0.5, 1.0], [1.0, 1.5 if has_end else None]]
        assert (step["facts"]["depth"], step["facts"]["deepest"]) == (None, None)
        assert {"ranks", "classes", "level"} == set(step["views"])
    to = "1 to 1.5" if has_end else "over 1"
    said = f"run.nc: it holds classes of depth, from 0.1 to 0.5 m to {to} m: depths are ranges."
    assert told["notes"][0] == said


def test_a_page_of_a_mask_has_no_depths_and_says_so(tmp_path):
    path, page = geotiff(tmp_path / "mask.tif", (depths() > 0.0).astype("u1")), tmp_path / "page.html"
    outcome = flood("--extent", path, "-o", page)
    assert outcome.returncode == 0, outcome.stderr
    told = scene_of(page)["flood"]
    (step,) = told["steps"]
    assert (step["facts"]["depth"], step["facts"]["ranges"], step["facts"]["deepest"]) == (None, None, None)
    assert set(step["views"]) == {"level"}
    assert step["facts"]["area"] == pytest.approx(0.5 * 4000.0 * 2000.0, rel=0.01)
    assert told["notes"][0] == "mask.tif: its numbers are only 0 and 1: 1 is read as water of no known depth."
    assert told["relief"]["invented"]
