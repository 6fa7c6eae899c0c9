"""`vexture.show` in a real JupyterLab: what the page draws, what Python changes, what the user does."""

import base64
import io
import json
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jupyter_lab import OpenNotebook, jupyter_lab, write_notebook
from PIL import Image

import vexture

for package in ("anywidget", "jupyterlab", "ipykernel", "nbformat"):
    if find_spec(package) is None:  # importing JupyterLab takes each process of tests seconds, and one runs it
        pytest.skip(f"{package} is not installed (pip install 'vexture[notebook,test]')", allow_module_level=True)

pytestmark = [pytest.mark.long, pytest.mark.usefixtures("page_is_built")]

MAP = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100">
<rect id="sea" width="200" height="100" fill="#8af"/>
<path id="east" d="M100 10 190 5 180 90 110 85Z" fill="#4a4"/>
<circle id="west" cx="50" cy="50" r="40" fill="#fc0"/></svg>"""
LEAF = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1Q9 1 8 8Q1 8 1 1Z"/></svg>'

FIELDS = {
    "type": "FeatureCollection",
    "features": [
        {
            "type": "Feature",
            "properties": {"id": name, "yield": value, "crop": crop},
            "geometry": {"type": "Polygon", "coordinates": [[(x, 0), (x + 1, 0), (x + 1, 1), (x, 1), (x, 0)]]},
        }
        for name, value, crop, x in (("west", 4.0, "oats", 0), ("east", 9.0, "rye", 1))
    ],
}
"""Two squares, side by side."""

HOSTILE = "<img src=x onerror=hacked=1>"
"""Code, were it not text; short, so that a legend holds it."""

CELLS = (
    """import traitlets, vexture
chart = vexture.show('map.svg', width=400, height=240)
chart""",
    """twin = vexture.show(chart.texture, width=300, height=200, colors={'east': 'red'})
link = traitlets.link((chart, 'view'), (twin, 'view'))
twin""",
    "chart.colors = {'west': 'blue', 'sea': '#e0f0ff80'}; chart.view = (0, 0.25, 0.5, 0.5)",
    "leaf = vexture.show('leaf.svg', width=160, height=160, background='#fed'); leaf",
    """from IPython.display import display
for _ in range(20):
    display(vexture.show(chart.texture, width=150, height=90))""",
    "leaf.colors = {'leaf': 'green'}; leaf.mode = 'paint'",
    """import vexture, xarray
flood = vexture.show(xarray.open_dataset('depth.nc'), amplitude=0, height=300)
flood""",
    """fields = vexture.map('fields.geojson', 'yield', width=400, height=240, crs='EPSG:4326', classes=2, id='id')
fields""",
    """import json
hostile = json.load(open('hostile.json'))
foreign = vexture.map('hostile.geojson', hostile, width=400, height=240, crs='EPSG:4326', id='id')
foreign""",
)

CONTEXTS = """
window.contexts = new Set();
const { getContext } = HTMLCanvasElement.prototype;
HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
  const found = getContext.call(this, kind, ...more);
  if (found && kind.startsWith('webgl')) window.contexts.add(found);
  return found;
};
"""
"""Counts the contexts of WebGL."""

DRAWN = """([stage, x, y, color]) => {
  const canvas = stage.querySelector('canvas');
  const [red, green, blue] = canvas.getContext('2d').getImageData(x, y, 1, 1).data;
  return String([red, green, blue]) === String(color);
}"""
"""Whether a canvas has a colour at a pixel."""

PICTURE = """(stage) => {
  const canvas = stage.querySelector('canvas');
  const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
  const picture = copy.getContext('2d');
  picture.fillStyle = getComputedStyle(stage).backgroundColor;
  picture.fillRect(0, 0, copy.width, copy.height);
  picture.drawImage(canvas, 0, 0);
  return copy.toDataURL();
}"""

YELLOW, BLUE, RED, SEA = [255, 204, 0], [0, 0, 255], [255, 0, 0], [136, 170, 255]
ABOUT = 5e-4
"""Unit-square units, a fifth of a pixel or less: elements of a page lie between its pixels, and pointers do not."""

NEAR = 3
"""Largest difference of 255 between the picture by the GPU and that by the CPU, whose colours are rounded twice."""


@pytest.fixture(scope="module")
def notebook(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The notebook, open; no script has failed in it."""
    folder = tmp_path_factory.mktemp("notebook")
    (folder / "map.svg").write_text(MAP)
    (folder / "leaf.svg").write_text(LEAF)
    (folder / "fields.geojson").write_text(json.dumps(FIELDS))
    write_notebook(folder / "maps.ipynb", CELLS)
    with jupyter_lab(folder, "maps.ipynb") as address:
        page = chromium.new_context(device_scale_factor=1, viewport={"width": 900, "height": 1500}).new_page()
        errors: list[str] = []
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.add_init_script(CONTEXTS)
        opened = OpenNotebook(page, address)
        page.set_default_timeout(60_000)
        opened.folder = folder
        yield opened
        page.context.close()
        assert errors == []


@pytest.fixture(scope="module")
def chart(notebook: Any) -> Any:
    """The stage of the first cell, drawn."""
    stage = notebook.run(0).locator(".vexture-stage")
    drawn(notebook, stage, (100, 120), YELLOW)
    return stage


@pytest.fixture(scope="module")
def twin(notebook: Any, chart: Any) -> Any:
    """The stage of the second cell, whose view is that of the first."""
    stage = notebook.run(1).locator(".vexture-stage")
    drawn(notebook, stage, (225, 100), RED)
    return stage


def drawn(notebook: Any, stage: Any, place: tuple[int, int], color: list[int]) -> None:
    """Wait until a stage's canvas has a colour at a place."""
    stage.locator("canvas").wait_for()
    notebook.page.wait_for_function(DRAWN, arg=[stage.element_handle(), *place, color])


def seen(stage: Any) -> Any:
    """The canvas on the stage's background, 0..255, in its own pixels: the screen may be between two of them."""
    data = stage.evaluate(PICTURE).partition(",")[2]
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")).astype(int)


def difference(notebook: Any, stage: Any, source: str, **options: Any) -> int:
    """Largest difference of 255 from the same picture by the renderer on the CPU, on its background."""
    picture = seen(stage)
    height, width, _ = picture.shape
    path = notebook.folder / "expected.png"
    vexture.show(notebook.folder / source, width=width, height=height, **options).save(path)
    return int(np.abs(picture - np.asarray(Image.open(path).convert("RGB")).astype(int)).max())


@pytest.mark.slow
def test_a_cell_shows_the_drawing_as_the_cpu_draws_it(notebook: Any, chart: Any) -> None:
    assert difference(notebook, chart, "map.svg") <= NEAR


def test_a_restyled_map_looks_so(notebook: Any, twin: Any) -> None:
    assert difference(notebook, twin, "map.svg", colors={"east": "red"}) <= NEAR


def test_another_cell_changes_colours_and_view(notebook: Any, chart: Any, twin: Any) -> None:
    notebook.run(2)
    drawn(notebook, chart, (200, 120), BLUE)
    drawn(notebook, twin, (150, 100), YELLOW)  # whose view is linked, and whose colours are not
    colors, view = {"west": "blue", "sea": "#e0f0ff80"}, (0.0, 0.25, 0.5, 0.5)
    assert difference(notebook, chart, "map.svg", colors=colors, view=view) <= NEAR
    notebook.value("setattr(chart, 'colors', {})")
    drawn(notebook, chart, (200, 120), YELLOW)
    assert difference(notebook, chart, "map.svg", view=view) <= NEAR
    chart.dblclick(position={"x": 200, "y": 20})
    notebook.until("chart.view == chart._home == twin.view")


def test_a_click_is_read_in_python(notebook: Any, chart: Any) -> None:
    chart.click(position={"x": 290, "y": 100})
    notebook.until("chart.picked and chart.picked['element'] == 'east'")
    picked = notebook.value("chart.picked")
    assert picked["root"] == "map"
    left, bottom, width, height = notebook.value("chart.view")
    pixel = max(width / 400, height / 240)
    place = left + width / 2 + (290 - 200) * pixel, bottom + height / 2 - (100 - 120) * pixel
    assert picked["position"] == pytest.approx(place, abs=ABOUT)
    texture = vexture.show(notebook.folder / "map.svg").texture
    assert picked["source"] == pytest.approx(texture.roots[0].to_source @ (*picked["position"], 1.0))
    assert texture.element_at([picked["position"]]).name.tolist() == ["east"]
    chart.hover(position={"x": 100, "y": 120})
    notebook.until("chart.hovered == {'root': 'map', 'element': 'west'}")
    chart.click(position={"x": 200, "y": 2})
    notebook.until("chart.picked['root'] is None and chart.hovered is None")


def test_linked_views_move_together_and_never_back(notebook: Any, chart: Any, twin: Any) -> None:
    notebook.value(
        "[setattr(vexture, 'seen', []), twin.observe(lambda change: vexture.seen.append(change['new'][0]), 'view')]"
    )
    box, page = chart.bounding_box(), notebook.page
    page.mouse.move(box["x"] + 300, box["y"] + 100)
    page.mouse.down()
    for step in range(1, 31):
        page.mouse.move(box["x"] + 300 - 4 * step, box["y"] + 100)
    page.mouse.up()
    wanted = "chart._home[0] + 120 * max(chart._home[2] / 400, chart._home[3] / 240)"
    notebook.until(f"abs(twin.view[0] - ({wanted})) < 1e-9 and chart.view == twin.view")
    left = notebook.value("vexture.seen")
    assert len(left) > 1
    assert left == sorted(left)
    assert notebook.value("chart.picked['root'] is None"), "a drag is no click"
    left, bottom, width, height = notebook.value("twin.view")
    page.mouse.move(*(twin.bounding_box()[side] + 60 for side in ("x", "y")))
    page.mouse.wheel(0, -300)
    notebook.until(f"chart.view == twin.view and chart.view[2] < {width}")
    zoomed = notebook.value("chart.view")
    pixels = [max(each[2] / 300, each[3] / 200) for each in ((left, bottom, width, height), zoomed)]
    under = [
        (x + w / 2 + (60 - 150) * pixel, y + h / 2 - (60 - 100) * pixel)
        for (x, y, w, h), pixel in zip([(left, bottom, width, height), zoomed], pixels, strict=True)
    ]
    assert under[1] == pytest.approx(under[0], abs=ABOUT)


def test_keys_are_the_widgets_and_not_the_notebooks(notebook: Any, chart: Any) -> None:
    active = (
        "(({ activeCellIndex, widgets }) => [activeCellIndex, widgets.length])(jupyterapp.shell.currentWidget.content)"
    )
    notebook.value("setattr(chart, 'view', (0.1, 0.3, 0.2, 0.2))")
    chart.focus()
    notebook.page.evaluate("jupyterapp.shell.currentWidget.content.mode = 'command'")
    chart.focus()
    before = notebook.page.evaluate(active)
    notebook.page.keyboard.press("ArrowDown")
    notebook.until("chart.view[1] < 0.3 and chart.view[0] == 0.1")
    notebook.page.keyboard.press("+")
    notebook.until("chart.view[2] < 0.2")
    notebook.page.keyboard.press("Home")
    notebook.until("chart.view == chart._home")
    notebook.page.keyboard.press("b")  # which would add a cell
    assert notebook.page.evaluate(active) == before


def test_a_silhouette_is_never_recoloured_by_a_theme(notebook: Any, chart: Any) -> None:
    stage = notebook.run(3).locator(".vexture-stage")
    drawn(notebook, stage, (80, 80), [0, 0, 0])
    light = seen(stage)
    assert difference(notebook, stage, "leaf.svg", background="#fed") <= NEAR
    notebook.page.evaluate("jupyterapp.commands.execute('apputils:change-theme', { theme: 'JupyterLab Dark' })")
    notebook.page.wait_for_function("document.body.dataset.jpThemeLight === 'false'")
    assert (seen(stage) == light).all()
    notebook.run(5)
    drawn(notebook, stage, (80, 80), [0, 128, 0])


@pytest.mark.slow
def test_twenty_views_share_one_context_and_leave_nothing_behind(notebook: Any, chart: Any) -> None:
    for _ in range(2):  # the second time in place of the first
        stages = notebook.run(4).locator(".vexture-stage")
        stages.nth(19).scroll_into_view_if_needed()
        for k in (0, 7, 19):
            stages.nth(k).scroll_into_view_if_needed()
            drawn(notebook, stages.nth(k), (40, 45), YELLOW)
        assert stages.count() == 20
    assert notebook.page.evaluate("window.contexts.size") == 1
    keys = notebook.value("[each.key for each in type(chart).widgets.values() if hasattr(each, 'content')]")
    assert len(keys) == len(set(keys)), "bytes that widgets share are sent once"


def test_a_map_tells_of_what_is_hovered_and_selects_what_is_clicked(notebook: Any, chart: Any) -> None:
    pytest.importorskip("pyarrow", reason="pyarrow is not installed (pip install 'vexture[map]')")
    stage = notebook.run(7).locator(".vexture-stage")
    purple, yellow = [68, 1, 84], [253, 231, 37]
    drawn(notebook, stage, (100, 120), purple)
    drawn(notebook, stage, (300, 120), yellow)
    assert stage.locator(".vexture-legend").inner_text().split("\n") == ["yield", "4 – 6", "7 – 9"]
    notebook.page.mouse.move(1, 1)
    stage.locator(".vexture-tip").wait_for(state="hidden")
    stage.hover(position={"x": 100, "y": 120})
    tip = stage.locator(".vexture-tip")
    tip.wait_for()
    assert tip.inner_text().split("\n") == ["yield", "4", "id", "west", "crop", "oats"]
    assert tip.bounding_box()["width"] < 120, "no rule of JupyterLab widens it"
    stage.click(position={"x": 100, "y": 120})
    notebook.until("fields.selected == 'west'")
    drawn(notebook, stage, (100, 120), [0, 230, 255])
    notebook.value("setattr(fields, 'selected', 'east')")
    drawn(notebook, stage, (300, 120), [0, 230, 255])
    drawn(notebook, stage, (100, 120), purple)
    notebook.value("[setattr(fields, 'selected', None), setattr(fields, 'column', 'crop')]")
    drawn(notebook, stage, (300, 120), [86, 180, 233])
    assert stage.locator(".vexture-legend").inner_text().split("\n") == ["crop", "oats", "rye"]


def test_names_and_values_of_strangers_are_text(notebook: Any, chart: Any) -> None:
    pytest.importorskip("pyarrow", reason="pyarrow is not installed (pip install 'vexture[map]')")
    fields = json.loads(json.dumps(FIELDS))
    for feature in fields["features"]:
        name = feature["properties"]["id"]
        feature["properties"] = {"id": name + HOSTILE, HOSTILE: name + HOSTILE}
    (notebook.folder / "hostile.geojson").write_text(json.dumps(fields))
    (notebook.folder / "hostile.json").write_text(json.dumps(HOSTILE))
    stage = notebook.run(8).locator(".vexture-stage")
    stage.locator(".vexture-legend summary").click()  # it is too wide to be open
    assert stage.locator(".vexture-legend").inner_text().split("\n") == [HOSTILE, f"east{HOSTILE}", f"west{HOSTILE}"]
    notebook.page.mouse.move(1, 1)
    stage.hover(position={"x": 100, "y": 120})
    tip = stage.locator(".vexture-tip")
    tip.wait_for()
    assert tip.inner_text().split("\n") == [HOSTILE, f"west{HOSTILE}", "id", f"west{HOSTILE}"]
    stage.click(position={"x": 100, "y": 120})
    notebook.until("foreign.selected == 'west' + hostile")
    notebook.value("setattr(foreign, 'selected', 'east' + hostile)")
    notebook.page.wait_for_timeout(200)
    assert stage.locator("img").count() == 0
    assert notebook.page.evaluate("window.hacked") is None


@pytest.mark.slow
def test_the_step_of_a_flood_is_that_of_its_page(notebook: Any) -> None:
    pytest.importorskip("netCDF4", reason="netCDF4 is not installed (pip install 'vexture[gis]')")
    from floods import series

    series(notebook.folder / "depth.nc", (0.3, 0.6))
    frame = notebook.run(6).locator("iframe[srcdoc]").element_handle().content_frame()
    frame.wait_for_function("() => window.vexture?.flood?.ready")
    frame.evaluate("() => window.vexture.flood.ready")
    frame.evaluate("() => window.vexture.flood.freeze(2)")  # else its waves take the processor from all others
    notebook.value("setattr(flood, 'step', 1)")
    frame.wait_for_function("() => window.vexture.flood.player.index === 1")
    frame.evaluate("() => window.vexture.flood.step(0)")
    notebook.until("flood.step == 0")
    notebook.value("setattr(flood, 'step', 9)")
    notebook.until("flood.step == 1")


def test_a_saved_page_needs_neither_kernel_nor_network(tmp_path: Path, open_page: Any) -> None:
    (tmp_path / "map.svg").write_text(MAP)
    widget = vexture.show(tmp_path / "map.svg", width=400, height=240, colors={"east": "red"})
    widget.save(tmp_path / "map.html")
    widget.save(tmp_path / "map.png")
    page = open_page((tmp_path / "map.html").as_uri(), (400, 240), bypass_csp=True)
    stage = page.locator(".vexture-stage")
    stage.locator("canvas").wait_for()
    page.wait_for_function(DRAWN, arg=[stage.element_handle(), 290, 100, RED])
    wanted = np.asarray(Image.open(tmp_path / "map.png").convert("RGB")).astype(int)
    assert np.abs(seen(stage) - wanted).max() <= NEAR


def test_each_pixel_of_a_fine_screen_is_drawn(tmp_path: Path, chromium: Any) -> None:
    (tmp_path / "leaf.svg").write_text(LEAF)
    vexture.show(tmp_path / "leaf.svg").save(tmp_path / "leaf.html")
    context = chromium.new_context(device_scale_factor=2.5, viewport={"width": 80, "height": 60}, bypass_csp=True)
    page = context.new_page()
    page.goto((tmp_path / "leaf.html").as_uri())
    stage = page.locator(".vexture-stage")
    page.wait_for_function(DRAWN, arg=[stage.element_handle(), 100, 75, [0, 0, 0]])
    assert seen(stage).shape == (150, 200, 3)
    page.set_viewport_size({"width": 120, "height": 60})
    page.wait_for_function("document.querySelector('canvas').width === 300")
    page.wait_for_function(DRAWN, arg=[stage.element_handle(), 150, 75, [0, 0, 0]])
    assert seen(stage).shape == (150, 300, 3)
    context.close()
