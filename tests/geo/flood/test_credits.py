"""What a file says of itself, on its page."""

import netCDF4
import pytest
from floods import flood, geotiff, scene_of, sea, series

from vexture_geo.flood.credits import Credits, credits_of

SAID = {
    "title": "Surge of 1953", "source": "SFINCS 2.1", "institution": "TU Delft",
    "references": "doi:10/x", "license": "CC BY 4.0", "comment": "A  run\nof the model",
}  # fmt: skip


@pytest.fixture
def run(tmp_path):
    path = series(tmp_path / "run.nc", [0.25, 0.5])
    with netCDF4.Dataset(path, "a") as file:
        file.setncatts({**SAID, "history": "long", "version": 3})
    return path


def test_attributes_are_on_the_page(run, tmp_path):
    page = tmp_path / "page.html"
    outcome = flood("--extent", run, "--time-dim", "time", "--variable", "depth", "-o", page)
    assert outcome.returncode == 0, outcome.stderr
    told = scene_of(page)["flood"]
    wanted = {**SAID, "licence": SAID["license"], "comment": "A run of the model", "synthetic": False}
    del wanted["license"]
    assert told["credits"] == wanted
    assert told["title"] == "Surge of 1953"
    assert "<title>Surge of 1953</title>" in page.read_text(encoding="utf-8")


def test_options_go_before_what_the_file_says(run, tmp_path):
    page = tmp_path / "page.html"
    given = ("--title", "Mine", "--source", "A synthetic run", "--licence", "CC0", "--depths", "0.3,1.5")
    outcome = flood("--extent", run, "--time-dim", "time", "--variable", "depth", *given, "-o", page)
    assert outcome.returncode == 0, outcome.stderr
    told = scene_of(page)["flood"]
    assert (told["title"], told["credits"]["source"], told["credits"]["licence"]) == ("Mine", "A synthetic run", "CC0")
    assert told["credits"]["synthetic"]
    assert [one["from"] for one in told["depths"]] == [0.0, 0.3, 1.5]


@pytest.mark.parametrize("depths", ["1,0.5", "deep", "-1,2", "0,1,2,3,4,5,6,7,8", "nan"])
def test_classes_that_cannot_be_are_refused(depths, tmp_path):
    outcome = flood("--extent", sea(tmp_path / "s.json"), "--depths", depths, "-o", tmp_path / "page.html")
    assert outcome.returncode == 1
    assert "--depths" in outcome.stderr
    assert not (tmp_path / "page.html").exists()


def test_tags_of_a_geotiff_are_read(tmp_path):
    import rasterio

    path = geotiff(tmp_path / "depth.tif", [[1.0, 0.0]])
    with rasterio.open(path, "r+") as file:
        file.update_tags(TIFFTAG_IMAGEDESCRIPTION="An invented flood", TIFFTAG_COPYRIGHT="© me")
    assert credits_of(path) == Credits(comment="An invented flood", licence="© me")
    assert credits_of(path).is_synthetic


def test_other_files_say_nothing(tmp_path):
    assert credits_of(sea(tmp_path / "s.json")) == Credits()


def test_what_is_too_long_is_cut(tmp_path):
    with netCDF4.Dataset(tmp_path / "long.nc", "w") as file:
        file.comment = "word " * 5000
    assert len(credits_of(tmp_path / "long.nc").comment) == 600
