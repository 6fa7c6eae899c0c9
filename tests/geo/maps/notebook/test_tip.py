"""The tip of a feature on a map."""

import pytest
from closing import no_loop_of_a_browser, none_is_left  # noqa: F401  # of all tests
from small_maps import timed

geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")
pytestmark = pytest.mark.usefixtures("page_is_built")


def test_a_tip_tells_the_value_at_the_time():
    chart = timed()
    chart.hovered = {"element": "7"}
    assert ["y8", "7"] in chart.tip
    chart.time = 1
    assert ["y9", "47"] in chart.tip
    assert not any(name == "y8" for name, _ in chart.tip)
