"""`vexture flood` in a browser: the page in one file, and a server whose water changes under everyone's eyes."""

import io

import numpy as np
import pytest
from flood_seen import PATIENCE
from floods import BOUNDS, flood, flooding, sea
from PIL import Image
from playwright.sync_api import expect
from runs import following, writing

from viewing import until

PLACE = ["--bounds", ",".join(map(str, BOUNDS)), "--amplitude", "0"]


pytestmark = pytest.mark.usefixtures("page_is_built")


def settle(page):
    """A still picture from above, in two flat colours: the ground's and the water's."""
    page.evaluate("() => window.vexture.flood.ready")
    page.evaluate("() => { const { flood } = window.vexture; flood.freeze(0); flood.flat(true); "
                  "flood.view('Plan', { fly: false }); flood.render(); }")  # fmt: skip


def white(page):
    """Number of pixels of water, which is all that is white."""
    picture = Image.open(io.BytesIO(page.locator("canvas").screenshot())).convert("L")
    return int((np.asarray(picture) > 127).sum())


def test_page_in_one_file_opens_from_disk(open_page, screenshot, tmp_path):
    file = tmp_path / "page.html"
    outcome = flood("--extent", sea(tmp_path / "sea.geojson"), *PLACE, "-o", file)
    assert outcome.returncode == 0, outcome.stderr
    page = open_page(file.as_uri(), (480, 320))
    page.evaluate("() => window.vexture.flood.ready")
    assert page.title() == "sea"
    assert page.get_by_text("The relief is invented.").count() == 1
    screenshot(page)


@pytest.mark.slow
def test_what_is_pushed_is_seen(open_page, screenshot, tmp_path):
    with flooding(tmp_path, "--extent", sea(tmp_path / "sea.geojson", 0.3), *PLACE) as server:
        page = open_page(f"{server.url}?bare", (480, 320))
        settle(page)
        screenshot(page, "before")
        before = white(page)
        version = page.evaluate("vexture.flood.player.step.manifest.version")
        assert server.put("flood", sea(tmp_path / "more.geojson", 0.6).read_bytes())[0] == 200
        until(lambda: page.evaluate("vexture.flood.player.step.manifest.version") != version)
        page.evaluate("() => window.vexture.flood.render()")
        after = white(page)
        screenshot(page, "after")
        assert 1.8 * before < after < 2.3 * before


@pytest.mark.slow
def test_the_slider_grows_with_a_run(open_page, screenshot, tmp_path):
    path = tmp_path / "run_map.nc"
    with writing(path) as writer:
        writer.does("open 6", "step 0.3")
        with following(path, "--amplitude", "0") as server:
            server.shows()
            page = open_page(server.url, (740, 420))
            page.evaluate("() => window.vexture.flood.ready")
            page.evaluate("vexture.flood.freeze(0)")  # waves would take the time of what is waited for
            slider = page.get_by_role("slider", name="Time")

            def shown(text):
                expect(slider).to_have_attribute("aria-valuetext", text, timeout=PATIENCE)

            arrival = page.locator("option[value=arrival]")
            expect(arrival).to_be_disabled()
            writer.does("step 0.4", "step 0.5")
            shown("14 Feb 2026 08:00 UTC, step 3 of 3")
            assert slider.get_attribute("max") == "2"
            expect(arrival).to_be_enabled()
            chart = page.locator(".chart .of")
            expect(chart).to_contain_text("Area under water")
            screenshot(page, "grown")
            page.get_by_role("button", name="Previous step").click()
            shown("14 Feb 2026 07:00 UTC, step 2 of 3")
            writer.does("step 0.6")
            shown("14 Feb 2026 07:00 UTC, step 2 of 4")
            expect(chart).to_contain_text(" to 4.6", timeout=PATIENCE)
            writer.does("depth 0.9")
            expect(chart).to_contain_text(" to 7.0", timeout=PATIENCE)
            writer.does("close", "open 12", "step 0.3")  # the same water as before, at another time
            expect(page.locator(".when")).to_have_text("14 Feb 2026 12:00 UTC", timeout=PATIENCE)
