"""The viewer's page: its pixels against exact coverage, and how it moves."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from viewed import PRECISION, SHAPES, SIZE, Viewed, pixels, point_on_outline, ready, show, value
from viewer_page import FIT, view_matrix, write_page
from waiting import drawn, quiet

import vexture
from vexture.pages.page import data_address, exported_page
from vexture.server.publish_file import VIEWER_PARAMETERS, shape_of
from vexture.server.published import manifest as told


@pytest.mark.parametrize("zoom", [1, 100, 1000, 10000])
@pytest.mark.parametrize("name", ["duck", "flag", "map"])
def test_pixels_are_those_of_exact_coverage(
    viewer_pages: dict[str, Viewed],
    open_page: Callable[..., Any],
    screenshot: Callable[..., Path],
    name: str,
    zoom: int,
) -> None:
    viewed = viewer_pages[name]
    page = ready(open_page, viewed.url + "?bare")
    center = (0.5, 0.5) if zoom == 1 else point_on_outline(viewed.drawing)
    show(page, center=center, zoom=zoom)
    expected = viewed.expected_picture(view_matrix(center, zoom, SIZE))
    assert np.ptp(expected) > 20, "nothing is to be seen there"
    error = pixels(page) - expected
    mean, largest = np.abs(error).mean(), np.abs(error).max()
    contrast = np.ptp(expected, axis=(0, 1)).max()
    aside = error.mean(axis=2) / (np.ptp(expected.mean(axis=2)))
    beside = [aside.sum(axis=axis) for axis in (0, 1)]  # how far an outline across the view is moved, by column and row
    moved = min(np.abs(one).max() for one in beside)
    step = min(np.abs(np.diff(one)).max() for one in beside)
    print(f"\n{name} {zoom}x: MAE {mean:.4f}/255, largest {largest:.2f}, moved {moved:.4f} px, step {step:.4f} px")
    screenshot(page)
    assert mean <= 0.6
    if zoom >= 1000:
        assert step <= 0.1
        if contrast == 255.0:  # of other colours the rounding to 8 bits, summed up, is more than that
            assert moved <= PRECISION * zoom * FIT * SIZE[0] + 0.1
    else:
        assert largest <= 4 * contrast / 255


def test_pixels_of_a_fine_screen(viewer_pages: dict[str, Viewed], chromium: Any) -> None:
    context = chromium.new_context(viewport={"width": 256, "height": 256}, device_scale_factor=2, color_scheme="light")
    page = context.new_page()
    page.goto(viewer_pages["duck"].url + "?bare")
    page.evaluate("vexture.viewer.ready")
    error = pixels(page) - viewer_pages["duck"].expected_picture(view_matrix((0.5, 0.5), 1, SIZE))
    context.close()
    assert np.abs(error).mean() <= 0.6
    assert np.abs(error).max() <= 4


def test_keys_move_and_zoom(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (1000, 700))
    stage = page.get_by_role("application")
    stage.focus()
    before = value(page)
    page.keyboard.press("ArrowLeft")
    assert value(page)["center"][0] < before["center"][0]
    page.keyboard.press("ArrowUp")
    assert value(page)["center"][1] > before["center"][1]
    page.keyboard.press("+")
    assert value(page)["zoom"] > 1
    page.keyboard.press("-")
    page.keyboard.press("-")
    assert value(page)["zoom"] < 1
    page.keyboard.press("0")
    assert value(page) == before


def test_wheel_zooms_towards_the_pointer(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url + "?bare")
    page.mouse.move(400, 100)
    before = page.evaluate("vexture.viewer.engine.toUnit(400, 100)")
    for _ in range(16):
        page.mouse.wheel(0, -220)
    page.wait_for_function("vexture.viewer.state.value.zoom > 1000")
    after = page.evaluate("vexture.viewer.engine.toUnit(400, 100)")
    assert after == pytest.approx(before, abs=1e-9)
    for _ in range(30):
        page.mouse.wheel(0, -220)
    page.wait_for_function("vexture.viewer.state.value.zoom === 50000")
    page.mouse.dblclick(256, 256)
    assert value(page)["zoom"] == 50000


def test_dragging_takes_the_picture_along(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url + "?bare")
    show(page, zoom=3)
    point = page.evaluate("vexture.viewer.engine.toUnit(200, 200)")
    page.mouse.move(200, 200)
    page.mouse.down()
    page.mouse.move(260, 170, steps=4)
    page.mouse.up()
    assert page.evaluate("vexture.viewer.engine.toUnit(260, 170)") == pytest.approx(point, abs=1e-12)
    page.mouse.move(10, 10)
    assert page.evaluate("vexture.viewer.engine.toUnit(260, 170)") == pytest.approx(point, abs=1e-12)


def test_two_fingers_zoom(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url + "?bare", has_touch=True)
    touch = page.context.new_cdp_session(page)

    def fingers(kind: str, *places: tuple[int, int]) -> None:
        points = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(places)]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    held = page.evaluate("vexture.viewer.engine.toUnit(256, 256)")
    fingers("touchStart", (236, 256), (276, 256))
    for spread in (40, 60, 80):
        fingers("touchMove", (256 - spread, 256), (256 + spread, 256))
    fingers("touchEnd")
    assert value(page)["zoom"] == pytest.approx(4, rel=0.02)
    assert page.evaluate("vexture.viewer.engine.toUnit(256, 256)") == pytest.approx(held, abs=0.01)


def test_buttons_zoom_and_reset(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (1000, 700))
    page.get_by_role("button", name="Zoom in").click()
    assert value(page)["zoom"] == 1.5
    page.get_by_role("button", name="Zoom out").click(click_count=1)
    page.get_by_role("button", name="Zoom out").click()
    assert value(page)["zoom"] == pytest.approx(1 / 1.5)
    page.get_by_role("button", name="Reset view").click()
    assert value(page)["zoom"] == 1


def test_nothing_is_drawn_while_nothing_happens(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (1000, 700))
    quiet(page, 10)
    frames = page.evaluate(
        """async () => {
          let frames = 0;
          vexture.viewer.engine.addEventListener('frame', () => { frames += 1; });
          for (let i = 0; i < 30; i++) await new Promise((next) => requestAnimationFrame(next));
          return frames;
        }"""
    )
    assert frames == 0


RIVALS = {"svg": "Browser SVG", "thesis16": "16-bit original method (2018)"}


@pytest.mark.parametrize("zoom", [1, 40])
@pytest.mark.parametrize("rival", RIVALS)
def test_rivals_stand_in_step_with_the_picture(
    viewer_pages: dict[str, Viewed],
    open_page: Callable[..., Any],
    screenshot: Callable[..., Path],
    rival: str,
    zoom: int,
) -> None:
    viewed = viewer_pages["duck"]
    page = ready(open_page, viewed.url, (900, 600))
    center = (0.5, 0.5) if zoom == 1 else point_on_outline(viewed.drawing)
    show(page, center=center, zoom=zoom)
    page.get_by_role("combobox", name="Compare with").select_option(RIVALS[rival])
    page.locator(".half").get_by_text(RIVALS[rival], exact=True).wait_for()
    if rival == "svg":
        page.locator(".browser-svg img").wait_for()
    drawn(page)
    width, height = page.evaluate("[vexture.viewer.engine.size.width, vexture.viewer.engine.size.height]")
    screenshot(page)
    seen = pixels(page)[60 : height - 60, width // 2 + 30 : width]
    matrix = view_matrix(center, zoom, (width, height))
    if rival == "thesis16":
        cover = vexture.coverage(viewer_pages["thesis"].texture, (width, height), matrix, renderer="cpu")
        own = 255.0 * np.array(viewed.drawing.paths[0].paint.color)  # that of the drawing beside it
        expected = 255.0 + cover[..., None] * (own - 255.0)
    else:
        expected = viewed.expected_picture(matrix, (width, height))
    expected = expected[60 : height - 60, width // 2 + 30 : width]
    assert np.ptp(expected) > 200
    print(f"\n{rival} {zoom}x: {np.abs(seen - expected).mean():.3f}")
    assert np.abs(seen - expected).mean() <= 0.6


WINDOWS = {
    "beyond": 'viewBox="0 0 100 50"',
    "elsewhere": 'viewBox="-20 10 100 60" width="30mm"',
    "slice": 'width="400" height="200" viewBox="0 0 100 100" preserveAspectRatio="xMaxYMin slice"',
    "meet": 'width="400" height="200" viewBox="0 0 100 100" preserveAspectRatio="xMinYMax"',
    "none": 'width="200" height="300" viewBox="0 0 100 100" preserveAspectRatio="none"',
    "pixels": 'width="60" height="50"',
    "nothing": "",
}
"""Documents whose window cuts what is in it, by every way in which it can stand."""


@pytest.mark.parametrize("window", WINDOWS)
def test_the_browsers_picture_stands_where_ours_does(
    tmp_path: Path, open_page: Callable[..., Any], screenshot: Callable[..., Path], window: str
) -> None:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" {WINDOWS[window]}><circle cx="40" cy="30" r="45"/></svg>'
    shape = shape_of(text.encode(), "window.svg", "window", VIEWER_PARAMETERS)
    (tmp_path / "page.html").write_bytes(exported_page([shape], "window"))
    page = ready(open_page, (tmp_path / "page.html").as_uri(), (900, 600))
    ours = pixels(page)[60:500, 30:560]
    page.get_by_role("combobox", name="Compare with").select_option("Browser SVG")
    page.get_by_role("slider", name="Divider").press("Home")
    page.locator(".browser-svg img").wait_for()
    drawn(page)
    screenshot(page)
    theirs = pixels(page)[60:500, 30:560]
    assert np.ptp(ours) > 200
    assert np.abs(ours - theirs).mean() <= 1.0


def test_raster_of_equal_bytes(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600))
    nbytes = page.evaluate("vexture.viewer.engine.texture.nbytes")
    side = int(np.sqrt(nbytes * 3 / 4))
    page.get_by_role("combobox", name="Compare with").select_option("Raster of equal bytes")
    page.locator(".half").get_by_text(f"Raster, {side} × {side}: {nbytes / 1000:.1f}\xa0kB", exact=True).wait_for()
    drawn(page)
    screenshot(page)
    width, height = page.evaluate("[vexture.viewer.engine.size.width, vexture.viewer.engine.size.height]")
    exact = viewer_pages["duck"].expected_picture(view_matrix((0.5, 0.5), 1, (width, height)), (width, height))
    error = np.abs(pixels(page)[60 : height - 60, :width] - exact[60 : height - 60])
    left, right = error[:, : width // 2 - 30].mean(), error[:, width // 2 + 30 :].mean()
    assert left <= 0.1
    assert 0.3 <= right <= 10  # blurred, but the same shape at the same place


def test_raster_has_as_many_bytes_as_convert_writes_and_stands_beside_that_texture(
    tmp_path: Path, open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    shape = shape_of((SHAPES / "duck.svg").read_bytes(), "duck.svg", "duck", VIEWER_PARAMETERS)
    written = vexture.convert(SHAPES / "duck.svg")
    path = write_page(tmp_path / "page.html", told(shape, None, {}, address=data_address))
    page = ready(open_page, path.as_uri(), (900, 600))
    own = page.evaluate("vexture.viewer.engine.texture.nbytes")
    assert own > 20 * written.nbytes  # made for deep zoom
    rows = page.get_by_role("region", name="Size").get_by_role("row")
    rows.nth(2).wait_for()
    assert rows.nth(1).inner_text().split("\t") == ["vexture convert", f"{len(written.to_ktx2())}\xa0B", "1,024\xa0B"]
    assert rows.nth(2).inner_text().split("\t")[1:] == ["79.4\xa0kB", f"{own / 1000:.1f}\xa0kB"]
    page.get_by_role("combobox", name="Compare with").select_option("Raster of equal bytes")
    side = int(np.sqrt(written.nbytes * 3 / 4))
    page.locator(".half.right").get_by_text(f"Raster, {side} × {side}: {written.nbytes:,}\xa0B", exact=True).wait_for()
    assert page.locator(".half.left").inner_text() == f"vexture convert: {written.nbytes:,}\xa0B"
    page.get_by_role("slider", name="Divider").press("End")
    place = (0.3, 0.2)  # on the outline, where the difference of the two textures is seen
    show(page, center=place, zoom=1)
    width, height = page.evaluate("[vexture.viewer.engine.size.width, vexture.viewer.engine.size.height]")
    alpha = written.coverage((width, height), view_matrix(place, 1, (width, height)))[..., None]
    expected = 255 * (1 - alpha) + alpha * np.array([0xE8, 0xB1, 0x00])  # in the drawing's colour
    screenshot(page)
    assert np.abs(pixels(page)[60:500, :500] - expected[60:500, :500]).max() <= 2
