"""Where the water is open to waves, and where it stays calm."""

import numpy as np
import pytest
from floods import BOUNDS, CRS, FRAME, surfaces

from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Extent, Frame, Step
from vexture_geo.flood.grids import coverage_over
from vexture_geo.flood.ground import drawn_ground
from vexture_geo.flood.open_water import calm_waves, open_water, openness_at
from vexture_geo.flood.relief import beyond_of
from vexture_geo.flood.surface import highest_of
from vexture_geo.flood.views import views_of


@pytest.mark.parametrize(("name", "open_share"), [("coast", 0.3), ("river", 0.0), ("streets", 0.0)])
def test_waves_are_in_open_water_only(floods, name, open_share):
    extent = floods[name]
    openness = open_water(extent.steps[0].drawing, extent.frame)
    assert (openness > 0.5).mean() == pytest.approx(open_share, abs=0.06)


@pytest.mark.parametrize(("wide", "is_open"), [(20.0, False), (150.0, False), (350.0, True), (900.0, True)])
def test_a_strip_along_the_border_is_open_only_if_it_is_wide_within_it(wide, is_open):
    """Water goes on beyond the frame as at its border, but a street there is no sea."""
    frame = Frame((0.0, 0.0, 4000.0, 3000.0), "EPSG:28992", (4000.0, 3000.0))
    x0, y0, _, y1 = frame.box
    east = x0 + wide / 4000.0 * (frame.box[2] - x0)
    strip = Drawing.polygon([(0.0, y0), (east, y0), (east, y1), (0.0, y1)])
    assert bool(open_water(strip, frame).any()) == is_open


def test_open_water_ends_softly_and_leaves_corners_and_channels():
    """A sea in the south, with a channel of 100 m and an acute bay in its shore."""
    x0, y0, x1, _ = FRAME.box
    metre = (x1 - x0) / 4000.0
    shore = y0 + 1000 * metre
    sea = [
        (x0, y0), (x1, y0), (x1, shore), (0.75, shore), (0.72, shore + 600 * metre), (0.69, shore),
        (0.5 + 50 * metre, shore), (0.5 + 50 * metre, shore + 800 * metre), (0.5 - 50 * metre, shore + 800 * metre),
        (0.5 - 50 * metre, shore), (x0, shore),
    ]  # fmt: skip
    openness = open_water(Drawing.polygon(sea), FRAME)
    at = openness_at(
        openness, FRAME, np.array([(0.3, shore - 20 * metre), (0.5, shore + 400 * metre), (0.72, shore + 450 * metre)])
    )
    assert at[0] > 0.9
    assert at[1] == 0.0
    assert at[2] == 0.0
    assert np.abs(np.diff(openness, axis=0)).max() < 0.5


@pytest.mark.parametrize(("across", "open_to_waves"), [(600, False), (1800, False), (2400, True)])
@pytest.mark.parametrize("leaves", [False, True])
def test_neither_a_pond_nor_a_wide_river_is_open(across, open_to_waves, leaves):
    """Water of a width, as a round lake in a frame of 6 km, and as a river from border to border."""
    frame = Frame(BOUNDS, CRS, (6000.0, 3000.0))
    x0, _, x1, _ = frame.box
    half = 0.5 * across / 6000.0 * (x1 - x0)
    turn = np.linspace(0.0, 2.0 * np.pi, 90, endpoint=False)
    lake = [(0.5 + half * np.cos(a), 0.5 + half * np.sin(a)) for a in turn.tolist()]
    river = [(x0, 0.5 - half), (x1, 0.5 - half), (x1, 0.5 + half), (x0, 0.5 + half)]
    openness = open_water(Drawing.polygon(river if leaves else lake), frame)
    assert (openness.max() > 0.9) == open_to_waves
    drawn = coverage_over(Drawing.polygon(river if leaves else lake), frame.box, openness.shape[::-1])
    if open_to_waves:  # all of it, and nothing far from it
        assert openness[drawn > 0.5].min() > 0.5
        assert openness[0, 0] == 0.0


def test_a_pond_stays_calm_beside_the_sea():
    """The sea is open and so is its arm of 700 m, but not a pond of 600 m, which they do not touch."""
    frame = Frame(BOUNDS, CRS, (6000.0, 3000.0))
    x0, y0, x1, y1 = frame.box
    metre = (x1 - x0) / 6000.0
    pond = [(0.5 - 300 * metre, y1 - 700 * metre), (0.5 + 300 * metre, y1 - 700 * metre),
            (0.5 + 300 * metre, y1 - 100 * metre), (0.5 - 300 * metre, y1 - 100 * metre)]  # fmt: skip
    shore, arm = y0 + 1100 * metre, x1 - 1500 * metre
    sea = [(x0, y0), (x1, y0), (x1, shore), (arm + 350 * metre, shore), (arm + 350 * metre, y1 - 200 * metre),
           (arm - 350 * metre, y1 - 200 * metre), (arm - 350 * metre, shore), (x0, shore)]  # fmt: skip
    openness = open_water(Drawing.polygon(sea, pond), frame)
    places = [(0.5, y1 - 400 * metre), (0.5, y0 + 500 * metre), (arm, y1 - 500 * metre)]
    assert openness_at(openness, frame, np.array(places)).tolist() == [0.0, 1.0, 1.0]


def test_the_end_of_a_model_in_the_sea_is_no_shore():
    """A coast in the north, and a model that ends in deep water, in the south and at its sides."""
    frame = Frame(BOUNDS, CRS, (12_000.0, 6000.0))
    rows, columns = 128, 256
    y, x = np.mgrid[:rows, :columns] + 0.5
    known = (np.abs(x - 128) < 90) & (y < 72)
    bed = np.where(known, 0.3 * (30.0 - y), np.nan).astype(np.float32)
    depth = np.maximum(-bed, 0.0)
    x0, y0, x1, y1 = frame.box
    right, up = (x1 - x0) / columns, (y1 - y0) / rows
    west, east, south, shore = x0 + 38 * right, x0 + 218 * right, y1 - 71.5 * up, y1 - 30 * up
    sea = Drawing.polygon([(west, south), (east, south), (east, shore), (west, shore)])
    extent = Extent(frame, (Step(sea, depth=depth),), bed)
    relief, found = surfaces(extent)
    beyond = beyond_of(extent, relief)
    assert beyond[-20:].all()
    assert not beyond[:25].any()
    openness = open_water(sea, frame, sea, beyond)
    waves = calm_waves(openness, frame, beyond)
    places = np.array([(0.5, shore - up), (0.5, south + up), (east - right, 0.5)])
    assert openness_at(waves, frame, places).tolist() == [1.0, 0.0, 0.0]
    views = {view.name: view for view in views_of(extent, openness, highest_of(found), beyond)}
    for name in ("Coast", "Shore", "Beach"):
        assert views[name].toward[1] < -0.9, name
        assert views[name].place[1] == pytest.approx(shore, abs=3 * up), name
    picture = np.asarray(drawn_ground(extent, relief)).astype(int)
    end = picture[int(0.5 * len(picture)) :, 300:700]  # from within the water
    assert (end[..., 2] > end[..., 0] - 12).all()  # the bottom of the sea, no sand and no grass
    assert (end[..., 1] < 140).all()


def test_waves_do_not_get_over_a_dike():
    """A polder of 25 km, which the sea floods through a gap: waves in the gap and before the dike, not behind it."""
    frame = Frame(BOUNDS, CRS, (24_000.0, 12_000.0))
    x0, y0, x1, y1 = frame.box
    metre = (x1 - x0) / 24_000.0
    shore, gap = y0 + 5000 * metre, 200 * metre
    sea = [(x0, y0), (x1, y0), (x1, shore), (x0, shore)]
    inside = shore + 250 * metre
    flooded = [*sea[:3], (0.5 + gap, shore), (0.5 + gap, inside), (x1, inside), (x1, y1), (x0, y1), (x0, inside),
               (0.5 - gap, inside), (0.5 - gap, shore), (x0, shore)]  # fmt: skip
    before, behind = (0.2, shore - 50 * metre), (0.2, inside + 100 * metre)
    beach = (0.2, shore + 50 * metre)
    places = np.array([before, beach, behind, (0.5, inside)])
    alone = openness_at(open_water(Drawing.polygon(sea), frame), frame, places)
    assert alone.min() > 0.05  # the sea may rise over whatever lies there
    at = openness_at(open_water(Drawing.polygon(sea), frame, Drawing.polygon(flooded)), frame, places)
    assert at.tolist() == [alone[0], alone[1], 0.0, alone[3]]
