"""Planar maps in their colours: the shader against its mirror, and both against closed formulas."""

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
from hand import need_gpu
from numpy.typing import NDArray
from packed_views import ENTRIES, TILTED, View, nudged_view, turned_view, zoomed_view

import degenerate
import gradient_drawings as shades
import planar
from vexture.base.layout import MAP_HEAD
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint, Spread
from vexture.renderers.colour import render_cpu_colours
from vexture.renderers.device import context
from vexture.renderers.exact import render_exact_colours
from vexture.renderers.gpu import render_gpu_colours
from vexture.renderers.shader import VERSIONS, color_source, vertex_source
from vexture.renderers.view import fit, window
from vexture.texture.encode import texel_rows
from vexture.texture.planar import map_texels
from vexture.tree.planar.build import build_map

NEAR = 0.06 / 255  # moments of a pixel that is sheared and stretched lose most in float32
NEAR_IN_DEEP_ZOOM = (
    0.5 / 255
)  # leaves that are this large on the screen are float32's: coverage is off by three times that
BEFORE = 5  # texels before a map, so that its parts are not where its words are


@dataclass(frozen=True, slots=True)
class MapTexture:
    """A planar map in an image."""

    texels: NDArray[np.uint32]
    quads: NDArray[np.int64]


def map_of(drawing: Drawing, **options: int) -> MapTexture:
    before = np.full((BEFORE, 4), 0xFFFFFFFF, np.uint32)
    texels = np.concatenate([before, map_texels(build_map(drawing, tolerance=2e-5, **options), BEFORE)])
    return MapTexture(texel_rows(texels), np.array([BEFORE + MAP_HEAD]))


def painted(*shapes: tuple[Any, tuple[float, float, float], float]) -> Drawing:
    return Drawing(tuple(Path((contour,), paint=Paint(color, opacity)) for contour, color, opacity in shapes))


def flag() -> Drawing:
    """Stripes that touch, with a canton, stars, and a translucent disc across borders."""
    stripes = [
        (degenerate.polygon([(0, k / 7), (1, k / 7), (1, (k + 1) / 7), (0, (k + 1) / 7)]), (0.7, k % 2, 0.2), 1.0)
        for k in range(7)
    ]
    canton = (degenerate.polygon([(0, 3 / 7), (0.4, 3 / 7), (0.4, 1), (0, 1)]), (0.1, 0.2, 0.6), 1.0)
    stars = [
        (degenerate.star(5, 2, (0.08 + 0.12 * i, 0.53 + 0.13 * j), 0.05), (1.0, 1.0, 0.9), 1.0)
        for i in range(3)
        for j in range(4)
    ]
    return painted(*stripes, canton, *stars, (degenerate.circle((0.6, 0.5), 0.3), (0.0, 0.6, 0.3), 0.4))


DRAWINGS = {"flag": flag} | {
    f"degenerate {seed}": lambda seed=seed: planar.colour_paths(degenerate.drawing(seed), np.random.default_rng(seed))
    for seed in (6, 7, 9, 13, 21, 28)
}
SHADED = {f"shaded {name}": lambda name=name: shades.DRAWINGS[name] for name in shades.DRAWINGS}


@cache
def made(name: str) -> tuple[Drawing, MapTexture]:
    drawing = (DRAWINGS | SHADED)[name]()
    return drawing, map_of(drawing)


def views(drawing: Drawing) -> dict[str, View]:
    upright = {f"{side} pixels": ((side, side), fit((side, side))) for side in (16, 20, 64, 100)}
    deep = zoomed_view(drawing, 1e-5, 24)
    return {
        **upright,
        **{f"{name}, any": nudged_view(view) for name, view in upright.items()},
        "turned by 30 degrees": turned_view(50, 30),
        "sheared 6:1": turned_view(90, 40, 6),
        "a tilted plane": ((97, 64), TILTED),
        "deep": deep,
        "deep, any": nudged_view(deep),
        "beyond the square": ((20, 20), window(-0.4, -0.3, 2, 2).matrix((20, 20))),
    }


@pytest.mark.parametrize("is_linear", [False, True])
@pytest.mark.parametrize("name", DRAWINGS | SHADED)
def test_the_shader_draws_what_its_mirror_draws(name: str, is_linear: bool) -> None:
    need_gpu()
    drawing, texture = made(name)
    for view, (size, matrix) in views(drawing).items():
        on_cpu = render_cpu_colours(texture, size, matrix, is_linear=is_linear)
        on_gpu = render_gpu_colours(texture, size, matrix, is_linear=is_linear)
        assert on_cpu.shape == on_gpu.shape == (*size[::-1], 4)
        assert on_cpu.any() or "deep" in view, view
        assert np.abs(on_cpu - on_gpu).max() < (NEAR_IN_DEEP_ZOOM if "deep" in view else NEAR), view


@pytest.mark.parametrize("name", shades.DRAWINGS)
def test_gradients_are_those_of_many_points(name: str) -> None:
    """Errors over 4 and 20 pixels, where a gradient is far from flat in a pixel; in 1/255."""
    drawing, texture = made(f"shaded {name}")
    for size, mean in ((4, 1.6), (20, 0.25)):
        error = 255 * abs(render_cpu_colours(texture, (size, size)) - planar.sample_picture(drawing, size, 12))
        assert error.mean() < mean, size


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.parametrize("size", [20, 61])
def test_a_gradient_is_averaged_over_its_part_of_a_pixel(size: int, entry: str) -> None:
    """A straight ramp at outlines needs the part's middle; one that jumps at a straight border, its ends."""
    ramp, other = (shades.linear(*ends, shades.WARM[::2]) for ends in (((0, -1), (1, 2)), ((2, 0), (-1, 0.5))))
    jumps = shades.linear((0.2, 0), (0.3, 0), shades.WARM[::2], Spread.REPEAT)  # at both of the border's upright sides
    border = degenerate.polygon([(0.2, 0.3), (0.7, 0.3), (0.7, 0.8), (0.2, 0.8)])
    discs = (shades.painted_path(shades.LENS, other), shades.painted_path(shades.OTHER, Paint((0.1, 0.8, 0.3))))
    for drawing in (
        Drawing((shades.painted_path(shades.SQUARE, ramp), *discs)),
        Drawing((shades.painted_path(shades.SQUARE, Paint((0, 0, 1))), shades.painted_path(border, jumps))),
    ):
        image = render_cpu_colours(map_of(drawing), *ENTRIES[entry](((size, size), fit((size, size)))))
        assert abs(image - render_exact_colours(drawing, size)).max() < 1.5 / 255


@pytest.mark.parametrize("size", [64, 100, 256])
def test_the_edge_of_a_cone_is_antialiased(size: int) -> None:
    """All but its tip; in 1/255."""
    drawing, texture = made("shaded cone")
    error = 255 * abs(render_cpu_colours(texture, (size, size)) - render_exact_colours(drawing, size))
    assert error.max() < 14
    assert error.mean() < 0.04


@pytest.mark.parametrize("spread", [Spread.REFLECT, Spread.REPEAT])
@pytest.mark.parametrize("is_round", [False, True])
def test_a_sliver_of_a_pixel_has_a_place_on_a_ramp_that_goes_on(spread: Spread, is_round: bool) -> None:
    """A cell's border cuts a pixel that it should only touch; all of the picture is opaque."""
    need_gpu()
    stops = (shades.WARM[0], shades.WARM[2])
    ramp = (
        shades.radial((0.1, 0.2), 0.05, stops, spread)
        if is_round
        else shades.linear((0.0, 0.0), (0.13, 0.07), stops, spread)
    )
    texture = map_of(Drawing((shades.painted_path(shades.SQUARE, ramp),)))
    assert render_gpu_colours(texture, (600, 600))[..., 3].min() > 0.999


def test_hard_stops_are_exact() -> None:
    stripes = Drawing((shades.painted_path(shades.SQUARE, shades.linear((0.1, 0.2), (0.9, 0.7), shades.BANDS)),))
    error = 255 * abs(render_cpu_colours(map_of(stripes), (64, 64)) - render_exact_colours(stripes, 64))
    assert error.max() < 0.1  # stripes have edges, which are rounded like outlines


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.parametrize("render", [render_cpu_colours, render_gpu_colours])
def test_light_is_averaged_and_straight_colours_are_decoded(render: Any, entry: str) -> None:
    """Half of the pixel is opaque, half translucent: the means of both kinds by hand."""
    if render is render_gpu_colours:
        need_gpu()
    halves = painted(
        (degenerate.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)]), (1.0, 0.5, 0.0), 1.0),
        (degenerate.polygon([(0.5, 0), (1, 0), (1, 1), (0.5, 1)]), (0.5, 0.0, 0.02), 0.4),
    )
    view = ENTRIES[entry](((1, 1), window(0.3, 0.3, 0.4, 0.4).matrix((1, 1))))
    half = ((0.5 + 0.055) / 1.055) ** 2.4
    expected = {
        False: (0.5 * 1.0 + 0.2 * 0.5, 0.5 * 0.5, 0.2 * 0.02, 0.7),
        True: (0.5 * 1.0 + 0.2 * half, 0.5 * half, 0.2 * 0.02 / 12.92, 0.7),
    }
    for is_linear, color in expected.items():
        image = render(map_of(halves), *view, is_linear=is_linear)
        np.testing.assert_allclose(image[0, 0], color, atol=2e-5)


@pytest.mark.parametrize("version", VERSIONS)
def test_the_shader_compiles_in_both_dialects(version: str) -> None:
    need_gpu()
    with context() as gl:
        for is_flat, is_linear, gradients in ((False, False, 1), (True, True, 0), (True, False, 2)):
            fragment = color_source(version, is_flat, is_linear, gradients)
            assert f"#define VEXTURE_FLAT {int(is_flat)}\n" in fragment
            gl.program(vertex_shader=vertex_source(version), fragment_shader=fragment).release()
