"""The ground that is drawn where there is no picture."""

import numpy as np
from floods import FRAME, west

from vexture_geo.base.extent import Extent, Step
from vexture_geo.flood.ground import DRAWN, drawn_ground
from vexture_geo.flood.relief import relief_of


def test_drawn_ground_tells_land_from_sea():
    extent = Extent(FRAME, (Step(west(0.5)),))
    relief = relief_of(extent)
    picture = drawn_ground(extent, relief)
    assert picture.size == (DRAWN, DRAWN // 2)
    red_, _, blue = np.asarray(picture).astype(float).mean(axis=0).T
    assert (blue[: DRAWN // 3] > red_[: DRAWN // 3]).all()
    assert (red_[DRAWN // 2 + 8 :] > blue[DRAWN // 2 + 8 :]).all()
    assert relief.invented
    assert relief.heights[:, 0].max() < 0.0 < relief.heights[:, -1].min()
