"""The widget of a map: what it sends, and when."""

import asyncio
import threading

import numpy as np
import pytest
from closing import no_loop_of_a_browser, none_is_left  # noqa: F401  # of all tests
from small_maps import difference, picture_of, shown

from vexture.base.errors import ParameterError

geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")


def test_another_view_column_or_selection_is_drawn_before_the_texture_is_there(held):
    chart = shown()
    before = picture_of(chart)
    chart._wanted = {"view": [0.2, 0.2, 0.3, 0.3], "size": [150, 120]}
    assert picture_of(chart).shape == (120, 150, 4)
    chart.view = (0.2, 0.2, 0.3, 0.3)
    assert difference(picture_of(chart), 255 * chart.render((150, 120))) <= 1
    chart.view = chart._home
    chart._wanted = {"view": list(chart.view), "size": [300, 200]}
    assert difference(picture_of(chart), before) == 0
    chart.column = "kind"
    kinds = picture_of(chart)
    assert difference(kinds, before) > 100
    chart.selected = "7"
    assert 0 < (picture_of(chart) != kinds).any(axis=2).mean() < 0.1
    chart.colors = {"8": "red"}
    before = chart.render()
    held.set()
    chart.texture  # noqa: B018  # is waited for
    assert difference(before, chart.render()) < 1 / 255


def test_a_column_sends_a_byte_for_each_feature():
    chart = shown()
    texture = chart.texture
    assert chart._coloring is None
    chart.column = "kind"
    assert [len(chart._coloring[part]) for part in ("colors", "places")] == [3 * 8, 300]
    assert chart.colors == {}
    names = texture.roots[0].style.names
    colours = np.frombuffer(chart._coloring["colors"], np.uint16).reshape(-1, 4) / 10_000
    places = np.frombuffer(chart._coloring["places"], np.uint8)
    sent = dict(zip(names, colours[places].tolist(), strict=True))
    kinds = dict(zip(chart.table["id"].to_pylist(), chart.table["kind"].to_pylist(), strict=True))
    legend = {entry["label"]: entry["color"] for entry in chart.legend["entries"]}
    for name, parts in sent.items():
        assert "#{:02x}{:02x}{:02x}".format(*(round(255 * part) for part in parts[:3])) == legend[kinds[name]]


def test_the_texture_comes_between_the_messages_of_a_kernel(held):
    threads = []

    async def cell():
        chart = shown()
        chart.observe(lambda change: threads.append(threading.current_thread()), "_source")
        held.set()
        while chart._source is None:
            await asyncio.sleep(0.01)
        return chart

    chart = asyncio.run(cell())
    assert threads == [threading.main_thread()]
    assert chart.texture.roots[0].style is not None


def test_a_conversion_that_fails_says_so_in_the_page_and_in_python(monkeypatch):
    import vexture_geo.maps.notebook.map_widget as module

    chart = shown(tolerance=0.0, max_seconds=5.0)
    assert chart.texture is not None
    monkeypatch.setattr(module, "_encode", lambda made: {}["a name"])
    failing = shown()
    with pytest.raises(KeyError, match="a name"):
        failing.texture  # noqa: B018  # raises
    assert failing._failure == "KeyError: 'a name'"
    assert failing.render().shape == (200, 300, 4)


def test_a_widget_that_is_closed_is_left_alone(held):
    chart = shown()
    chart.close()
    held.set()
    chart._pending.result()
    assert chart._source is None


def test_unknown_features_are_refused_before_and_after(held):
    chart = shown()
    for _ in range(2):
        with pytest.raises(ParameterError, match="no feature 'x'"):
            chart.colors = {"x": "red"}
        with pytest.raises(ParameterError, match="no feature 'x'"):
            chart.selected = "x"
        held.set()
        chart.texture  # noqa: B018  # is waited for


def test_a_map_that_is_converted_before_the_call_is_over_arrives(monkeypatch):
    import vexture_geo.maps.notebook.map_widget as module

    class Late(module.Pending):
        """Its name is given to it when its thread has long been done."""

        def __init__(self, *given):
            super().__init__(*given)
            self._thread.join(0.5)

    monkeypatch.setattr(module, "_encode", lambda _: pytest.fail("nothing is converted"))
    monkeypatch.setattr(module, "Pending", Late)
    chart = shown()
    chart._pending._thread.join(10.0)
    assert "nothing is converted" in chart._failure
