"""The first picture of a map, before its texture is there."""

import numpy as np
import pytest
from closing import no_loop_of_a_browser, none_is_left  # noqa: F401  # of all tests
from small_maps import METRES, difference, picture_of, shown

from vexture.base.errors import ParameterError

geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")


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


def test_lines_and_points_are_in_the_first_picture(held):
    marks = [shapely.LineString([(0, 0), (1000, 600)]), shapely.Point(800, 100), shapely.box(0, 500, 300, 900)]
    frame = geopandas.GeoDataFrame({"value": [1.0, 2.0, 3.0]}, geometry=marks, crs=METRES)
    chart = shown(frame, stroke="30m", symbol_size="90m")
    first = chart.render()
    held.set()
    chart.texture  # noqa: B018  # is waited for
    assert difference(first, chart.render()) < 12 / 255, "edges of one layer over another are mixed"
    assert np.abs(first - chart.render()).mean() < 0.1 / 255


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
