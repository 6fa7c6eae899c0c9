"""One page from a user's files, and one line where there is none."""

import base64
import re
from io import BytesIO

import numpy as np
import pytest
from floods import BOUNDS, CRS, depths, flood, geotiff, scene_of, sea, series
from PIL import Image

from vexture.texture.load import texture_from

pytestmark = pytest.mark.usefixtures("page_is_built")


def content(address):
    head, _, data = address.partition(";base64,")
    return head, base64.b64decode(data, validate=True)


def test_page_of_polygons_holds_everything(tmp_path):
    page = tmp_path / "page.html"
    outcome = flood("--extent", sea(tmp_path / "sea.geojson"), "--bounds", ",".join(map(str, BOUNDS)), "-o", page)
    assert outcome.returncode == 0, outcome.stderr
    told = scene_of(page)["flood"]
    (step,) = told["steps"]
    size = step["bytes"]
    assert outcome.stdout == f"{page}: 1 step, {size} bytes of textures, {page.stat().st_size} bytes\n"
    assert page.stat().st_size <= 1_500_000
    assert told["title"] == "sea"
    assert told["prefix"] == step["name"] == "flood"
    assert told["frame"]["bounds"] == list(BOUNDS)
    assert told["frame"]["metres"] == [4000.0, 2000.0]
    assert (told["frame"]["crs"], told["frame"]["geographic"]) == (CRS, False)
    facts = step["facts"]
    assert (facts["time"], facts["label"], facts["dry"], facts["deepest"]) == (None, "", False, None)
    head, texture = content(step["texture"])
    assert (head, len(texture)) == ("data:image/ktx2", size)
    (root,) = texture_from(texture, "page").roots
    np.testing.assert_allclose(root.to_source.ravel(), told["frame"]["to_source"])
    assert content(told["ground"])[0] == "data:image/webp"
    assert told["relief"]["invented"]
    assert told["notes"] == ["The relief is invented.", "The ground is drawn, not photographed."]
    assert told["fold"].startswith("data:image/ktx2")


def test_shore_is_where_land_and_water_meet(tmp_path):
    page = tmp_path / "page.html"
    assert (
        flood("--extent", sea(tmp_path / "s.json"), "--bounds", ",".join(map(str, BOUNDS)), "-o", page).returncode == 0
    )
    told = scene_of(page)["flood"]
    assert [view["name"] for view in told["views"]] == ["Coast", "Shore", "Beach"]
    np.testing.assert_allclose(told["views"][0]["place"][0], 0.5, atol=1e-5)
    np.testing.assert_allclose(told["views"][0]["toward"], [-1.0, 0.0], atol=1e-3)


def test_page_of_a_series(tmp_path):
    page = tmp_path / "page.html"
    source = series(tmp_path / "run.nc", [0.25, 0.5, 0.75])
    outcome = flood("--extent", source, "--time-dim", "time", "--variable", "depth", "-o", page, "--amplitude", 0)
    assert outcome.returncode == 0, outcome.stderr
    told = scene_of(page)["flood"]
    assert [step["name"] for step in told["steps"]] == ["flood/00", "flood/01", "flood/02"]
    facts = [step["facts"] for step in told["steps"]]
    assert [fact["time"] for fact in facts] == [f"2026-02-14T0{hour}:00:00+00:00" for hour in (6, 7, 8)]
    assert facts[1]["label"] == "14 Feb 2026 07:00 UTC"
    np.testing.assert_allclose([fact["deepest"] for fact in facts], [1.9, 1.95, 1.967], atol=0.02)
    picture = Image.open(BytesIO(content(told["steps"][1]["views"]["depth"])[1]))
    values = np.asarray(picture)
    assert picture.mode == "I;16"
    code = facts[1]["depth"]
    assert code["scale"] * np.sinh(code["step"] * values.max()) == pytest.approx(facts[1]["deepest"], abs=0.005)
    assert values[:, : values.shape[1] // 4].min() > values[:, -values.shape[1] // 4 :].max() == 0
    assert told["fold"] is None
    assert not told["relief"]["invented"]


def test_relief_is_above_the_still_water(tmp_path):
    page = tmp_path / "page.html"
    heights = np.tile(np.linspace(8.0, 16.0, 80, dtype=np.float32), (40, 1))
    relief = geotiff(tmp_path / "relief.tif", heights)
    place = ",".join(map(str, BOUNDS))
    outcome = flood("--extent", sea(tmp_path / "s.json"), "--bounds", place, "--relief", relief, "-o", page)
    assert outcome.returncode == 0, outcome.stderr
    told = scene_of(page)["flood"]["relief"]
    numbers = np.frombuffer(content(told["heights"])[1], "<i2").reshape(told["rows"], told["columns"])
    measured = told["unit"] * numbers
    assert measured.shape == (128, 257)
    np.testing.assert_allclose(measured[64, [0, 128, 256]], [-4.0, 0.0, 4.0], atol=0.1)
    assert not told["invented"]


def test_dry_flood_is_a_page_that_says_so(tmp_path):
    page = tmp_path / "page.html"
    outcome = flood("--extent", geotiff(tmp_path / "dry.tif", depths(deep=0.01)), "-o", page)
    assert outcome.returncode == 0, outcome.stderr
    assert "nothing under water" in outcome.stdout
    told = scene_of(page)["flood"]
    assert told["steps"][0]["facts"]["dry"]
    assert (told["views"], told["fold"]) == ([], None)
    assert "Nothing is under water." in told["notes"]


def test_titles_of_strangers_end_no_element(tmp_path):
    page = tmp_path / "page.html"
    hostile = "</script><script>alert(1)</script><!--"
    place = ",".join(map(str, BOUNDS))
    assert (
        flood("--extent", sea(tmp_path / "s.json"), "--bounds", place, "--title", hostile, "-o", page).returncode == 0
    )
    text = page.read_text(encoding="utf-8")
    assert text.lower().count("<script") == text.lower().count("</script") == 3
    assert re.search(r"<title>(.*?)</title>", text)[1] == "&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;&lt;!--"


def bad(folder):
    """Arguments that cannot work, and what the one line says."""
    good = sea(folder / "good.geojson")
    tiff = geotiff(folder / "unplaced.tif", depths(), crs=None, bounds=BOUNDS)
    empty = geotiff(folder / "nan.tif", np.full((20, 40), np.nan, np.float32))
    crash = series(folder / "late.nc", [0.2, 0.4], reverse=True)
    (folder / "text.png").write_text("no picture")
    (folder / "notes.txt").write_text("no flood")
    return {
        "nowhere": (["--extent", folder / "missing.nc"], "there is no such file"),
        "no data": (["--extent", folder / "notes.txt"], "notes.txt"),
        "no system": (["--extent", tiff], "--crs EPSG:"),
        "unknown system": (["--extent", tiff, "--crs", "EPSG:0"], "EPSG:0"),
        "all unknown": (["--extent", empty], "nan.tif"),
        "times": (["--extent", crash, "--time-dim", "time"], "time"),
        "no such dimension": (["--extent", crash, "--time-dim", "hour"], "hour"),
        "outside": (["--extent", good, "--bounds", "600000,4000000,604000,4002000"], "600000"),
        "degrees": (["--extent", good, "--bounds", "-122,36,-121,37"], "-122"),
        "order": (["--extent", good, "--bounds", "504000,4000000,500000,4002000"], "west,south,east,north"),
        "not four": (["--extent", good, "--bounds", "1,2,3"], "give four numbers"),
        "nan": (["--extent", good, "--bounds", "1,2,nan,4"], "finite"),
        "hmin": (["--extent", good, "--hmin", "-1"], "--hmin -1: it is a depth in metres, above 0"),
        "amplitude": (["--extent", good, "--amplitude", "5000"], "--amplitude 5000: the limit is"),
        "period": (["--extent", good, "--period", "0"], "--period 0: it must be 0.1 to 600 seconds"),
        "ground": (["--extent", good, "--ground", folder / "missing.png"], "--ground"),
        "no picture": (["--extent", good, "--ground", folder / "text.png"], "is no picture"),
        "relief": (["--extent", good, "--relief", folder / "missing.tif"], "there is no such file"),
        "no relief": (["--extent", good, "--relief", folder / "notes.txt"], "is no raster that can be read"),
    }


CASES = ("nowhere", "no data", "no system", "unknown system", "all unknown", "times", "no such dimension", "outside",
         "degrees", "order", "not four", "nan", "hmin", "amplitude", "period", "ground", "no picture", "relief",
         "no relief")  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_what_cannot_be_shown_is_one_line_and_no_page(case, tmp_path):
    arguments, said = bad(tmp_path)[case]
    page = tmp_path / "page.html"
    outcome = flood(*arguments, "-o", page)
    assert outcome.returncode == 1
    assert outcome.stdout == ""
    (line,) = outcome.stderr.splitlines()
    assert line.startswith("vexture: ")
    assert said in line
    assert not page.exists()


def test_page_must_be_html(tmp_path):
    outcome = flood("--extent", sea(tmp_path / "s.json"), "-o", tmp_path / "page.pdf")
    assert outcome.returncode == 1
    assert ".html" in outcome.stderr


def test_waves_that_would_turn_the_shore_over_are_smaller_and_said_so(tmp_path):
    page = tmp_path / "a.html"
    bounds = ",".join(map(str, BOUNDS))
    outcome = flood("--extent", sea(tmp_path / "sea.geojson"), "--bounds", bounds, "--amplitude", "150", "-o", page)
    assert outcome.returncode == 0
    told = re.search(r"Waves run up ([\d.]+) m: 150 m would turn the shore over\.", outcome.stderr)
    assert told is not None
    assert 20.0 < float(told[1]) < 140.0
