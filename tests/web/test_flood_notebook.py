"""The page of a flood as the value of a notebook's cell, in a browser."""

import numpy as np
import pytest
from floods import series
from test_flood_served import settle, white

CODE = """
import xarray, vexture
vexture.flood_page(xarray.open_dataset({path!r}), title='A "surge" & more', amplitude=0, height=560)
"""


@pytest.mark.slow
@pytest.mark.usefixtures("page_is_built")
def test_a_cell_shows_the_flood(open_page, screenshot, tmp_path):
    nbclient, nbformat = (pytest.importorskip(name) for name in ("nbclient", "nbformat"))
    pytest.importorskip("ipykernel")
    run = series(tmp_path / "depth.nc", (0.3, 0.6))
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(CODE.format(path=str(run)))])
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    (output,) = (each for each in notebook.cells[0].outputs if each.output_type == "execute_result")
    shown = tmp_path / "cell.html"
    shown.write_text(f"<!doctype html><meta charset=utf-8><p>In a notebook:</p>{output.data['text/html']}")
    page = open_page(shown.as_uri(), (1000, 640))
    assert page.locator("iframe").bounding_box()["height"] == 560
    inside = page.frames[1]
    inside.wait_for_function("() => window.vexture?.flood?.ready")
    inside.evaluate("() => window.vexture.flood.ready")
    inside.evaluate("() => window.vexture.flood.freeze(2)")  # else its waves take the processor from all others
    assert inside.title() == 'A "surge" & more'
    inside.get_by_role("button", name="Link").click()
    inside.get_by_text("A page in a notebook has no address of its own").wait_for()
    screenshot(page)
    inside.evaluate("for (const one of document.querySelectorAll('#app > :not(.stage)')) one.style.display = 'none'")
    seen = []
    for step in (0, 1):
        inside.evaluate("(step) => window.vexture.flood.step(step)", step)
        settle(inside)
        seen.append(white(inside))
    assert 1.7 < seen[1] / seen[0] < 2.3
    assert np.min(seen) > 1000
