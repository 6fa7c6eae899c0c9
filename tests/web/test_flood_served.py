"""`vexture flood` in a browser: the page in one file, and a server whose water changes under everyone's eyes."""

import io

import numpy as np
import pytest
from floods import BOUNDS, flood, flooding, sea
from PIL import Image

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
