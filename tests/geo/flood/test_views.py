"""What the page of a flood looks at."""

import numpy as np
import pytest
from floods import FRAME, surfaces, west

from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Extent, Step
from vexture_geo.flood.grids import coverage_over
from vexture_geo.flood.open_water import open_water
from vexture_geo.flood.surface import highest_of
from vexture_geo.flood.views import viewpoint, views_of


@pytest.mark.parametrize(
    ("name", "names"),
    [
        ("coast", ["Flooded land", "Coast", "Shore", "Beach"]),
        ("river", ["Flooded land", "Riverside", "Waterline"]),
        ("polder", ["Flooded land", "Coast", "Shore", "Beach"]),
        ("streets", ["Town", "Riverside", "Waterline"]),
    ],
)
def test_views_are_named_by_what_is_there_and_stand_on_dry_ground(floods, name, names):
    extent = floods[name]
    _, found = surfaces(extent)
    highest = highest_of(found)
    openness = open_water(extent.steps[0].drawing, extent.frame)
    views = views_of(extent, openness, highest)
    assert [view.name for view in views] == names
    for view in views:
        assert np.hypot(*view.toward) == pytest.approx(1.0)
        assert np.isfinite(view.above)
    stands = next(view for view in views if view.kind == "eye")
    x, y = stands.place
    near = 1e-3
    for step in extent.steps:  # the water is before it, never behind it
        behind = np.array(stands.place) - 3.0 * near * np.array(stands.toward)
        box = (behind[0] - near, behind[1] - near, behind[0] + near, behind[1] + near)
        assert coverage_over(step.drawing, box, (2, 2)).max() < 0.01
    box = (x - near, y - near, x + near, y + near)
    assert max(coverage_over(step.drawing, box, (2, 2)).max() for step in extent.steps) > 0.1


def test_nothing_under_water_has_no_views():
    assert views_of(Extent(FRAME, (Step(Drawing(())),)), None, None) == ()


def test_a_pond_is_no_coast():
    """With a sea in the frame, its shore is looked at, and not that of a pond in the middle."""
    x0, y0, x1, _ = FRAME.box
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    pond = [(0.5 + 0.05 * np.cos(a), 0.5 + 0.05 * np.sin(a)) for a in turn.tolist()]
    sea = [(x0, y0), (x1, y0), (x1, y0 + 0.12), (x0, y0 + 0.12)]
    both = Drawing.polygon(sea, pond)
    shore = viewpoint(both, FRAME, openness=open_water(both, FRAME))
    assert shore.place[1] == pytest.approx(y0 + 0.12, abs=0.01)
    assert shore.seaward[1] < -0.9


def test_viewpoint_is_none_where_there_is_no_shore():
    assert viewpoint(Drawing(()), FRAME) is None
    assert viewpoint(Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), FRAME) is None


def test_viewpoint_avoids_ponds():
    x0, y0, x1, y1 = FRAME.box
    middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    pond = [(middle[0] - 0.01, middle[1] - 0.01), (middle[0] + 0.01, middle[1] - 0.01), (middle[0], middle[1] + 0.01)]
    sea = west(0.3).paths[0].contours[0][:, 0].tolist()
    shore = viewpoint(Drawing.polygon(sea, pond), FRAME)
    assert shore.place[0] == pytest.approx(x0 + 0.3 * (x1 - x0), abs=1e-5)
    assert shore.seaward == pytest.approx((-1.0, 0.0), abs=1e-3)
