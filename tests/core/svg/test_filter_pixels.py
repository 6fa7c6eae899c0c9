"""Filter primitives that act on each pixel by itself, against sums for one pixel."""

import numpy as np
import pytest

from vexture.drawing.group import Blend
from vexture.renderers.blend import lay
from vexture.svg.filter_frame import PixelFrame
from vexture.svg.filter_operations import IDENTITY, TransferCurve
from vexture.svg.filter_pixels import (
    blend,
    color_matrix,
    composite,
    convert_colors,
    flood,
    from_linear,
    limit_colors,
    map_colors,
    merge,
    straighten,
    to_linear,
    transfer,
    transfer_component,
)

OPERATORS = ("over", "in", "out", "atop", "xor", "lighter")


def random_pixels(seed: int, rows: int = 9, columns: int = 11) -> np.ndarray:
    """Premultiplied colours, among them opaque and transparent ones, black, white and grey."""
    random = np.random.default_rng(seed)
    straight = random.random((rows, columns, 4))
    straight[random.random((rows, columns)) < 0.2, 3] = 0.0
    straight[random.random((rows, columns)) < 0.2, 3] = 1.0
    for value in (0.0, 0.5, 1.0):
        straight[random.random((rows, columns)) < 0.1, :3] = value
    straight[..., :3] *= straight[..., 3:]
    return straight


ABOVE, BELOW = random_pixels(1), random_pixels(2)


@pytest.mark.parametrize("mode", list(Blend), ids=lambda mode: mode.name)
def test_blend_modes_are_those_of_the_exact_renderer(mode: Blend) -> None:
    blended = blend(ABOVE, BELOW, mode)
    for place in np.ndindex(ABOVE.shape[:2]):
        expected = BELOW[place].copy()
        lay(ABOVE[place], 1.0, int(mode), expected)
        expected[:3] = np.minimum(expected[:3], expected[3])
        np.testing.assert_allclose(blended[place], expected, atol=1e-7)


@pytest.mark.parametrize("operator", OPERATORS)
def test_operators_are_those_of_porter_and_duff(operator: str) -> None:
    parts = {  # shares of what lies above and of what lies below
        "over": lambda a, b: (1.0, 1.0 - a),
        "in": lambda a, b: (b, 0.0),
        "out": lambda a, b: (1.0 - b, 0.0),
        "atop": lambda a, b: (b, 1.0 - a),
        "xor": lambda a, b: (1.0 - b, 1.0 - a),
        "lighter": lambda a, b: (1.0, 1.0),
    }
    found = composite(ABOVE, BELOW, operator)
    for place in np.ndindex(ABOVE.shape[:2]):
        above, below = parts[operator](ABOVE[place][3], BELOW[place][3])
        np.testing.assert_allclose(found[place], np.minimum(1.0, above * ABOVE[place] + below * BELOW[place]))


def test_arithmetic_is_limited_to_colours() -> None:
    found = composite(ABOVE, BELOW, "arithmetic", (1.5, -0.5, 0.7, 0.1))
    sums = 1.5 * ABOVE * BELOW - 0.5 * ABOVE + 0.7 * BELOW + 0.1
    np.testing.assert_allclose(found[..., 3], sums[..., 3].clip(0.0, 1.0))
    np.testing.assert_allclose(found[..., 0], np.minimum(sums[..., 0].clip(0.0, 1.0), found[..., 3]))
    assert np.isfinite(composite(ABOVE, BELOW, "arithmetic", (1e308, -1e308, 1e308, 1e308))).all()


def test_merge_is_over_from_the_bottom() -> None:
    third = random_pixels(3)
    expected = composite(third, composite(ABOVE, BELOW, "over"), "over")
    np.testing.assert_allclose(merge([BELOW, ABOVE, third]), expected)
    assert merge([BELOW]) is BELOW


def test_linear_light_is_that_of_srgb() -> None:
    assert to_linear(np.array(0.5)) == pytest.approx(0.21404114)
    assert to_linear(np.array(0.04)) == pytest.approx(0.04 / 12.92)
    values = np.linspace(0.0, 1.0, 1001)
    np.testing.assert_allclose(from_linear(to_linear(values)), values, atol=1e-6)
    converted = convert_colors(ABOVE, to_linear)
    np.testing.assert_array_equal(converted[..., 3], ABOVE[..., 3])
    np.testing.assert_allclose(straighten(converted)[..., :3], to_linear(straighten(ABOVE)[..., :3]), atol=1e-12)
    np.testing.assert_allclose(convert_colors(converted, from_linear), ABOVE, atol=1e-6)
    shadow = ABOVE * (0.0, 0.0, 0.0, 1.0)
    assert convert_colors(shadow, to_linear) is shadow


def test_a_matrix_acts_on_colours_that_are_not_premultiplied() -> None:
    numbers = np.random.default_rng(4).normal(0.2, 0.5, 20)
    found = color_matrix(ABOVE, numbers.tolist())
    matrix = numbers.reshape(4, 5)
    for place in np.ndindex(ABOVE.shape[:2]):
        red, green, blue, alpha = ABOVE[place]
        straight = [c / alpha if alpha else 0.0 for c in (red, green, blue)]
        *colors, opacity = np.clip(matrix @ [*straight, alpha, 1.0], 0.0, 1.0)
        np.testing.assert_allclose(found[place], [*(c * opacity for c in colors), opacity], atol=1e-12)
    np.testing.assert_allclose(color_matrix(ABOVE, IDENTITY), ABOVE, atol=1e-12)
    assert np.isfinite(color_matrix(ABOVE, [1e308, -1e308] * 10)).all()


def test_any_function_of_colours_acts_on_colours_that_are_not_premultiplied() -> None:
    found = map_colors(ABOVE, lambda colors: colors[:, [1, 2, 0, 3]] * (1.0, 1.0, 2.0, 0.5))
    colors = straighten(ABOVE)
    np.testing.assert_allclose(found[..., 3], 0.5 * ABOVE[..., 3])
    np.testing.assert_allclose(found[..., 0], colors[..., 1] * found[..., 3])
    np.testing.assert_allclose(found[..., 2], np.minimum(1.0, 2.0 * colors[..., 0]) * found[..., 3])


@pytest.mark.parametrize(
    ("curve", "places", "values"),
    [
        (TransferCurve(), [0.0, 0.3, 1.0], [0.0, 0.3, 1.0]),
        (TransferCurve("table"), [0.0, 0.3, 1.0], [0.0, 0.3, 1.0]),
        (TransferCurve("table", (0.7,)), [0.0, 0.3, 1.0], [0.7, 0.7, 0.7]),
        (TransferCurve("table", (0.0, 1.0, 0.2, 0.4)), [0.0, 0.5, 5 / 6, 1.0], [0.0, 0.6, 0.3, 0.4]),
        (
            TransferCurve("discrete", (0.1, 0.9, 0.5)),
            [0.0, 0.33, 0.34, 0.66, 0.67, 1.0],
            [0.1, 0.1, 0.9, 0.9, 0.5, 0.5],
        ),
        (TransferCurve("linear", slope=2.0, intercept=-0.5), [0.0, 0.5, 1.0], [-0.5, 0.5, 1.5]),
        (TransferCurve("gamma", slope=2.0, intercept=0.1, exponent=2.0), [0.0, 0.5, 1.0], [0.1, 0.6, 2.1]),
    ],
    ids=lambda value: value.kind if isinstance(value, TransferCurve) else "",
)
def test_curves_have_known_values(curve: TransferCurve, places: list[float], values: list[float]) -> None:
    np.testing.assert_allclose(transfer_component(np.array(places), curve), values, atol=1e-12)


def test_curves_act_on_channels_that_are_not_premultiplied() -> None:
    half, gone = TransferCurve("linear", slope=0.5), TransferCurve("discrete", (0.0,))
    found = transfer(ABOVE, (half, TransferCurve(), gone, half))
    np.testing.assert_allclose(found[..., 3], 0.5 * ABOVE[..., 3])
    np.testing.assert_allclose(found[..., 0], 0.25 * ABOVE[..., 0], atol=1e-12)
    np.testing.assert_allclose(found[..., 1], 0.5 * ABOVE[..., 1], atol=1e-12)
    assert not found[..., 2].any()


def test_hostile_curves_yield_colours() -> None:
    for exponent in (-1e300, -3.0, 0.0, 1e300):
        for slope in (-1e308, 1e308):
            curve = TransferCurve("gamma", slope=slope, exponent=exponent, intercept=-slope)
            found = transfer(ABOVE, (curve,) * 4)
            assert (found >= 0.0).all()
            assert (found <= 1.0).all()


def test_colours_are_limited_to_the_opacity() -> None:
    assert limit_colors(np.array([[[0.9, -1.0, np.nan, 0.5]]])).tolist() == [[[0.5, 0.0, 0.0, 0.5]]]


def test_a_flood_is_premultiplied() -> None:
    frame = PixelFrame(0.0, 0.0, 1.0, 1.0, 2, 3)
    assert flood(frame, (1.0, 0.5, 0.0, 0.5)).tolist() == [[[0.5, 0.25, 0.0, 0.5]] * 3] * 2
