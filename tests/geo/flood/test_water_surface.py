"""The surface of the water, where waves are, and what the page looks at."""

import importlib.util
import sys
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from floods import BOUNDS, CRS, depths, series
from PIL import Image

from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Extent, Frame, Step
from vexture_geo.flood.drawn_ground import drawn_ground
from vexture_geo.flood.grids import coverage_over
from vexture_geo.flood.open_water import calm_waves, open_water, openness_at
from vexture_geo.flood.relief import Relief, beyond_of, relief_of
from vexture_geo.flood.surface import WaterSurface, highest_of, surface_of
from vexture_geo.flood.views import viewpoint, views_of
from vexture_geo.readers import extent_of, read_extent

FRAME = Frame(BOUNDS, CRS, (4000.0, 2000.0))
HMIN = 0.05
EXAMPLE = Path(__file__).parents[3] / "examples" / "four_floods" / "make_floods.py"


@pytest.fixture(scope="module")
def floods(tmp_path_factory):
    """Extents of the four floods of the example, by name."""
    found = importlib.util.spec_from_file_location("four_floods", EXAMPLE)
    module = sys.modules["four_floods"] = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    folder = tmp_path_factory.mktemp("floods")
    paths = [module.write(make(), folder) for make in module.SCENES]
    return {path.stem: extent_of(path, str(path)) for path in paths}


def surfaces(extent):
    relief = relief_of(extent)
    return relief, [surface_of(step, extent.frame, relief, extent.bed, HMIN) for step in extent.steps]


def middles(grid, size):
    """Values of a grid of cells at the samples of the relief, of the nearest cell."""
    rows, columns = grid.shape
    row = np.clip(np.rint(np.linspace(0, rows, size[0]) - 0.5), 0, rows - 1).astype(int)
    column = np.clip(np.rint(np.linspace(0, columns, size[1]) - 0.5), 0, columns - 1).astype(int)
    return grid[np.ix_(row, column)]


@pytest.mark.parametrize("name", ["coast", "river", "polder", "streets"])
def test_water_stands_at_its_own_level_everywhere(floods, name):
    """Bed plus depth of the file, wherever it is wet: on the slope of a river, in ponds, behind a dike."""
    extent = floods[name]
    relief, found = surfaces(extent)
    for step, surface in zip(extent.steps[::4], found[::4], strict=True):
        depth = middles(step.depth, relief.heights.shape)
        wet = depth >= 0.3
        wanted = middles(extent.bed, relief.heights.shape) + depth - relief.still
        off = np.abs(surface.levels - wanted)[wet]
        assert np.isfinite(off).all()
        assert np.quantile(off, 0.98) < 0.06  # metres: between the middles of cells the level goes on


def test_levels_come_back_from_their_picture():
    levels = np.array([[np.nan, -1.5, 2.0], [0.25, np.nan, 20.0]])
    wet = np.array([[False, True, True], [True, False, False]])
    png, facts = WaterSurface(levels, wet).encode_png()
    numbers = np.asarray(Image.open(BytesIO(png))).astype(float)
    np.testing.assert_array_equal((numbers > 0) & (numbers < 32768), wet)
    back = np.where(numbers == 0, np.nan, facts["lowest"] + (numbers % 32768 - 1) * facts["unit"])
    np.testing.assert_allclose(back, levels, atol=facts["unit"] / 2 + 1e-12)
    assert facts["unit"] < 0.01


def test_a_dry_step_has_no_levels():
    relief = Relief(np.zeros((5, 9)), False)
    surface = surface_of(Step(Drawing(())), FRAME, relief, None, HMIN)
    assert np.isnan(surface.levels).all()
    assert highest_of([surface]) is None
    assert surface.encode_png()[1]["lowest"] == 0.0


def test_without_depths_water_is_as_high_as_its_shore():
    """A lake in a bowl of which the rim is 7 m high."""
    y, x = np.mgrid[1:-1:33j, -1:1:65j]
    relief = Relief(28.0 * (x**2 + y**2), False)
    turn = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    x0, y0, x1, y1 = FRAME.box
    lake = Drawing.polygon(
        [(0.5 + 0.25 * (x1 - x0) * np.cos(a), 0.5 + 0.25 * (y1 - y0) * np.sin(a)) for a in turn.tolist()]
    )
    levels = surface_of(Step(lake), FRAME, relief, None, HMIN).levels
    assert levels[16, 32] == pytest.approx(7.0, abs=0.8)
    assert np.isnan(levels[0, 0])


def test_the_surface_goes_on_a_little_into_the_land():
    """Where it is cut at the shore, it must not end before it."""
    relief = Relief(np.tile(np.linspace(-4.0, 4.0, 65), (33, 1)), False)
    x0, y0, _, y1 = FRAME.box
    sea = Drawing.polygon([(x0, y0), (0.5, y0), (0.5, y1), (x0, y1)])
    known = np.isfinite(surface_of(Step(sea), FRAME, relief, None, HMIN).levels[16])
    assert known[:35].all()
    assert not known[40:].any()


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


def test_heights_of_wide_cells_are_smooth_below_the_same_level(tmp_path):
    """A plane of 40 x 20 cells is a plane on the finer grid, but at its border; the water upon it is level."""
    extent = read_extent(series(tmp_path / "run.nc", [0.6]))
    bed, depth = extent.bed[100], extent.steps[0].depth[100]
    inner = slice(8, -8)
    np.testing.assert_allclose(np.diff(bed)[inner], np.diff(bed)[inner].mean(), rtol=1e-3)
    raw = np.tile(np.linspace(-2.0, 2.0, 40), (20, 1))
    coarse = raw[0] + depths(0.6)[0]
    cells = np.minimum((np.arange(len(bed)) + 0.5) / len(bed) * 40, 39).astype(int)
    wet = (depth > 0.0) & (depths(0.6)[0][cells] > 0.1)
    np.testing.assert_allclose((bed + depth)[wet], coarse[cells][wet], atol=1e-5)


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


def test_a_narrow_river_is_not_hidden_by_its_banks():
    """A ditch one cell wide, turned against the grid, under 1 m of water in ground 4 m above its bed."""
    rows, columns = 128, 256
    y, x = np.mgrid[:rows, :columns]
    middle = 40 + np.rint(0.2 * x)
    ditch = np.abs(y - middle) < 1
    bed = np.where(ditch, 0.0, 4.0).astype(np.float32)
    depth = np.where(ditch, 1.0, 0.0).astype(np.float32)
    x0, y0, x1, y1 = FRAME.box
    right, up = (x1 - x0) / columns, (y1 - y0) / rows
    squares = [[(x0 + c * right, y1 - r * up), (x0 + (c + 1) * right, y1 - r * up),
                (x0 + (c + 1) * right, y1 - (r + 1) * up), (x0 + c * right, y1 - (r + 1) * up)]
               for r, c in np.argwhere(ditch).tolist()]  # fmt: skip
    extent = Extent(FRAME, (Step(Drawing.polygon(*squares), depth=depth),), bed)
    relief, (surface,) = surfaces(extent)
    deep = (surface.levels - relief.heights)[surface.wet]
    assert len(deep) > 200
    assert np.median(deep) == pytest.approx(1.0, abs=0.02)
    assert (deep < 0.5).mean() < 0.02
    assert relief.heights.max() == pytest.approx(relief.heights[~surface.wet].max())  # the banks stay


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
