"""Steps of time in a map of a notebook."""

import zlib

import numpy as np
import pytest
from closing import no_loop_of_a_browser, none_is_left  # noqa: F401  # of all tests
from small_maps import STEPS, difference, fields, picture_of, shown, timed

from vexture.base.errors import ParameterError

geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")


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
