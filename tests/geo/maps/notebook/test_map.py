"""`vexture.map` without a browser: the first picture, what is sent, and what is asked for before the texture."""

import asyncio
import base64
import io
import json
import threading
import warnings
import zlib
from pathlib import Path

import numpy as np
import pytest
from closing import no_loop_of_a_browser, none_is_left  # noqa: F401  # of all tests
from PIL import Image

import vexture
from vexture.base.errors import LimitError, ParameterError, SourceWarning

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
pytest.importorskip("cmap", reason="cmap is not installed (pip install 'vexture[map]')")
geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")

METRES = "EPSG:28992"


def fields(count=300, seed=5):
    random = np.random.default_rng(seed)
    cells = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(random.uniform(0, 1000, (count, 2)))))
    cells = shapely.clip_by_rect(cells, 0, 0, 1000, 1000)
    columns = {"value": random.random(count), "kind": random.choice(["a", "b", "c"], count)}
    return geopandas.GeoDataFrame(columns, geometry=cells, crs=METRES)


def shown(frame=None, column="value", **options):
    return vexture.map(fields() if frame is None else frame, column, crs=METRES, width=300, height=200, **options)


@pytest.fixture
def held(monkeypatch):
    """Conversions that wait for an event."""
    import vexture_geo.maps.notebook.map_widget as module

    go, real = threading.Event(), module._encode
    monkeypatch.setattr(module, "_encode", lambda made: go.wait(30) and real(made))
    yield go
    go.set()


def picture_of(chart):
    return np.asarray(Image.open(io.BytesIO(chart._picture["content"]))).astype(int)


def difference(one, other):
    return np.abs(one.astype(float) - other).max()


def test_the_first_picture_is_that_of_the_texture(held):
    chart = shown()
    first, sent = chart.render(), picture_of(chart)
    assert chart._source is None
    assert sent.shape == (200, 300, 4)
    held.set()
    chart.texture  # noqa: B018  # is waited for
    assert chart._source is not None
    assert chart._picture is None
    assert difference(first, chart.render()) < 1 / 255


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


def test_a_saved_page_has_its_colours(tmp_path):
    chart = shown()
    chart.column = "kind"
    chart.save(tmp_path / "map.html")
    scene = (tmp_path / "map.html").read_text().partition('"_coloring":')[2]
    found, _ = json.JSONDecoder().raw_decode(scene.lstrip())
    assert base64.b64decode(found["places"]["base64"]) == chart._coloring["places"]


def test_lines_and_points_are_in_the_first_picture(held):
    marks = [shapely.LineString([(0, 0), (1000, 600)]), shapely.Point(800, 100), shapely.box(0, 500, 300, 900)]
    frame = geopandas.GeoDataFrame({"value": [1.0, 2.0, 3.0]}, geometry=marks, crs=METRES)
    chart = shown(frame, stroke="30m", symbol_size="90m")
    first = chart.render()
    held.set()
    chart.texture  # noqa: B018  # is waited for
    assert difference(first, chart.render()) < 12 / 255, "edges of one layer over another are mixed"
    assert np.abs(first - chart.render()).mean() < 0.1 / 255


def test_unknown_features_are_refused_before_and_after(held):
    chart = shown()
    for _ in range(2):
        with pytest.raises(ParameterError, match="no feature 'x'"):
            chart.colors = {"x": "red"}
        with pytest.raises(ParameterError, match="no feature 'x'"):
            chart.selected = "x"
        held.set()
        chart.texture  # noqa: B018  # is waited for


def test_too_long_is_said():
    with pytest.raises(LimitError, match="raise `max_seconds`"):
        shown(max_seconds=1e-9).texture  # noqa: B018  # raises


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


STEPS = ("y8", "y9", "y10")


def timed(**options):
    frame = fields(60)
    for number, name in enumerate(STEPS):
        frame[name] = np.roll(np.arange(60.0), 20 * number)
    return shown(frame, "y*", classes=3, **options)


def test_steps_are_sent_once_and_a_time_is_a_number():
    chart = timed()
    texture = chart.texture
    assert (chart.times, chart.time, chart.column) == ([*STEPS], 0.0, None)
    messages = []
    chart._send, real = (
        lambda message, buffers=None: messages.append((message, buffers)) or real(message, buffers),
        chart._send,
    )
    chart.time = 2
    changed = {name for message, _ in messages for name in message.get("state", {})}
    assert changed == {"time"}
    assert not any(buffers for _, buffers in messages)
    names, parts = texture.roots[0].style.names, chart._steps
    places = np.frombuffer(zlib.decompress(parts["places"]), np.uint8).reshape(3, 60)
    colours = np.frombuffer(parts["colors"], np.uint16).reshape(-1, 4)
    assert len(colours) == 3
    rows = np.array([int(name) for name in names])
    assert (places[0][np.argsort(rows)] == places[1][np.argsort(rows)][np.roll(np.arange(60), -20)]).all()
    assert len(chart.legend["entries"]) == 3, "one scale of all steps"


def test_a_time_before_and_after_the_texture_is_the_same_picture(held):
    chart = timed()
    first = chart.render()
    chart.time = 1
    second = chart.render()
    assert difference(first, second) > 0.2
    inside = (first[..., 3] == 1.0) & (second[..., 3] == 1.0)
    assert np.abs(picture_of(chart) - 255 * second)[inside].max() <= 1
    held.set()
    chart.texture  # noqa: B018  # is waited for
    assert difference(second, chart.render()) < 1 / 255
    chart.time = 0
    assert difference(first, chart.render()) < 1 / 255
    chart.time = 0.5
    mixed = chart.render()
    assert np.abs(mixed - (first + second) / 2)[inside].max() < 2 / 255


def test_another_column_hides_the_time_and_none_shows_it_again():
    chart = timed()
    before, first = chart.texture and chart.render(), chart._steps
    chart.column = "kind"
    assert (chart.times, chart._steps) == ([], None)
    assert difference(before, chart.render()) > 0.2
    chart.column = None
    assert chart.times == [*STEPS]
    assert chart._steps == first
    assert difference(before, chart.render()) < 1 / 255


def test_a_tip_tells_the_value_at_the_time():
    chart = timed()
    chart.hovered = {"element": "7"}
    assert ["y8", "7"] in chart.tip
    chart.time = 1
    assert ["y9", "47"] in chart.tip
    assert not any(name == "y8" for name, _ in chart.tip)


def test_a_table_of_ids_times_and_values_is_shown():
    import pandas

    table = pandas.DataFrame({"id": [7, 7, 8], "time": pandas.to_datetime(["2001-02-01", "2001-01-01", "2001-01-01"])})
    chart = shown(fields(20), None, times=table.assign(people=[1.0, 2.0, 3.0]), classes=3)
    assert chart.times == ["2001-01-01", "2001-02-01"]
    assert chart.table["2001-01-01"].to_pylist()[7:9] == [2.0, 3.0]
    assert chart.legend["title"] == "people"


@pytest.mark.parametrize(
    ("column", "times", "words"),
    [
        ("z*", None, "no column is like 'z\\*' of `column`"),
        (["y8", "y7"], None, "no column 'y7' for `column`"),
        (["y8", "y9"], ["2008"], "1 name for 2 steps"),
        (None, ["2008"], "give the `column` of each"),
        ("kind", "table.csv", "`column` 'kind' is not shown"),
        (["y8", "kind"], None, "differ in type"),
    ],
)
def test_steps_that_are_not_there_are_refused(column, times, words):
    frame = fields(5).assign(y8=1.0, y9=2.0)
    with pytest.raises(ParameterError, match=words):
        shown(frame, column, times=times)


def test_a_time_beyond_the_steps_is_refused():
    with pytest.raises(ParameterError, match=r"`time` is 3; it must be in 0\.\.2"):
        timed().time = 3


def test_outlines_are_in_both_pictures_and_are_no_features(held):
    chart = shown(outline="black", outline_width="3px", size=300)
    first = chart.render()
    assert difference(first, shown().render()) > 0.5
    held.set()
    texture = chart.texture
    assert np.abs(first - chart.render()).mean() < 0.2 / 255
    assert "outline" in texture.roots[0].style.names
    chart.picked = {"element": "outline"}
    chart.hovered = {"element": "outline"}
    assert (chart.selected, chart.tip) == (None, [])
    before = chart.render()
    chart.column = "kind"
    chart.colors = {"outline": "white"}
    assert difference(before, chart.render()) > 0.5
    with pytest.raises(ParameterError, match="no feature 'outline'"):
        chart.selected = "outline"


def test_a_column_whose_name_looks_like_a_pattern_is_a_column():
    chart = shown(fields(5).rename(columns={"value": "share [%] *"}), "share [%] *")
    assert (chart.column, chart.times) == ("share [%] *", [])
    frame = fields(5).rename(columns={"value": "share [%] 1"}).assign(**{"share [%] 2": 1.0, "share x 3": 1.0})
    assert shown(frame, "share [%]*").times == ["share [%] 1", "share [%] 2"]


def test_names_and_numbers_of_columns_work_as_they_are_or_say_why():
    frame = fields(20).rename(columns={"value": 0, "kind": "a*[b]"})
    frame["c?"] = [f"id {k}" for k in range(20)]
    chart = shown(frame, 0, tooltip=[0], id="c?", columns=[0, "a*[b]"], order="a*[b]", scale=[0.2, 0.5], classes="3")
    assert (chart.column, len(chart.legend["entries"])) == ("0", 3)
    chart.hovered = {"element": chart.table["id"][0].as_py()}
    assert [name for name, _ in chart.tip] == ["0"]
    chart.column = "a*[b]"
    assert shown(frame, "a*[b]", tooltip="0").legend["title"] == "a*[b]"
    named = fields(20).rename(columns={"kind": "[b"})
    assert shown(named, order="[b").texture is not None
    for wrong in ({"outline": "red", "outline_width": 2}, {"symbol": "a.svg"}, {"size": "big"}, {"fill": "red"}):
        with pytest.raises(ParameterError, match=f"`{[*wrong][-1]}`.*; .*(give|must|leave)"):
            shown(**wrong)


@pytest.mark.parametrize("crs", [28992, "object"])
def test_a_reference_system_is_named_as_geopandas_names_it(crs):
    frame = fields(20)
    chart = vexture.map(frame, "value", crs=frame.crs if crs == "object" else crs)
    assert chart.texture.roots[0].to_source[0, 0] == pytest.approx(1000.0)


def test_what_is_selected_is_a_label_of_the_index():
    frame = fields(20).set_index([[f"cell {k}" for k in range(20)]])
    chart = shown(frame)
    chart.picked = {"element": "cell 7"}
    assert chart.selected == "cell 7"
    assert chart.table["value"][7].as_py() == frame.loc[chart.selected, "value"]
    later = shown(fields(20)[10:])
    later.selected = "19"


def test_a_column_without_values_is_shown_in_the_colour_of_no_data():
    chart = shown(fields(20).assign(nothing=np.nan), scale="continuous")
    with pytest.warns(SourceWarning, match="no feature has a value in 'nothing'"):
        assert shown(fields(20).assign(nothing=np.nan), "nothing", scale="continuous").texture is not None
    chart.column = "nothing"
    assert chart.legend["entries"] == [{"label": "no data", "color": "#d9d9d9"}]


def test_warnings_name_the_line_that_asked_for_the_map(held):
    frame = fields(20)
    frame.geometry = frame.geometry.where(frame.index != 3, None)
    grown = shapely.buffer(frame.geometry.values, 40)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        chart = vexture.map(frame.set_geometry(grown, crs=METRES), "value", crs=METRES)
        held.set()
        chart._pending._thread.join(30)
    assert [each.category for each in told] == [SourceWarning] * 2
    lines = Path(__file__).read_text().splitlines()
    assert {each.filename for each in told} == {__file__}
    assert all("chart = vexture.map(" in lines[each.lineno - 1] for each in told)
