"""What `vexture.map` is asked for: numbers as ids, lists of names, px of the widget; wrong values told in a line."""

import numpy as np
import pytest
from closing import no_loop_of_a_browser, none_is_left  # noqa: F401  # of all tests

import vexture
from vexture.base.errors import ParameterError

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
pytest.importorskip("cmap", reason="cmap is not installed (pip install 'vexture[map]')")
geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")


def squares(count=4, **columns):
    cells = [shapely.box(4 + k / 10, 52, 4.1 + k / 10, 52.1) for k in range(count)]
    return geopandas.GeoDataFrame({"v": range(1, count + 1), **columns}, geometry=cells, crs=4326)


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("width", "100%", "'100%'; give a whole number of pixels"),
        ("width", 0, "0; give a whole number of pixels"),
        ("height", "300px", "'300px'; give a whole number of pixels"),
        ("size", 1e3, "1000.0; give a whole number of pixels"),
        ("background", 3, "3; give a CSS colour"),
        ("view", "x", "'x'; give four numbers"),
        ("view", (0, 1), r"\(0, 1\); give four numbers"),
        ("tooltip", 3, "there is no column '3'; the columns are id, v"),
        ("tooltip", 1.5, "1.5; give True, False or names"),
        ("legend", "x", "'x'; give True or False"),
        ("snap", -1, r"-1; it must be in 0\.\.0\.01"),
        ("snap", "x", r"'x'; it must be in 0\.\.0\.01"),
        ("tolerance", "x", "'x'; give 'auto' or a number"),
        ("times", 3, "3; give the names of the steps"),
        ("fill", "red", "'red', and `column` 'v' gives colours; leave one out"),
        ("where", squares().v > 2, "is a Series; give a condition in SQL"),
    ],
)
def test_wrong_arguments_are_told_in_the_cell(name, value, words):
    with pytest.raises(ParameterError, match=rf"`{name}`.*{words}") as told:
        vexture.map(squares(), "v", **{name: value})
    assert "\n" not in str(told.value)
    assert len(str(told.value)) < 200


@pytest.mark.parametrize(
    ("column", "words"),
    [
        ([], "empty list"),
        ("", "no column ''"),
        (squares().v, "is a Series of values, .* add them as a column"),
        (np.arange(4.0), "is a ndarray of values, .* add them as a column"),
        ([1, 2, 3, 4], "is a list of values"),
        (["v", "w"], "no column 'w'"),
    ],
)
def test_what_names_no_columns_is_told(column, words):
    with pytest.raises(ParameterError, match=words) as told:
        vexture.map(squares(), column)
    assert "\n" not in str(told.value)


def test_any_list_of_names_is_one():
    frame = squares(y1=1.0, y2=2.0)
    for names in (frame.columns[1:3], frame.columns[1:3].to_numpy(), ("y1", "y2"), frame[["y1", "y2"]].columns):
        assert vexture.map(frame, names[::-1], height=100).times == list(names[::-1])


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"cmap": "Reds"}, "no option 'cmap'; give `palette`"),
        ({"scheme": "quantiles"}, "no option 'scheme'; give `scale`"),
        ({"k": 3}, "no option 'k'; give `classes`"),
        ({"tiles": "x"}, "no option 'tiles'; there are scale, palette, classes"),
        ({"column": None, "scale": "junk"}, "`scale` is 'junk'; give quantiles"),
        ({"column": None, "palette": "junk"}, "the `palette` 'junk' is unknown"),
    ],
)
def test_options_of_others_name_those_that_there_are(options, words):
    with pytest.raises(ParameterError, match=words):
        vexture.map(squares(), **{"column": "v", **options})


def test_a_frame_without_geometries_is_told_to_get_some():
    frame = squares()
    with pytest.raises(ParameterError, match=r"DataFrame without a column of geometries; .*set_geometry"):
        vexture.map(frame[["v"]], "v")
    with pytest.raises(ParameterError, match=r"GeoDataFrame without a column of geometries; .*set_geometry"):
        vexture.map(geopandas.GeoDataFrame({"v": [1]}), "v")
    assert vexture.map(frame, "v", crs=None, snap=None).texture is not None


def test_ids_and_columns_may_be_numbers():
    frame = squares().set_axis(range(10, 14)).assign(w="a").rename(columns={"w": 1})
    chart = vexture.map(frame, "v")
    for given in (11, np.int64(11), 11.0, "11"):
        chart.selected = given
        assert chart.selected == "11"
    chart.colors = {12: "red", np.int64(13): "blue"}
    assert set(chart.colors) == {"12", "13"}
    chart.column = 1
    assert (chart.column, chart.legend["title"]) == ("1", "1")
    for name, value, words in (
        ("selected", 9, "no feature '9'"),
        ("selected", [11], r"`selected` is \[11\]; give one name"),
        ("column", 7, "no column '7'"),
        ("colors", ["red"], r"`colors` is \['red'\]; give a mapping"),
        ("colors", {9: "red"}, "no feature '9'"),
        ("mode", "flat", "`mode` is 'flat'; give 'paint' or 'silhouette'"),
        ("time", "x", "`time` is 'x'; give a number"),
        ("width", "50%", "`width` is '50%'; give a whole number"),
    ):
        with pytest.raises(ParameterError, match=words):
            setattr(chart, name, value)


@pytest.mark.parametrize("start", ["v", None])
def test_without_a_column_features_look_alike_and_have_no_legend(start):
    chart, plain = vexture.map(squares(), start, height=100), vexture.map(squares(), height=100)
    wanted = plain.render()
    chart.column = "v"
    assert np.abs(chart.render() - wanted).max() > 0.2
    chart.column = None
    assert chart.legend is None
    assert np.abs(chart.render() - wanted).max() < 2 / 255


def covered(frame, **options):
    """Pixels that a map of it covers, as it is first shown."""
    chart = vexture.map(frame, **options)
    return float(chart.render()[..., 3].sum())


def test_px_are_those_of_the_widget():
    corners = shapely.points([(0, 0), (10_000, 0), (0, 10_000), (10_000, 10_000)])
    points = geopandas.GeoDataFrame(geometry=corners, crs=28992)
    lines = geopandas.GeoDataFrame(geometry=[shapely.LineString([(0, 0), (10_000, 1)])], crs=28992)
    for height in (200, 500):
        of = {"crs": 28992, "height": height, "width": 800}
        assert covered(points, **of) == pytest.approx(4 * np.pi * 4**2, rel=0.1)
    assert covered(lines, crs=28992, width=540, height=300) == pytest.approx(3 * 500, rel=0.05)
    assert covered(lines, crs=28992, width=540, height=300, size=1000) == pytest.approx(1.5 * 500, rel=0.05)


def test_a_tip_begins_with_what_is_shown_and_has_numbers_as_they_are():
    frame = squares(**{f"c{k}": k for k in range(20)}, year=2020, fips=36061, people=1234567)
    chart = vexture.map(frame, "fips")
    chart.hovered = {"element": "2"}
    assert chart.tip[:3] == [["fips", "36061"], ["id", "2"], ["v", "3"]]
    assert len(chart.tip) == 12
    chart.column = "year"
    assert chart.tip[0] == ["year", "2020"]
    timed = vexture.map(frame, ["people", "year"], tooltip=["v"])
    timed.hovered = {"element": "2"}
    assert timed.tip == [["people", "1234567"], ["v", "3"]]
    for tooltip in (None, False):
        silent = vexture.map(frame, ["people", "year"], tooltip=tooltip)
        silent.hovered = {"element": "2"}
        assert silent.tip == []
