"""Raster textures: filters against closed formulas and against the GPU's own."""

import math

import numpy as np
import pytest

from vexture.base.errors import DeviceError, ParameterError
from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact
from vexture.renderers.view import fit
from vexture_evidence.measures.raster import RasterTexture, bilinear, footprint, mip_sides, raster_from
from vexture_evidence.measures.shape import ConvertedDrawing, example

TRIANGLE = Drawing.polygon([(0.1, 0.2), (0.9, 0.3), (0.4, 0.8)])
RECEDING = np.array([[0.01, 0.0, -0.1], [0.0, -0.01, 1.1], [0.0, 0.004, 1.0]])


def ramp(side):
    """Texels whose values are linear in the place of their centres."""
    down, right = np.indices((side, side))
    return (3 * right + 2 * down).astype(np.uint8)


def test_between_texels_a_linear_picture_stays_linear():
    u, v = np.random.default_rng(1).uniform(0.1, 0.9, (2, 100))  # within the outermost centres
    expected = 3 * (16 * u - 0.5) + 2 * (16 * (1 - v) - 0.5)
    np.testing.assert_allclose(bilinear(ramp(16), u, v), expected, atol=1e-9)


def test_half_a_texel_beyond_the_square_there_is_nothing_or_the_edge():
    full = np.full((4, 4), 200, np.uint8)
    u, v = np.array([-0.125, 0.0, 0.5, 1.2]), np.full(4, 0.5)
    np.testing.assert_allclose(bilinear(full, u, v), [0.0, 100.0, 200.0, 0.0])
    np.testing.assert_allclose(bilinear(full, u, v, frame=False), 200.0)


@pytest.mark.parametrize(("pixels", "expected"), [(9, 0.0), (8, 0.0), (4, 50.0), (3, 50.0 + 50.0 * math.log2(4 / 3))])
def test_levels_blend_by_the_logarithm_of_the_pixel(pixels, expected):
    levels = [np.full((side, side), value, np.uint8) for side, value in ((8, 0), (4, 50), (2, 100), (1, 150))]
    shown = RasterTexture(levels[0], tuple(levels[1:])).sample((pixels, pixels))
    middle = shown[pixels // 2, pixels // 2]  # away from the border, at which coarse levels fade out
    assert middle * 255 == pytest.approx(expected, abs=1e-3)


def test_steps_of_a_receding_view_are_its_derivatives():
    place, step = footprint((100, 80), RECEDING), 1e-4
    for row, column in ((3, 5), (70, 90)):
        x, y = column + 0.5, row + 0.5

        def at(x, y):
            p, q, w = RECEDING @ (x, y, 1.0)
            return np.array([p, q]) / w

        steps = [(at(x + dx, y + dy) - at(x - dx, y - dy)) / (2 * step) for dx, dy in ((step, 0), (0, step))]
        assert place.reach[row, column] == pytest.approx(max(np.linalg.norm(one) for one in steps), rel=1e-6)
        np.testing.assert_allclose((place.u[row, column], place.v[row, column]), at(x, y))


def test_beyond_the_horizon_nothing_is_seen():
    horizon = np.array([[0.01, 0.0, 0.0], [0.0, -0.01, 0.9], [0.0, 0.02, -1.0]])  # rows above 50 look away
    texture = RasterTexture(np.full((4, 4), 255, np.uint8))
    assert not texture.sample((100, 100), horizon)[:50].any()
    assert footprint((100, 100), horizon).visible[51:].all()


def test_texels_are_exact_coverage_at_every_level():
    texture = raster_from(TRIANGLE, 20)
    assert [level.shape[0] for level in texture.mips] == mip_sides(20)
    for level in (texture.texels, *texture.mips):
        assert np.abs(level / 255 - render_exact(TRIANGLE, level.shape)).max() <= 0.5 / 255 + 1e-6


def test_in_line_with_the_pixels_a_texel_is_a_pixel():
    texture = raster_from(TRIANGLE, 32)
    np.testing.assert_allclose(texture.sample((32, 32)) * 255, texture.texels, atol=1e-4)
    np.testing.assert_allclose(texture.sample((8, 8)) * 255, texture.mips[1], atol=1e-4)
    assert np.abs(texture.sample((8, 8), mip=False) * 255 - texture.mips[1]).max() > 20


def test_bytes_are_those_of_all_levels_and_of_the_file():
    texture = raster_from(TRIANGLE, 64)
    assert texture.nbytes == sum(4**level for level in range(7))
    assert raster_from(TRIANGLE, 64, mips=False).nbytes == 64 * 64
    assert 100 < texture.png_bytes < 64 * 64 / 2


def test_size_out_of_range_is_said():
    with pytest.raises(ParameterError, match="16384"):
        raster_from(TRIANGLE, 0)


@pytest.mark.parametrize("view", [None, RECEDING], ids=["fit", "receding"])
def test_the_gpu_filters_alike(view):
    """Within what 8 fraction bits, approximate logarithms and the driver's own mip-map make of it."""
    from vexture_evidence.measures.programs import IMAGE_SIDE, fetch_program

    duck = ConvertedDrawing(example("duck")).drawing
    size = (100, 80)
    try:
        theirs = fetch_program(duck).image(size, fit(size) if view is None else view)
    except DeviceError as error:
        pytest.skip(str(error))
    place = footprint(size, view)
    inside = (abs(place.u - 0.5) < 0.5) & (abs(place.v - 0.5) < 0.5)  # their texture repeats
    off = np.abs(theirs - raster_from(duck, IMAGE_SIDE).sample(size, view))[inside]
    assert off.mean() < 0.004
    assert np.quantile(off, 0.99) < 0.08
