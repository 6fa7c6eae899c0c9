"""Light of filters on surfaces, against the kernels of the specification and closed forms."""

from itertools import product
from math import cos, radians, sin, sqrt

import numpy as np
import pytest

from vexture.svg.filter_frame import PixelFrame
from vexture.svg.filter_lighting import RIM, light, surface_slopes
from vexture.svg.filter_operations import DistantLight, Lighting, LightSource, PointLight, SpotLight

FRAME = PixelFrame(0.0, 0.0, 1.0, 1.0, 9, 8)
WHITE = (1.0, 1.0, 1.0)


def opaque(height: np.ndarray) -> np.ndarray:
    """Pixels with these opacities."""
    return np.concatenate([np.zeros((*height.shape, 3)), height[..., None]], axis=2)


def shine(
    height: np.ndarray,
    source: LightSource,
    frame: PixelFrame = FRAME,
    color: tuple[float, ...] = WHITE,
    **options: float,
) -> np.ndarray:
    lighting = Lighting(source, WHITE, **options)
    return light(opaque(height), frame, lighting, (color[0], color[1], color[2]), frame.bounds)


KERNELS = {  # the specification's table for x: factor, and the rows of the kernel; by top or bottom, left or right
    (-1, -1): (2 / 3, [[0, 0, 0], [0, -2, 2], [0, -1, 1]]),
    (-1, 0): (1 / 3, [[0, 0, 0], [-2, 0, 2], [-1, 0, 1]]),
    (-1, 1): (2 / 3, [[0, 0, 0], [-2, 2, 0], [-1, 1, 0]]),
    (0, -1): (1 / 2, [[0, -1, 1], [0, -2, 2], [0, -1, 1]]),
    (0, 0): (1 / 4, [[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]]),
    (0, 1): (1 / 2, [[-1, 1, 0], [-2, 2, 0], [-1, 1, 0]]),
    (1, -1): (2 / 3, [[0, -1, 1], [0, -2, 2], [0, 0, 0]]),
    (1, 0): (1 / 3, [[-1, 0, 1], [-2, 0, 2], [0, 0, 0]]),
    (1, 1): (2 / 3, [[-1, 1, 0], [-2, 2, 0], [0, 0, 0]]),
}


@pytest.mark.parametrize("is_turned", [False, True])
def test_slopes_are_those_of_the_nine_kernels(is_turned: bool) -> None:
    height = np.random.default_rng(1).random((9, 8))
    lengths = (1.0, 1.0)
    slopes = surface_slopes(height, FRAME, lengths, FRAME.bounds)[int(is_turned)]
    if is_turned:  # the kernels for y are those for x with rows and columns exchanged
        height, slopes = height.T, slopes.T
    rows, columns = height.shape
    padded = np.pad(height, 1)
    for row, column in product(range(rows), range(columns)):
        side = (row == rows - 1) - (row == 0), (column == columns - 1) - (column == 0)
        factor, kernel = KERNELS[side]
        expected = factor * (np.array(kernel) * padded[row : row + 3, column : column + 3]).sum()
        assert slopes[row, column] == pytest.approx(expected)


def test_distances_of_slopes_are_in_user_units() -> None:
    frame = PixelFrame(3.0, -2.0, 0.25, 0.5, 20, 40)
    plane = 0.1 * frame.xs + 0.05 * frame.ys[:, None]
    for lengths in [(0.25, 0.5), (1.0, 1.0), (0.1, 0.3), (1.7, 2.3)]:
        across, down = surface_slopes(plane, frame, lengths, frame.bounds)
        middle = slice(6, -6)
        np.testing.assert_allclose(across[middle, 8:-8], 0.2)  # twice the slope, as the specification has it
        np.testing.assert_allclose(down[middle, 8:-8], 0.1)


def test_edges_within_the_pixels_count_as_edges() -> None:
    height = np.random.default_rng(2).random((9, 8))
    inner = surface_slopes(height, FRAME, (1.0, 1.0), (2.0, 1.0, 7.0, 8.0))
    alone = surface_slopes(height[1:8, 2:7], PixelFrame(2.0, 1.0, 1.0, 1.0, 7, 5), (1.0, 1.0), (2.0, 1.0, 7.0, 8.0))
    for a, b in zip(inner, alone, strict=True):
        np.testing.assert_allclose(a[1:8, 2:7], b)


def test_a_surface_of_one_pixel_is_flat() -> None:
    frame = PixelFrame(0.0, 0.0, 1.0, 1.0, 1, 1)
    across, down = surface_slopes(np.array([[0.7]]), frame, (1.0, 1.0), frame.bounds)
    assert (across[0, 0], down[0, 0]) == (0.0, 0.0)


def test_a_flat_surface_has_the_light_of_the_elevation() -> None:
    found = shine(np.full((9, 8), 0.6), DistantLight(77.0, 30.0), color=(1.0, 0.5, 0.0), constant=1.2)
    np.testing.assert_allclose(found, np.broadcast_to((0.6, 0.3, 0.0, 1.0), found.shape))


def test_a_plane_has_one_normal() -> None:
    plane = 0.05 * FRAME.xs + 0.08 * FRAME.ys[:, None]
    normal = np.array([-2.0 * 3.0 * 0.05, -2.0 * 3.0 * 0.08, 1.0])
    normal /= np.linalg.norm(normal)
    azimuth, elevation = radians(200.0), radians(40.0)
    ray = np.array([cos(azimuth) * cos(elevation), sin(azimuth) * cos(elevation), sin(elevation)])
    found = shine(plane, DistantLight(200.0, 40.0), surface_scale=3.0)
    np.testing.assert_allclose(found[..., :3], normal @ ray)
    halfway = ray + np.array([0.0, 0.0, 1.0])
    halfway /= np.linalg.norm(halfway)
    bright = shine(plane, DistantLight(200.0, 40.0), surface_scale=3.0, constant=0.8, exponent=5.0)
    np.testing.assert_allclose(bright, 0.8 * (normal @ halfway) ** 5)


def test_a_light_from_behind_is_dark() -> None:
    assert not shine(np.zeros((9, 8)), DistantLight(0.0, -30.0))[..., :3].any()


def test_a_point_light_shines_from_its_place() -> None:
    frame = PixelFrame(-4.0, -4.5, 1.0, 1.0, 9, 8)
    found = shine(np.full((9, 8), 0.5), PointLight((1.0, -2.0, 3.0)), frame, surface_scale=2.0)
    for row, column in product(range(9), range(8)):
        x, y, z = 1.0 - frame.xs[column], -2.0 - frame.ys[row], 3.0 - 2.0 * 0.5
        assert found[row, column, 0] == pytest.approx(z / sqrt(x * x + y * y + z * z))


def test_highlights_are_as_opaque_as_they_are_bright() -> None:
    height = np.random.default_rng(3).random((9, 8))
    found = shine(height, PointLight((3.0, 3.0, 4.0)), color=(0.2, 0.9, 0.4), exponent=7.0, surface_scale=0.5)
    np.testing.assert_allclose(found[..., 3], found[..., 1])
    np.testing.assert_allclose(found[..., 0], found[..., 1] * 0.2 / 0.9)


def test_a_spot_light_has_an_axis_and_a_cone() -> None:
    frame = PixelFrame(-20.0, -0.5, 1.0, 1.0, 1, 40)
    open_light = shine(np.zeros((1, 40)), SpotLight((0.0, 0.0, 10.0), (5.0, 0.0, 0.0), 3.0), frame)[0, :, 0]
    cut_light = shine(np.zeros((1, 40)), SpotLight((0.0, 0.0, 10.0), (5.0, 0.0, 0.0), 3.0, -20.0), frame)[0, :, 0]
    for column, x in enumerate(frame.xs.tolist()):
        cosine = (5.0 * x + 100.0) / sqrt(125.0 * (x * x + 100.0))
        expected = 10.0 / sqrt(x * x + 100.0) * max(cosine, 0.0) ** 3
        assert open_light[column] == pytest.approx(expected)
        rim = min(max((cosine - cos(radians(20.0))) / RIM, 0.0), 1.0)
        assert cut_light[column] == pytest.approx(expected * rim)
    assert 0 < np.count_nonzero(cut_light) < np.count_nonzero(open_light)


def test_a_cone_is_at_most_a_half_space() -> None:
    frame = PixelFrame(-20.0, -0.5, 1.0, 1.0, 1, 40)
    spots = (SpotLight((0.0, 0.0, 1.0), (5.0, 0.0, 1.0), 0.0, cone) for cone in (90.0, 300.0))
    half, more = (shine(np.zeros((1, 40)), spot, frame) for spot in spots)
    assert 0 < np.count_nonzero(half[..., 0]) < 40
    np.testing.assert_array_equal(more, half)


def test_a_spot_light_without_an_axis_is_dark() -> None:
    spot = SpotLight((1.0, 1.0, 1.0), (1.0, 1.0, 1.0))
    assert not shine(np.zeros((9, 8)), spot)[..., :3].any()


@pytest.mark.parametrize("exponent", [None, -1e300, 0.0, 1e300])
@pytest.mark.parametrize("scale", [-1e308, 0.0, 1e308])
def test_hostile_parameters_yield_colours(exponent: float | None, scale: float) -> None:
    height = np.random.default_rng(3).random((9, 8))
    far = (1e308, -1e308, 1e308)
    sources = [DistantLight(1e300, -1e300), PointLight(far), SpotLight(far, (-1e308, 0.0, 0.0), 1e300, 1e300)]
    for source in [*sources, PointLight((0.5, 0.5, 0.0))]:
        for lengths in [(1.0, 1.0), (1e-300, 1e300)]:
            lighting = Lighting(source, WHITE, scale, scale, exponent, lengths)
            found = light(opaque(height), FRAME, lighting, WHITE, FRAME.bounds)
            assert (found >= 0.0).all()
            assert (found <= 1.0).all()
