"""The water of a server on disk: a later start has the ground of the first, and refuses another flood."""

from dataclasses import replace

import numpy as np
import pytest
from floods import FRAME, west

from vexture.base.errors import DeviceError, ParameterError
from vexture.server.folder import STATE
from vexture.server.limits import Limits
from vexture_geo.base.extent import Extent, Frame, Step
from vexture_geo.flood.options import FloodOptions
from vexture_geo.flood.relief import Relief
from vexture_geo.flood.store import GROUND, RECORD, FloodStore

EXTENT = Extent(FRAME, (Step(west(0.5)),))
RELIEF = Relief(np.linspace(-2.0, 3.0, 12).reshape(3, 4), True, 0.75, 1.5)


def never():
    raise AssertionError("the ground is there already")


@pytest.fixture
def started(tmp_path):
    """A function that starts a server in one folder, for the relief that it has there."""

    def start(options=None, extent=EXTENT, make=never):
        store = FloodStore(tmp_path, Limits(), lambda line: None)
        try:
            return store.relief(options or FloodOptions(tmp_path / "sea.geojson"), extent, make)
        finally:
            store.release()

    start(make=lambda: RELIEF)
    return start


def test_a_later_start_has_the_ground_of_the_first(started):
    relief = started()
    np.testing.assert_array_equal(relief.heights, RELIEF.heights)
    assert (relief.invented, relief.known, relief.still) == (True, 0.75, 1.5)


def test_the_water_of_another_flood_is_refused_with_what_differs(started, tmp_path):
    options = FloodOptions(tmp_path / "sea.geojson")
    bounds = (0.0, 0.0, 4000.0, 2000.0)
    elsewhere = Extent(Frame(bounds, FRAME.crs, FRAME.metres), EXTENT.steps)
    with pytest.raises(ParameterError, match=r"its box is 500000,4000000,504000,4002000, here it is 0,0,4000,2000;"):
        started(extent=elsewhere)
    with pytest.raises(ParameterError, match=r"its depth from which it is wet is 0\.05, here it is 0\.1;"):
        started(replace(options, hmin=0.1))
    with pytest.raises(ParameterError, match=r"its ground is invented, here it is the bed of the data \("):
        started(extent=replace(EXTENT, bed=np.ones((2, 2), np.float32)))
    assert started(replace(options, amplitude=1.0)).still == 1.5  # which changes nothing that is kept


@pytest.mark.parametrize("name", [GROUND, RECORD])
def test_damage_is_named(started, tmp_path, name):
    (tmp_path / STATE / name).write_bytes(b"[]")
    with pytest.raises(DeviceError, match=f"{name}: is damaged"):
        started()
