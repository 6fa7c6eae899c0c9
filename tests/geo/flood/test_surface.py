"""The surface of the water: its levels, on slopes, in ponds and beside the shore."""

from io import BytesIO

import numpy as np
import pytest
from floods import FRAME, HMIN, depths, series, surfaces
from PIL import Image

from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Extent, Step
from vexture_geo.flood.relief import Relief
from vexture_geo.flood.surface import WaterSurface, highest_of, surface_of
from vexture_geo.readers import read_extent


def middles(grid, size):
    """Values of a grid of cells at the samples of the relief, of the nearest cell."""
    rows, columns = grid.shape
    row = np.clip(np.rint(np.linspace(0, rows, size[0]) - 0.5), 0, rows - 1).astype(int)
    column = np.clip(np.rint(np.linspace(0, columns, size[1]) - 0.5), 0, columns - 1).astype(int)
    return grid[np.ix_(row, column)]


@pytest.mark.slow
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
