"""`vexture.map` without a browser: the first picture, what is sent, and what is asked for before the texture."""

import base64
import json
import warnings
from pathlib import Path

import numpy as np
import pytest
from closing import no_loop_of_a_browser, none_is_left  # noqa: F401  # of all tests
from small_maps import METRES, fields, shown

import vexture
from vexture.base.errors import LimitError, ParameterError, SourceWarning

geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")


def test_a_saved_page_has_its_colours(tmp_path):
    chart = shown()
    chart.column = "kind"
    chart.save(tmp_path / "map.html")
    scene = (tmp_path / "map.html").read_text().partition('"_coloring":')[2]
    found, _ = json.JSONDecoder().raw_decode(scene.lstrip())
    assert base64.b64decode(found["places"]["base64"]) == chart._coloring["places"]


def test_too_long_is_said():
    with pytest.raises(LimitError, match="raise `max_seconds`"):
        shown(max_seconds=1e-9).texture  # noqa: B018  # raises


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
