"""What `vexture.map` takes and refuses, and what a tip tells."""

import pandas
import pytest
import traitlets

import vexture
from vexture.errors import ParameterError

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
pytest.importorskip("cmap", reason="cmap is not installed (pip install 'vexture[map]')")
geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")

METRES = "EPSG:28992"


@pytest.fixture(autouse=True)
def none_is_left():
    import ipywidgets

    yield
    for widget in list(ipywidgets.widgets.widget._instances.values()):
        if hasattr(widget, "_pending"):
            widget._pending.result()
    ipywidgets.Widget.close_all()


def squares(count=4, index=None, **columns):
    cells = [shapely.box(100 * k, 0, 100 * k + 100, 100) for k in range(count)]
    return geopandas.GeoDataFrame(columns or {"v": range(count)}, geometry=cells, crs=METRES, index=index)


def test_any_list_of_names_is_steps():
    frame = squares(y1=range(4), y2=range(1, 5))
    for names in (frame.columns[:2], frame.columns[:2].to_numpy(), ("y1", "y2")):
        assert vexture.map(frame, names, crs=METRES).times == ["y1", "y2"]


@pytest.mark.parametrize(
    ("column", "options", "message"),
    [
        ([], {}, "`column` is a list of no names; give one for each step of time"),
        (pandas.Series([1.0, 2.0]), {}, r"`column` is values \(Series\); add them as a column of the source"),
        (pandas.Series([1.0, 2.0]).to_numpy(), {}, r"`column` is values \(ndarray\); add them as a column"),
        ("v", {"cmap": "Reds"}, "map has no option 'cmap'; give `palette`"),
        ("v", {"nonsense": 1}, "map has no option 'nonsense'; its options are scale, palette, "),
        ("v", {"snap": -1}, "`snap` is -1; it must be in 0..0.01"),
        ("v", {"snap": "x"}, "`snap` is 'x'; it must be in 0..0.01"),
        ("v", {"tolerance": "x"}, "`tolerance` is 'x'; give a number of 0 or more"),
        ("v", {"width": "100%"}, "`width` is '100%'; give a whole number of pixels, 1 or more, or None"),
        ("v", {"height": 0}, "`height` is 0; give a whole number of pixels, 1 or more$"),
        ("v", {"background": 3}, "`background` is 3; give a CSS colour"),
        ("v", {"view": (0, 0, 1)}, r"`view` is \(0, 0, 1\); give left, bottom, width and height"),
        ("v", {"legend": "x"}, "`legend` is 'x'; give True or False"),
        ("v", {"tooltip": 3}, "`tooltip` is 3; give names of columns, True or False"),
    ],
)
def test_what_cannot_be_is_refused_in_the_cell(column, options, message):
    with pytest.raises(ParameterError, match=message):
        vexture.map(squares(), column, crs=METRES, **options)


def test_names_may_be_numbers():
    shown = vexture.map(squares(index=[10, 11, 12, 13], **{"0": range(4), "1": range(4)}), 0, crs=METRES)
    shown.selected = 11
    shown.colors = {12: "red"}
    shown.column = 1
    assert (shown.selected, list(shown.colors), shown.column) == ("11", ["12"], "1")
    with pytest.raises(ParameterError, match="`column` is None, and the map has no steps of time"):
        shown.column = None
    with pytest.raises(ParameterError, match="there is no feature '14'"):
        shown.selected = 14
    assert isinstance(shown.traits()["selected"], traitlets.CUnicode)


def test_a_tip_tells_what_is_coloured_as_it_is_written():
    columns = {f"c{k}": range(4) for k in range(15)}
    shown = vexture.map(squares(**columns, year=[2020, 2021, 2022, 2023]), "year", crs=METRES)
    shown.hovered = {"root": None, "element": "2"}
    assert shown.tip[:3] == [["id", "2"], ["year", "2022"], ["c0", "2"]]
    assert len(shown.tip) == 12
    quiet = vexture.map(squares(), "v", crs=METRES, tooltip=None)
    quiet.hovered = {"root": None, "element": "2"}
    assert quiet.tip == []


def test_lines_and_points_are_as_wide_as_the_widget_shows_them():
    line = geopandas.GeoDataFrame({"v": [1]}, geometry=[shapely.LineString([(0, 0), (1000, 0)])], crs=METRES)
    shown = vexture.map(line, "v", crs=METRES, width=400, height=200)
    picture = shown.render((400, 200))[..., 3]
    seen = picture[:, 200].sum() / (400 / 200)  # the map is as wide as the widget, and pixels are those of its height
    assert 1.0 < seen < 3.0
