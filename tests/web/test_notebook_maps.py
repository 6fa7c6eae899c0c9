"""A map of many polygons in JupyterLab: a picture at once, which moves, and the same from the texture later."""

import base64
import io
from typing import Any

import numpy as np
import pytest
from jupyter_lab import OpenNotebook, jupyter_lab, write_notebook
from PIL import Image

import vexture  # noqa: F401  # its kernels are compiled for all

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
pytest.importorskip("geopandas", reason="geopandas is not installed (pip install 'vexture[test]')")
pytest.importorskip("cmap", reason="cmap is not installed (pip install 'vexture[map]')")

MADE = """import geopandas, numpy, shapely, vexture
random = numpy.random.default_rng(1)
cells = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(random.random(({count}, 2)))))
cells = shapely.clip_by_rect(cells, 0, 0, 1, 1)
cells = shapely.transform(cells, lambda places: 1e5 * places)
halves = numpy.where(shapely.get_x(shapely.centroid(cells)) < 5e4, "west", "east")
frame = geopandas.GeoDataFrame({{"value": random.random({count}), "half": halves}}, geometry=cells, crs=28992)
"""
SHOWN = """import time
start = time.perf_counter()
chart = vexture.map(frame, "value", crs="EPSG:28992", width=800, height=500)
chart"""
SEEN = "canvas => canvas.toDataURL()"
NEAR = 0.3
"""Mean difference of 255 between two pictures of the same."""


def seen(stage: Any) -> Any:
    """The canvas, 0..255, red, green, blue and opacity."""
    data = stage.locator("canvas").evaluate(SEEN).partition(",")[2]
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data)))).astype(int)


def until(notebook: Any, stage: Any, condition: str) -> None:
    """Wait for a condition on the stage."""
    notebook.page.wait_for_function(f"stage => {condition}", arg=stage.element_handle(), timeout=120_000)


def steady(notebook: Any, stage: Any) -> Any:
    """The canvas, once it changes no more: pictures that were asked for are there."""
    before = seen(stage)
    while True:
        notebook.page.wait_for_timeout(700)
        after = seen(stage)
        if (after == before).all():
            return after
        before = after


@pytest.mark.slow
def test_fifty_thousand_polygons_are_there_at_once_and_stay_as_they_are(chromium: Any, tmp_path: Any) -> None:
    write_notebook(tmp_path / "maps.ipynb", (MADE.format(count=50_000), SHOWN))
    with jupyter_lab(tmp_path, "maps.ipynb") as address:
        page = chromium.new_context(device_scale_factor=1, viewport={"width": 1000, "height": 900}).new_page()
        errors: list[str] = []
        page.on("pageerror", lambda error: errors.append(str(error)))
        notebook = OpenNotebook(page, address)
        notebook.run(0)
        stage = notebook.run(1).locator(".vexture-stage")
        stage.locator("canvas").wait_for(timeout=60_000)
        until(notebook, stage, "stage.ariaBusy === 'true'")
        page.mouse.move(*(stage.bounding_box()[side] + 200 for side in ("x", "y")))
        page.mouse.wheel(0, -600)
        sketched = steady(notebook, stage)
        page.screenshot(path=str(tmp_path / "sketched.png"))
        assert stage.get_attribute("aria-busy") == "true", "no picture before the texture was seen"
        assert len(np.unique(sketched.reshape(-1, 4), axis=0)) > 100
        until(notebook, stage, "stage.ariaBusy === 'false'")
        drawn = steady(notebook, stage)
        page.screenshot(path=str(tmp_path / "drawn.png"))
        assert np.abs(drawn - sketched).mean() < NEAR, "it jumps"
        stage.click(position={"x": 400, "y": 250})
        notebook.until("chart.selected is not None")
        notebook.value("[setattr(chart, 'selected', None), setattr(chart, 'column', 'half')]")
        halves = steady(notebook, stage)
        page.screenshot(path=str(tmp_path / "halves.png"))
        assert np.abs(halves - drawn).mean() > 10
        assert errors == []
        page.context.close()
