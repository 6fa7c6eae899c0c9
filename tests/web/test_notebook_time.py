"""The time of a map in a browser: a saved page, whose slider colours the texture, and sends colours only."""

import base64
import io
from typing import Any

import numpy as np
import pytest
from PIL import Image

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
geopandas = pytest.importorskip("geopandas", reason="geopandas is not installed (pip install 'vexture[test]')")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")

COUNT, STEPS = 4000, 6
SIZE = (500, 400)

COUNTING = """() => {
  globalThis.sent = 0;
  const real = WebGL2RenderingContext.prototype.texSubImage2D;
  WebGL2RenderingContext.prototype.texSubImage2D = function (...given) {
    globalThis.sent += given[4] * given[5];
    return real.apply(this, given);
  };
  const whole = WebGL2RenderingContext.prototype.texImage2D;
  WebGL2RenderingContext.prototype.texImage2D = function (...given) {
    globalThis.sent = NaN;
    return whole.apply(this, given);
  };
}"""

DRAWN = """() => {
  const canvas = document.querySelector('.vexture-stage canvas');
  return canvas?.getContext('2d').getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data[3] > 0;
}"""
FRAMES = "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 50))))"


def chart() -> Any:
    """Cells of which each has another value at each step."""
    import vexture

    random = np.random.default_rng(4)
    cells = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(random.uniform(0, 1000, (COUNT, 2)))))
    cells = shapely.clip_by_rect(cells, 0, 0, 1000, 1000)
    columns = {f"y{2000 + step}": random.random(COUNT) for step in range(STEPS)}
    frame = geopandas.GeoDataFrame(columns, geometry=cells, crs="EPSG:28992")
    return vexture.map(frame, "y*", crs="EPSG:28992", background="transparent", legend=False)


def seen(page: Any) -> Any:
    """The canvas, 0..255."""
    page.evaluate(FRAMES)
    data = page.locator(".vexture-stage canvas").evaluate("canvas => canvas.toDataURL()").partition(",")[2]
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data)))).astype(float)


def test_the_slider_of_a_saved_page_shows_each_step(open_page: Any, tmp_path: Any, screenshot: Any) -> None:
    shown = chart()
    shown.save(tmp_path / "map.html")
    page = open_page((tmp_path / "map.html").as_uri(), SIZE)
    page.wait_for_function(DRAWN)
    slider, name = page.locator(".vexture-time input"), page.locator(".vexture-time output")
    assert name.text_content() == "y2000"
    page.evaluate(COUNTING)
    rows, texels = shown.texture.texels.shape[:2]
    for step in (3, 5, 1):
        before = page.evaluate("sent")
        slider.fill(str(step))
        picture = seen(page)
        assert name.text_content() == f"y{2000 + step}"
        assert 0 < page.evaluate("sent") - before < rows * texels / 3, "more than colours were sent"
        shown.time = step
        wanted = 255 * shown.render(SIZE)
        inside = wanted[..., 3] > 254.9
        assert np.abs(picture - wanted)[inside].max() < 3
    screenshot(page)
    page.locator(".vexture-time button").click()
    page.wait_for_function("() => document.querySelector('.vexture-time output').textContent === 'y2003'")
    page.locator(".vexture-time button").click()
    assert page.locator(".vexture-time button").text_content() == "▶"
