import math

import numpy as np
import pytest

from vexture.renderers.exact import render_exact
from vexture_evidence.measures.plane import RADIUS, dots, receding, view_of_plane


@pytest.mark.parametrize("tiles", [1, 5])
def test_dots_fill_what_circles_fill(tiles):
    image = render_exact(dots(tiles), (tiles, tiles))
    np.testing.assert_allclose(image, math.pi * RADIUS**2, rtol=4e-4)


def test_the_plane_recedes():
    size = (100, 60)
    x, y, w = np.einsum(
        "ij,jn->in", view_of_plane(size), np.stack([np.full(60, 50.0), np.arange(60) + 0.5, np.ones(60)])
    )
    depth = np.diff(y / w)
    assert (depth < 0).all()
    assert (np.diff(np.abs(depth)) < 0).all()
    np.testing.assert_allclose(x / w, 0.5)


def test_raster_textures_alias_or_blur_where_ours_does_not():
    found = receding((120, 50), 12)
    errors = {name: error.mae for name, error in found.rendered.errors.items()}
    assert errors["packed"] < 2
    assert 4 * errors["packed"] < errors["sampled"]
    assert 2 * errors["sampled"] < min(errors["raster"], errors["raster, mip-mapped"])
    assert 0.98 * found.nbytes["packed"] < found.nbytes["raster, mip-mapped"] <= found.nbytes["packed"]
    assert found.nbytes["raster"] == found.raster_side**2
    far = {name: image[:4].std() for name, image in found.rendered.images.items()}
    assert far["raster, mip-mapped"] < 0.5 * far["raster"]
