"""Whole filters as pixels: the graph, its regions and limits, and pictures of resvg."""

from dataclasses import replace

import numpy as np
import pytest
from svg_reference import render_file

from vexture.base.deadline import within
from vexture.base.errors import LimitError, SourceError
from vexture.drawing.group import Blend
from vexture.svg.filter_frame import PixelFrame, crop, shift
from vexture.svg.filter_noise import turbulence
from vexture.svg.filter_operations import (
    Blending,
    ColorMapping,
    ColorMatrix,
    ComponentTransfer,
    Convolution,
    Displacement,
    DistantLight,
    GaussianBlur,
    Lighting,
    Morphology,
    Operation,
    PorterDuff,
    RasterStep,
    Repetition,
    Shift,
    SolidColor,
    Stack,
    TransferCurve,
    Turbulence,
)
from vexture.svg.filter_pixels import blend, composite, convert_colors, from_linear, merge, to_linear
from vexture.svg.filter_raster import check_steps, evaluate, noise_samples
from vexture.svg.filter_windows import gaussian_blur, morphology

SIDE = 48
FRAME = PixelFrame(0.0, 0.0, 1.0, 1.0, SIDE, SIDE)
SHAPES = (
    '<rect x="8" y="10" width="20" height="22" fill="#e06020"/>'
    '<circle cx="30" cy="27" r="12.3" fill="#2050d0" fill-opacity=".7"/>'
)
GREEN = (0.0, 1.0, 0.0, 0.5)
HALF_OPAQUE = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5)


@pytest.fixture(scope="module")
def shapes() -> np.ndarray:
    return render_file(f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIDE}" height="{SIDE}">{SHAPES}</svg>')


def step(operation: Operation, *inputs: str, result: str = "", **options: object) -> RasterStep:
    return RasterStep(operation, inputs, result, **options)


def run(steps: list[RasterStep], source: np.ndarray, **options: object) -> np.ndarray:
    return evaluate(steps, {"SourceGraphic": source}, FRAME, **options)


MATRIX = (0.2, 0.5, 0.3, 0, 0.1, 0, 1, 0, 0, 0, 0.1, 0, 0.9, 0, 0, 0, 0.3, 0, 0.8, 0.05)
CURVES = (
    TransferCurve("table", (0.0, 0.8, 0.3, 1.0)),
    TransferCurve("discrete", (0.0, 0.4, 0.9)),
    TransferCurve("linear", slope=0.7, intercept=0.1),
    TransferCurve("gamma", slope=0.9, exponent=0.6, intercept=0.02),
)
FUNCTIONS = (
    '<feFuncR type="table" tableValues="0 .8 .3 1"/><feFuncG type="discrete" tableValues="0 .4 .9"/>'
    '<feFuncB type="linear" slope=".7" intercept=".1"/>'
    '<feFuncA type="gamma" amplitude=".9" exponent=".6" offset=".02"/>'
)
GREEN_RECTANGLE = '<feFlood flood-color="lime" flood-opacity=".5" x="5" y="5" width="25" height="30" result="a"/>'
FLOODED = step(SolidColor(GREEN), result="a", subregion=(5.0, 5.0, 30.0, 35.0))
BOTH = ("SourceGraphic", "a")

DRAWN: dict[str, tuple[str, list[RasterStep]]] = {
    "matrix": (
        f'<feColorMatrix values="{" ".join(map(str, MATRIX))}"/>',
        [step(ColorMatrix(MATRIX), "SourceGraphic")],
    ),
    "transfer": (
        f"<feComponentTransfer>{FUNCTIONS}</feComponentTransfer>",
        [step(ComponentTransfer(CURVES), "SourceGraphic")],
    ),
    "convolution": (
        '<feConvolveMatrix order="3" kernelMatrix="1 2 1 0 3 -2 1 0 1" edgeMode="none" bias=".2"/>',
        [
            step(
                Convolution((3, 3), (1.0, 2.0, 1.0, 0.0, 3.0, -2.0, 1.0, 0.0, 1.0), 0.0, 0.2, (1, 1), "none"),
                "SourceGraphic",
            )
        ],
    ),
    "light": (
        '<feDiffuseLighting in="SourceAlpha" surfaceScale="3" lighting-color="#ffe0a0">'
        '<feDistantLight azimuth="235" elevation="40"/></feDiffuseLighting>',
        [step(Lighting(DistantLight(235.0, 40.0), (1.0, 0xE0 / 255, 0xA0 / 255), 3.0), "SourceAlpha")],
    ),
    "shadow": (
        '<feGaussianBlur in="SourceAlpha" stdDeviation="1.5"/><feOffset dx="4" dy="3" result="o"/>'
        '<feFlood flood-color="#802000" flood-opacity=".8"/><feComposite in2="o" operator="in"/>'
        '<feMerge><feMergeNode/><feMergeNode in="SourceGraphic"/></feMerge>',
        [
            step(GaussianBlur((1.5, 1.5)), "SourceAlpha"),
            step(Shift(4.0, 3.0), "", result="o"),
            step(SolidColor((0x80 / 255, 0x20 / 255, 0.0, 0.8))),
            step(PorterDuff("in"), "", "o"),
            step(Stack(), "", "SourceGraphic"),
        ],
    ),
    "tile": (
        '<feOffset x="10" y="12" width="13" height="9"/><feTile/>',
        [step(Shift(0.0, 0.0), "SourceGraphic", subregion=(10.0, 12.0, 23.0, 21.0)), step(Repetition(), "")],
    ),
}
DRAWN |= {
    operator: (
        f'{GREEN_RECTANGLE}<feComposite in="SourceGraphic" in2="a" operator="{operator}" k1=".5" k2=".4" k3=".8" '
        'k4=".1"/>',
        [FLOODED, step(PorterDuff(operator, (0.5, 0.4, 0.8, 0.1)), *BOTH)],
    )
    for operator in ("over", "in", "out", "atop", "xor", "arithmetic")
}
DRAWN |= {
    mode.name: (
        f'{GREEN_RECTANGLE}<feBlend in="SourceGraphic" in2="a" mode="{mode.name.lower().replace("_", "-")}"/>',
        [FLOODED, step(Blending(mode), *BOTH)],
    )
    for mode in Blend
    if mode not in (Blend.PLUS_LIGHTER, Blend.LUMINOSITY)  # which resvg draws in another way than browsers
}


@pytest.mark.parametrize("name", DRAWN)
def test_resvg_draws_the_same_filters(name: str, shapes: np.ndarray) -> None:
    text, steps = DRAWN[name]
    drawn = render_file(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIDE}" height="{SIDE}"><filter id="f" x="0" y="0" '
        f'width="{SIDE}" height="{SIDE}" filterUnits="userSpaceOnUse" color-interpolation-filters="sRGB">{text}'
        f'</filter><g filter="url(#f)">{SHAPES}</g></svg>'
    )
    gap = 255.0 * np.abs(run([replace(each, is_linear=False) for each in steps], shapes) - drawn)
    assert gap.max() <= (9.0 if name == "shadow" else 2.0)  # its blur is an approximation
    assert gap.mean() <= 0.5


def test_a_filter_without_steps_hides_its_element(shapes: np.ndarray) -> None:
    assert not run([], shapes).any()


def test_the_opacity_of_the_source_is_an_input(shapes: np.ndarray) -> None:
    found = run([step(Shift(0.0, 0.0), "SourceAlpha")], shapes)
    np.testing.assert_array_equal(found, shapes * (0.0, 0.0, 0.0, 1.0))
    other = evaluate(
        [step(Shift(0.0, 0.0), "SourceAlpha")], {"SourceGraphic": shapes, "SourceAlpha": shapes[::-1]}, FRAME
    )
    np.testing.assert_array_equal(other, shapes[::-1])


def test_unknown_and_missing_inputs_are_the_previous_result(shapes: np.ndarray) -> None:
    blurred = [step(GaussianBlur((2.0, 2.0)), "SourceGraphic", result="a"), step(Shift(3.0, 0.0), "a")]
    expected = run(blurred, shapes)
    for names in (("",), ("nothing",), ()):
        np.testing.assert_array_equal(run([blurred[0], step(Shift(3.0, 0.0), *names)], shapes), expected)
    np.testing.assert_array_equal(run([step(Shift(0.0, 0.0), "nothing")], shapes), shapes)


def test_a_name_means_the_latest_result_before(shapes: np.ndarray) -> None:
    steps = [
        step(Shift(1.0, 0.0), "SourceGraphic", result="a"),
        step(Shift(2.0, 0.0), "a", result="a"),
        step(Shift(4.0, 0.0), "a"),
    ]
    np.testing.assert_allclose(run(steps, shapes), run([step(Shift(7.0, 0.0), "SourceGraphic")], shapes))


def test_a_stack_of_nothing_is_empty(shapes: np.ndarray) -> None:
    assert not run([step(Stack())], shapes).any()
    np.testing.assert_array_equal(run([step(Stack(), "SourceGraphic")], shapes), shapes)


def test_colours_are_mixed_in_the_space_of_the_step(shapes: np.ndarray) -> None:
    for is_linear in (False, True):
        found = run([step(GaussianBlur((3.0, 2.0)), "SourceGraphic", is_linear=is_linear)], shapes)
        source = convert_colors(shapes, to_linear) if is_linear else shapes
        blurred = gaussian_blur(source, FRAME, (3.0, 2.0))
        np.testing.assert_allclose(found, convert_colors(blurred, from_linear) if is_linear else blurred, atol=1e-9)
    grown = run([step(Morphology((2.0, 2.0), True), "SourceGraphic")], shapes)
    linear = morphology(convert_colors(shapes, to_linear), FRAME, (2.0, 2.0), True)
    np.testing.assert_allclose(grown, convert_colors(linear, from_linear), atol=1e-9)
    wide = run([step(Morphology((2.0, 2.0), True), "SourceGraphic", is_linear=False)], shapes)
    np.testing.assert_allclose(wide, morphology(shapes, FRAME, (2.0, 2.0), True))


def test_a_light_has_a_colour_in_srgb(shapes: np.ndarray) -> None:
    for is_linear in (False, True):
        light = Lighting(DistantLight(0.0, 90.0), (0.5, 0.2, 0.1), surface_scale=0.0)
        found = run([step(light, "SourceAlpha", is_linear=is_linear)], shapes)
        np.testing.assert_allclose(found, np.broadcast_to((0.5, 0.2, 0.1, 1.0), found.shape), atol=1e-6)


def test_a_displacement_reads_only_the_map_in_the_space_of_the_step(shapes: np.ndarray) -> None:
    grey = step(SolidColor((0.5, 0.5, 0.5, 1.0)), result="a")
    for is_linear, red in ((False, 0.5), (True, 0.21404114)):
        found = run([grey, step(Displacement(10.0, (0, 3)), *BOTH, is_linear=is_linear)], shapes)
        np.testing.assert_allclose(found, shift(shapes, FRAME, 10.0 * (0.5 - red), -5.0), atol=1e-6)


def test_a_flood_is_in_srgb_and_blends_in_the_space_of_the_step(shapes: np.ndarray) -> None:
    grey = step(SolidColor((0.5, 0.5, 0.5, 1.0)), result="a")
    np.testing.assert_allclose(run([grey], shapes)[0, 0], (0.5, 0.5, 0.5, 1.0))
    flooded = np.broadcast_to((0.5, 0.5, 0.5, 1.0), shapes.shape)
    mixed = run([grey, step(Blending(Blend.MULTIPLY), *BOTH)], shapes)
    linear = blend(convert_colors(shapes, to_linear), convert_colors(flooded, to_linear), Blend.MULTIPLY)
    np.testing.assert_allclose(mixed, convert_colors(linear, from_linear), atol=1e-9)


def test_default_subregions_are_unions_of_inputs(shapes: np.ndarray) -> None:
    left = step(SolidColor(GREEN), result="a", subregion=(2.0, 3.0, 10.0, 12.0))
    right = step(SolidColor(GREEN), result="b", subregion=(20.0, 8.0, 24.0, 30.0))
    opaque = ColorMapping(lambda colors: np.ones_like(colors))
    found = run([left, right, step(PorterDuff("over"), "a", "b"), step(opaque, "")], shapes)[..., 3]
    assert found[3:30, 2:24].min() == 1.0
    assert found.sum() == 27 * 22
    assert run([left, step(opaque, "a")], shapes)[..., 3].sum() == 8 * 9
    assert run([left, step(Repetition(), "a")], shapes)[..., 3].min() == 0.5
    assert run([left, step(opaque, "SourceGraphic")], shapes)[..., 3].min() == 1.0


def test_the_filter_region_crops_inputs_and_results(shapes: np.ndarray) -> None:
    region = (12.0, 15.0, 30.0, 28.0)
    moved = run([step(Shift(5.0, 0.0), "SourceGraphic")], shapes, region=region)
    assert not moved[:, :17].any()
    np.testing.assert_array_equal(moved[15:28, 17:30], shapes[15:28, 12:25])
    filled = run([step(SolidColor(GREEN), subregion=(0.0, 0.0, 20.0, 20.0))], shapes, region=region)
    assert filled[..., 3].sum() == pytest.approx(8 * 5 * 0.5)


@pytest.mark.parametrize("subregion", [(5.0, 5.0, 5.0, 9.0), (9.0, 9.0, 2.0, 2.0), (99.0, 99.0, 110.0, 110.0)])
def test_an_empty_subregion_shows_nothing(subregion: tuple[float, ...], shapes: np.ndarray) -> None:
    assert not run([step(SolidColor(GREEN), subregion=subregion)], shapes).any()
    noise = step(Turbulence((0.1, 0.1), is_stitched=True), subregion=subregion)
    light = step(Lighting(DistantLight(0.0, 90.0), (1.0, 1.0, 1.0)), "SourceAlpha", subregion=subregion)
    assert not run([noise, light], shapes).any()


def test_a_border_within_pixels_fades_once() -> None:
    region = (3.3, 4.0, 30.0, 40.25)
    source = np.broadcast_to((0.2, 0.4, 0.6, 1.0), (SIDE, SIDE, 4)).copy()
    halves = [step(ColorMatrix(HALF_OPAQUE), "", result=str(k)) for k in range(4)]
    expected = crop(source * 0.5, FRAME, region)
    np.testing.assert_allclose(run(halves, source, region=region), expected, atol=1e-6)
    merged = run([*halves, step(Stack(), "3", "SourceGraphic")], source, region=region)
    np.testing.assert_allclose(merged, crop(merge([source * 0.5, source]), FRAME, region), atol=1e-6)
    inner = (3.3, 10.0, 20.6, 20.0)
    steps = [step(SolidColor(GREEN), result="a", subregion=inner), step(PorterDuff("over"), "a", "SourceGraphic")]
    flooded = crop(np.broadcast_to((0.0, 0.5, 0.0, 0.5), source.shape), FRAME, (0.0, *inner[1:]))
    linear = composite(convert_colors(flooded, to_linear), convert_colors(source, to_linear), "over")
    np.testing.assert_allclose(
        run(steps, source, region=region), crop(convert_colors(linear, from_linear), FRAME, region), atol=1e-6
    )


def test_a_region_within_pixels_has_no_ridge_in_the_light() -> None:
    source = np.broadcast_to((0.0, 0.0, 0.0, 1.0), (SIDE, SIDE, 4)).copy()
    lit = step(Lighting(DistantLight(30.0, 50.0), (1.0, 1.0, 1.0), 4.0), "SourceAlpha", is_linear=False)
    region = (3.3, 4.0, 30.0, 40.25)
    found = run([lit], source, region=region)
    inside = found[..., 3] > 0.0
    np.testing.assert_allclose(found[inside][:, 0] / found[inside][:, 3], np.sin(np.radians(50.0)))


def test_a_tile_within_pixels_has_no_seams(shapes: np.ndarray) -> None:
    part = step(SolidColor(GREEN), subregion=(5.3, 6.4, 15.8, 14.9))
    found = run([part, step(Repetition(), "")], shapes)
    np.testing.assert_allclose(found, np.broadcast_to((0.0, 0.5, 0.0, 0.5), found.shape))


def test_noise_is_averaged_where_it_is_finer_than_pixels(shapes: np.ndarray) -> None:
    assert [noise_samples(Turbulence((f, f), n), FRAME) for f, n in [(0.05, 4), (0.05, 5), (0.6, 1)]] == [1, 2, 2]
    noise = Turbulence((0.4, 0.4), 3, 5.0, is_fractal=True)
    found = run([step(noise, is_linear=False)], shapes)
    np.testing.assert_allclose(found, turbulence(noise, FRAME, FRAME.bounds, 2), atol=1e-12)


def test_results_are_colours_in_srgb(shapes: np.ndarray) -> None:
    wild = ColorMapping(lambda colors: np.where(colors > 0.5, np.nan, 7.0 * colors - 1.0))
    found = run([step(wild, "SourceGraphic")], shapes)
    assert (found >= 0.0).all()
    assert (found[..., :3] <= found[..., 3:]).all()
    assert (found[..., 3] <= 1.0).all()


@pytest.mark.parametrize(
    "operation",
    [
        GaussianBlur((np.nan, 1.0)),
        Shift(1e16, 0.0),
        Turbulence((0.1, np.inf)),
        Lighting(DistantLight(np.nan, 0.0), (1.0, 1.0, 1.0)),
        ComponentTransfer((TransferCurve("table", (0.0, np.nan)),) * 4),
    ],
    ids=lambda operation: type(operation).__name__,
)
def test_parameters_that_are_no_numbers_are_refused(operation: Operation) -> None:
    with pytest.raises(SourceError, match=rf"{type(operation).__name__}\.\w+.* of a filter is (nan|inf|1e\+16); use a"):
        step(operation)
    with pytest.raises(SourceError, match="subregion of a filter is nan"):
        step(Stack(), subregion=(0.0, 0.0, np.nan, 1.0))
    with pytest.raises(SourceError, match=r"^region of a filter is inf; use a number from -1e\+15 to 1e\+15$"):
        evaluate([step(Stack())], {}, FRAME, (0.0, 0.0, np.inf, 1.0))


def test_pixels_of_another_shape_are_refused() -> None:
    with pytest.raises(SourceError, match=r"SourceGraphic of a filter has the shape \(2, 3, 4\)"):
        run([step(Stack())], np.zeros((2, 3, 4)))


def test_results_that_are_needed_at_a_time_are_limited(shapes: np.ndarray) -> None:
    large = PixelFrame(0.0, 0.0, 1.0, 1.0, 512, 512)
    floods = [step(SolidColor(GREEN), result=str(k)) for k in range(70)]
    together = step(Stack(), *(str(k) for k in range(70)))
    with pytest.raises(LimitError, match="needs 70 results of 512 x 512 pixels at a time; the limit is 64; use fewer"):
        check_steps([*floods, together], large)
    with pytest.raises(LimitError, match="needs 70 results"):
        evaluate([*floods, together], {}, large)
    check_steps([*floods, together], FRAME)
    in_turn = [step(Shift(1.0, 0.0), str(k), result=str(k + 1)) for k in range(1000)]
    check_steps(in_turn, large)
    assert np.isfinite(run([step(Shift(1.0, 0.0), "", result=str(k)) for k in range(200)], shapes)).all()


def test_a_convolution_that_is_too_large_is_refused_before_anything_is_drawn() -> None:
    with pytest.raises(LimitError, match="1000 x 1000"):
        check_steps([step(Convolution((1000, 1000), (1.0,) * 10**6), "")], FRAME)


def test_a_filter_stops_at_the_time_limit(shapes: np.ndarray) -> None:
    with within(1e-9), pytest.raises(LimitError, match="max_seconds"):
        run([step(GaussianBlur((2.0, 2.0)), "")], shapes)
