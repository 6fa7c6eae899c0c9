"""The legend of a map in a browser: small on a phone until it is opened, and open elsewhere."""

from typing import Any

import numpy as np
import pytest

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
geopandas = pytest.importorskip("geopandas", reason="geopandas is not installed (pip install 'vexture[test]')")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")

NAMES = ["arable land", "broadleaved forest", "coniferous forest", "discontinuous urban fabric", "estuaries"]
PHONE, DESK = (390, 600), (900, 600)
DRAWN = """() => {
  const canvas = document.querySelector('.vexture-stage canvas');
  return canvas?.getContext('2d').getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data[3] > 0;
}"""


def saved(place: Any, names: str = "", **options: Any) -> Any:
    """The page of a map of ten kinds of fields, beside which are values at two times."""
    import vexture

    count = 100
    cells = [shapely.box(k % 10, k // 10, k % 10 + 1, k // 10 + 1) for k in range(count)]
    kinds = [names + NAMES[k % 5] + (" (drained)" if k % 10 > 4 else "") for k in range(count)]
    values = {"y1": np.arange(count), "y2": np.arange(count)[::-1], "nothing": np.full(count, np.nan)}
    frame = geopandas.GeoDataFrame({"kind": kinds, **values}, geometry=cells, crs="EPSG:28992")
    options = {"column": "kind", **options}
    shown = vexture.map(frame, crs="EPSG:28992", height=500, **options)
    shown.save(place / "map.html")
    shown.close()
    return (place / "map.html").as_uri()


def overlap(page: Any, one: str, other: str) -> bool:
    """Whether two things on a page cover each other."""
    boxes = [page.locator(each).bounding_box() for each in (one, other)]
    return all(
        boxes[0][at] < boxes[1][at] + boxes[1][size] and boxes[1][at] < boxes[0][at] + boxes[0][size]
        for at, size in (("x", "width"), ("y", "height"))
    )


def test_a_legend_is_a_title_on_a_phone_until_it_is_tapped(open_page: Any, tmp_path: Any, screenshot: Any) -> None:
    address = saved(tmp_path)
    page = open_page(address, PHONE)
    page.wait_for_function(DRAWN)
    legend = page.locator(".vexture-legend")
    box = legend.bounding_box()
    assert box["width"] * box["height"] < 0.03 * PHONE[0] * 500
    assert legend.inner_text() == "kind"
    screenshot(page, "phone")
    legend.locator("summary").click()
    assert len(legend.locator(".entry").all()) == 10
    assert legend.locator(".entry").first.is_visible()
    screenshot(page, "open")
    legend.locator("summary").focus()
    page.keyboard.press("Enter")
    assert not legend.locator(".entry").first.is_visible()
    wide = open_page(address, DESK)
    wide.wait_for_function(DRAWN)
    assert wide.locator(".vexture-legend .entry").last.is_visible()
    screenshot(wide, "desk")


def test_legend_and_time_lie_beside_each_other(open_page: Any, tmp_path: Any, screenshot: Any) -> None:
    address = saved(tmp_path, column="y*")
    for size in (PHONE, DESK):
        page = open_page(address, size)
        page.wait_for_function(DRAWN)
        assert not overlap(page, ".vexture-legend", ".vexture-time")
        screenshot(page, str(size[0]))


@pytest.mark.filterwarnings("ignore:.*no feature has a value")
def test_a_ramp_of_nothing_is_no_error(open_page: Any, tmp_path: Any) -> None:
    page = open_page(saved(tmp_path, column="nothing", scale="continuous"), DESK)
    page.wait_for_function(DRAWN)
    assert page.locator(".vexture-legend").inner_text().split() == ["nothing", "no", "data"]


LAB = """dl { width: 100%; overflow: hidden; } dl, dt, dd { margin: 0; }
dt { font-weight: bold; float: left; width: 20%; } dd { float: left; width: 80%; }
table { width: 100%; } p { margin: 0 0 1em; } span { white-space: pre; }"""
"""What JupyterLab does to elements in the outputs of cells."""


def test_a_tip_is_as_wide_as_its_words_whatever_a_notebook_does_to_lists(open_page: Any, tmp_path: Any) -> None:
    page = open_page(saved(tmp_path), DESK)
    page.wait_for_function(DRAWN)
    page.add_style_tag(content=LAB)
    page.mouse.move(DESK[0] / 2, DESK[1] / 2)
    tip = page.locator(".vexture-tip")
    tip.wait_for()
    box = tip.bounding_box()
    assert box["width"] < 0.3 * DESK[0]
    assert box["x"] > DESK[0] / 2, "it is beside the pointer"
    names = [each.bounding_box() for each in tip.locator(".name").all()]
    assert len({name["x"] for name in names}) == 1
    assert [name["y"] for name in names] == sorted({name["y"] for name in names})


def inside(page: Any, one: str) -> bool:
    """Whether a thing is wholly on the map."""
    box, stage = (page.locator(each).bounding_box() for each in (one, ".vexture-stage"))
    return all(
        stage[at] <= box[at] and box[at] + box[size] <= stage[at] + stage[size]
        for at, size in (("x", "width"), ("y", "height"))
    )


def test_a_legend_that_is_longer_or_wider_than_the_map_scrolls_within_it(open_page: Any, tmp_path: Any) -> None:
    page = open_page(saved(tmp_path), (900, 130))
    page.wait_for_function(DRAWN)
    last = page.locator(".vexture-legend .entry").last
    before = last.bounding_box()["y"]
    assert before > 130
    page.locator(".vexture-legend").hover()
    page.mouse.wheel(0, 600)
    page.wait_for_function("() => document.querySelector('.vexture-legend').scrollTop > 50")
    assert last.bounding_box()["y"] < 120
    assert inside(page, ".vexture-legend")
    narrow = open_page(saved(tmp_path, names="a very long name of a kind of fields that goes on"), (250, 300))
    narrow.wait_for_function(DRAWN)
    narrow.locator(".vexture-legend summary").click()
    assert inside(narrow, ".vexture-legend")
    entry = narrow.locator(".vexture-legend .entry").first
    assert entry.bounding_box()["height"] < 20
    assert entry.get_attribute("title").startswith("a very long name")


def test_a_small_map_has_no_more_beside_it_than_it_has_room_for(open_page: Any, tmp_path: Any, screenshot: Any) -> None:
    page = open_page(saved(tmp_path, column="y*"), DESK)
    page.wait_for_function(DRAWN)
    legend = page.locator(".vexture-legend")
    assert legend.locator(".entry").first.is_visible()
    stage = page.locator(".vexture-stage")
    stage.evaluate("stage => Object.assign(stage.style, { width: '240px', height: '200px' })")
    page.wait_for_function("() => !document.querySelector('.vexture-legend').open")
    assert inside(page, ".vexture-time")
    assert not overlap(page, ".vexture-legend", ".vexture-time")
    screenshot(page, "small")
    stage.evaluate("stage => { stage.style.height = '24px'; }")
    legend.wait_for(state="hidden")
    page.locator(".vexture-time").wait_for(state="hidden")


def test_a_saved_page_tells_of_the_feature_under_the_pointer(open_page: Any, tmp_path: Any) -> None:
    page = open_page(saved(tmp_path, column="y*"), DESK)
    page.wait_for_function(DRAWN)
    page.mouse.move(DESK[0] / 2 + 5, DESK[1] / 2 - 5)
    tip = page.locator(".vexture-tip")
    tip.wait_for()
    assert tip.inner_text().split("\n")[:4] == ["y1", "55", "id", "55"]
    page.locator(".vexture-time input").evaluate(
        "slider => { slider.value = 1; slider.dispatchEvent(new Event('input')); }"
    )
    page.wait_for_function("() => document.querySelector('.vexture-tip').innerText.startsWith('y2')")
    assert tip.inner_text().split("\n")[:2] == ["y2", "44"]
    page.locator(".vexture-legend").hover()
    tip.wait_for(state="hidden")
