"""The relief: heights of the data, or invented ones."""

import numpy as np
import pytest
import rasterio
from floods import BOUNDS, FRAME, geotiff, west

from vexture.base.errors import SourceError
from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Extent, Step
from vexture_geo.flood.relief import relief_of


def test_bed_gives_the_relief_and_the_still_water_is_its_zero():
    bed = np.tile(np.linspace(5.0, 15.0, 40, dtype=np.float32), (20, 1))
    relief = relief_of(Extent(FRAME, (Step(Drawing(())), Step(west(0.5))), bed))
    assert not relief.invented
    np.testing.assert_allclose(relief.heights[:, [0, 128, 256]], np.tile([-5.0, 0.0, 5.0], (128, 1)), atol=0.15)


def test_relief_says_how_much_of_the_ground_it_knows(tmp_path):
    left, south, right, north = BOUNDS
    bed = np.tile(np.linspace(5.0, 15.0, 40, dtype=np.float32), (20, 1))
    half = geotiff(tmp_path / "half.tif", bed, bounds=((left + right) / 2, south, right, north))
    relief = relief_of(Extent(FRAME, (Step(west(0.25)),)), half)
    assert relief.known == pytest.approx(0.75, abs=0.02)


def test_heights_are_metres_whatever_their_unit_and_packing(tmp_path):
    metres = np.tile(np.linspace(8.0, 16.0, 80), (40, 1))
    dry = Extent(FRAME, (Step(Drawing(())),))
    in_feet = geotiff(tmp_path / "feet.tif", (metres / 0.3048).astype("f4"))
    packed = geotiff(tmp_path / "packed.tif", np.rint(100.0 * (metres - 5.0)).astype("i2"))
    other = geotiff(tmp_path / "other.tif", metres.astype("f4"))
    for path, facts in ((in_feet, ("ft", 1.0, 0.0)), (packed, ("m", 0.01, 5.0)), (other, ("psu", 1.0, 0.0))):
        with rasterio.open(path, "r+") as file:
            (file.units, file.scales, file.offsets) = ((fact,) for fact in facts)
    for path in (in_feet, packed):
        relief = relief_of(dry, path)
        assert relief.still == pytest.approx(8.0, abs=0.02)
        assert np.ptp(relief.heights) == pytest.approx(8.0, abs=0.02)
    with pytest.raises(SourceError, match="its values are in 'psu', no unit of length that is known"):
        relief_of(dry, other)
