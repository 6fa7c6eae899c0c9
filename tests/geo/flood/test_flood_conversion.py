"""Pictures of depths: what the page reads of them is as exact as it says."""

from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from vexture_geo.base.depth_ranges import DepthRange
from vexture_geo.base.extent import DepthClasses
from vexture_geo.flood.conversion import CODE, deepest, depth_png, ranges_as_json, ranks_png


def seen(png):
    return np.asarray(Image.open(BytesIO(png)))


def read(depth):
    """Depths as the page reads them."""
    return CODE["scale"] * np.sinh(seen(depth_png(depth)).astype(float) * CODE["step"])


def test_shallow_water_beside_a_deep_sea_has_its_own_depth():
    depth = np.array([[0.01, 0.05, 0.27, 0.59, 1.0, 3.3, 20.0, 202.0, 11_000.0]], np.float32)
    np.testing.assert_allclose(read(depth), depth, rtol=1e-4, atol=0.003)


def test_dry_and_unknown_places_are_0_and_any_film_of_water_is_not():
    depth = np.array([[np.nan, 0.0, -1.0, 1e-4]], np.float32)
    assert seen(depth_png(depth)).tolist() == [[0, 0, 0, 1]]
    assert deepest(np.full((2, 2), np.nan, np.float32)) == 0.0


def test_large_grids_are_thinned_without_mixing_depths():
    depth = np.tile(np.array([0.0, 8.0], np.float32), (600, 600))
    found = read(depth)
    assert found.shape == (120, 240)
    assert set(np.round(found, 2).ravel()) <= {0.0, 8.0}


def test_classes_are_ranks_and_ranges():
    ranks = np.array([[0, 1, 2]], np.uint8)
    classes = DepthClasses((DepthRange(0.5, 1.0), DepthRange(1.0, np.inf)), ranks)
    assert seen(ranks_png(classes)).tolist() == ranks.tolist()
    assert ranges_as_json(classes) == [[0.5, 1.0], [1.0, None]]


@pytest.mark.parametrize("shape", [(171, 256), (1, 1)])
def test_small_pictures_are_as_large_as_their_grids(shape):
    assert seen(depth_png(np.ones(shape, np.float32))).shape == shape
