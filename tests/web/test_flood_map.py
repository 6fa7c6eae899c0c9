"""The page of a flood as a map: colours of depths, charts, links, pictures."""

from collections.abc import Callable
from pathlib import Path

import flood_page
import numpy as np
import pytest
from flood_seen import DEEP, WIDE, on_screen, view
from PIL import Image
from playwright.sync_api import Page, expect
from waiting import drawn

from vexture_geo.flood.hazard import HAZARDS


def test_depths_as_colours_with_a_legend(opened_flood: Callable[..., Page], screenshot: Callable[..., Path]) -> None:
    page = opened_flood("series", WIDE)
    view(page, "Plan")
    page.get_by_label("Colours").select_option("depth")
    legend = page.get_by_label("Legend", exact=True)
    expect(legend.get_by_role("listitem")).to_have_text(["0 to 2 m", "2 to 20 m", "over 20 m"])
    drawn(page)
    x, y = on_screen(page, *DEEP)
    pixel = np.asarray(Image.open(screenshot(page)).convert("RGB"))[int(y), int(x)].astype(int)
    named = legend.locator(".swatch").nth(2).evaluate("(one) => getComputedStyle(one).backgroundColor")
    wanted = [int(part) for part in named.removeprefix("rgb(").removesuffix(")").split(",")]
    assert np.abs(pixel - wanted).max() < 40  # it is not quite opaque
    page.get_by_label("Colours").select_option("water")
    expect(legend).to_be_hidden()


@pytest.mark.slow
def test_contours_of_depth_are_as_sharp_as_the_shore(
    opened_flood: Callable[..., Page], screenshot: Callable[..., Path]
) -> None:
    """Each pixel of a plan of classes has the colour of its depth, by the formula, but those on a contour."""
    page = opened_flood("series", (740, 560), "?bare")
    page.evaluate("vexture.flood.relief(0)")
    page.evaluate("vexture.flood.step(2)")
    view(page, "Plan")
    page.evaluate("vexture.flood.colours('depth')")
    page.wait_for_function("vexture.flood.stage.sea.classes !== null")
    drawn(page)
    seen = np.asarray(Image.open(screenshot(page)).convert("RGB")).astype(int)
    corners = [on_screen(page, *corner) for corner in (flood_page.FRAME.box[:2], flood_page.FRAME.box[2:])]
    (x0, y1), (x1, y0) = corners
    rows, columns = np.mgrid[round(y0) + 2 : round(y1) - 2, round(x0) + 2 : round(x1) - 2]
    u0, v0, u1, v1 = flood_page.FRAME.box
    across, down = (columns + 0.5 - x0) / (x1 - x0), (rows + 0.5 - y0) / (y1 - y0)
    depth = flood_page.LEVELS[2] - flood_page.height(u0 + (u1 - u0) * across, v1 + (v0 - v1) * down)
    classes = np.digitize(depth, list(flood_page.CLASSES))  # 0: dry
    clear = np.ones(depth.shape, bool)  # of pixels with others around them
    for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):
        clear &= np.roll(classes, step, axis) == classes
    for at, color in enumerate(flood_page.CLASSES.values(), start=1):
        wanted = np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)])
        off = np.abs(seen[rows, columns] - wanted).max(axis=-1)[clear & (classes == at)]
        assert (off < 40).mean() > 0.999, f"{color}: {(off >= 40).sum()} of {off.size}"  # it is not quite opaque
    page.evaluate("vexture.flood.colours('water')")
    page.wait_for_function("vexture.flood.stage.sea.classes === null && vexture.flood.water.visible")


@pytest.mark.slow
def test_times_of_arrival(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series", WIDE)
    page.get_by_label("Colours").select_option("arrival")
    expect(page.get_by_label("Legend", exact=True)).to_contain_text("First under water after")
    page.wait_for_function("vexture.flood.player.index === 2")  # where the water is widest
    values = page.evaluate("vexture.flood.water.depthColors.classes.map(({ from }) => from)")
    assert values == [0.0, 1.0]  # of two hours in three colours


@pytest.mark.slow
def test_hazard_is_the_greatest_of_all_steps(
    opened_flood: Callable[..., Page], screenshot: Callable[..., Path]
) -> None:
    """Seen at the first step, each pixel is coloured by the last, highest one, but those near a border of classes."""
    page = opened_flood("series", (740, 560), "?bare")
    page.evaluate("vexture.flood.relief(0)")
    view(page, "Plan")
    page.evaluate("vexture.flood.colours('hazard')")
    page.wait_for_function("vexture.flood.water.depthColors !== null")
    drawn(page)
    seen = np.asarray(Image.open(screenshot(page)).convert("RGB")).astype(int)
    corners = [on_screen(page, *corner) for corner in (flood_page.FRAME.box[:2], flood_page.FRAME.box[2:])]
    (x0, y1), (x1, y0) = corners
    rows, columns = np.mgrid[round(y0) + 2 : round(y1) - 2, round(x0) + 2 : round(x1) - 2]
    u0, v0, u1, v1 = flood_page.FRAME.box
    across, down = (columns + 0.5 - x0) / (x1 - x0), (rows + 0.5 - y0) / (y1 - y0)
    wet = flood_page.LEVELS[0] - flood_page.height(u0 + (u1 - u0) * across, v1 + (v0 - v1) * down) > 0.1
    rated = flood_page.RATING * across
    for one, above in zip(HAZARDS, [*HAZARDS[1:], HAZARDS[-1]._replace(least=np.inf)], strict=True):
        clear = wet & (rated > one.least + 0.02) & (rated < above.least - 0.02)
        wanted = np.array([int(one.color[k : k + 2], 16) for k in (1, 3, 5)])
        off = np.abs(seen[rows, columns] - wanted).max(axis=-1)[clear]
        assert off.size > 5_000
        assert (off < 40).mean() > 0.999, f"{one.text}: {(off >= 40).sum()} of {off.size}"  # it is not quite opaque


@pytest.mark.slow
def test_a_chart_of_the_area_and_of_a_clicked_place(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series", (900, 640))
    expect(page.locator(".chart .of")).to_contain_text("Area under water")
    page.evaluate("vexture.flood.relief(0)")
    view(page, "Plan")
    page.mouse.click(*on_screen(page, *DEEP))
    expect(page.locator(".chart .of")).to_have_text(
        f"Water level at the marked place: 0.00 m to {flood_page.LEVELS[-1]:.2f} m"
    )
    pin = page.get_by_role("img", name="The marked place", exact=True)
    expect(pin).to_be_visible()
    at = pin.evaluate("(pin) => [pin.getBoundingClientRect()].map((box) => [box.x + box.width / 2, box.bottom])[0]")
    assert at == pytest.approx(on_screen(page, *DEEP), abs=2)
    page.get_by_role("button", name="Chart of the area").click()
    expect(pin).to_be_hidden()
    expect(page.locator(".chart .of")).to_contain_text("Area under water")


@pytest.mark.slow
def test_a_link_opens_the_same_view(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series", WIDE)
    page.evaluate("vexture.flood.step(2)")
    view(page, "Coast")
    page.get_by_label("Colours").select_option("smooth")
    page.get_by_role("button", name="Link").click()
    page.wait_for_function("location.hash !== ''")
    hash_ = page.evaluate("location.hash")
    again = opened_flood("series", WIDE, hash_)
    again.wait_for_function("vexture.flood.player.index === 2")
    expect(again.get_by_role("button", name="Coast")).to_have_attribute("aria-pressed", "true")
    expect(again.get_by_label("Colours")).to_have_value("smooth")


@pytest.mark.slow
def test_a_picture_has_its_size_and_what_is_written_on_it(opened_flood: Callable[..., Page], tmp_path: Path) -> None:
    page = opened_flood("series", WIDE)
    page.get_by_label("Size of pictures").select_option("1920 × 1080")
    found = {}
    for name in ("decorated", "plain"):
        page.get_by_label("with title, legend and source").set_checked(name == "decorated")
        with page.expect_download() as download:
            page.get_by_role("button", name="Picture").click()
        assert download.value.suggested_filename == "A-bay-of-formulas.png"
        download.value.save_as(tmp_path / f"{name}.png")
        found[name] = np.asarray(Image.open(tmp_path / f"{name}.png").convert("RGB")).astype(int)
    assert found["plain"].shape == (1080, 1920, 3)
    off = np.abs(found["decorated"] - found["plain"]).max(axis=2) > 30
    assert off[:100, :400].any()
    assert off[-120:, -300:].any()
    assert not off[300:800, 500:1500].any()
    assert page.evaluate("[vexture.flood.stage.size.width, vexture.flood.stage.size.height]") == list(WIDE)


@pytest.mark.slow
def test_no_surf_on_flooded_land(opened_flood: Callable[..., Page], screenshot: Callable[..., Path]) -> None:
    """At the height of the flood, next to no place that it has flooded is white with foam or a dark speck."""
    page = opened_flood("series", (740, 560), "?bare")
    page.evaluate("vexture.flood.step(2)")
    page.evaluate("vexture.flood.relief(0)")
    view(page, "Plan")
    drawn(page)
    picture = np.asarray(Image.open(screenshot(page)).convert("RGB")).astype(int)
    u0, v0, u1, v1 = flood_page.FRAME.box
    u, v = np.random.default_rng(2).uniform((u0, v0), (u1, v1), (40_000, 2)).T
    height = flood_page.height(u, v)
    (x0, y0), (x1, y1) = on_screen(page, u0, v0), on_screen(page, u1, v1)  # a plan is a straight map
    seen = picture[
        (y0 + (v - v0) / (v1 - v0) * (y1 - y0)).astype(int), (x0 + (u - u0) / (u1 - u0) * (x1 - x0)).astype(int)
    ]
    flooded = seen[(height > 0.5) & (height < flood_page.LEVELS[2] - 0.5)]
    assert len(flooded) > 500
    assert (flooded.min(axis=1) > 190).mean() < 0.005
    assert (flooded.max(axis=1) < 40).mean() < 0.005
