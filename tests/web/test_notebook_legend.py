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


def saved(place: Any, **options: Any) -> Any:
    """The page of a map of ten kinds of fields, beside which are values at two times."""
    import vexture

    count = 100
    cells = [shapely.box(k % 10, k // 10, k % 10 + 1, k // 10 + 1) for k in range(count)]
    kinds = [NAMES[k % 5] + (" (drained)" if k % 10 > 4 else "") for k in range(count)]
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
