"""Planar maps with pictures: the shader in both languages against its mirror, and the mirror against exact means."""

from functools import cache

import numpy as np
import pytest
from hand import need_gpu
from packed_views import TILTED, nudged_view, turned_view

import gradient_drawings as shades
from either_language import by_wgsl, device
from picture_texels import noise, true_mean, with_pictures
from vexture.base.layout import MAP_HEAD
from vexture.drawing.drawing import Drawing
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Paint, Stop
from vexture.renderers.colour import render_cpu_colours
from vexture.renderers.gpu import gradients_of, render_gpu_colours
from vexture.renderers.shader import color_source, shader_source, shader_text
from vexture.renderers.uniforms import uniforms_of
from vexture.renderers.view import fit, window
from vexture.texture.encode import texel_rows
from vexture.texture.planar import map_texels
from vexture.tree.planar.build import build_map

NEAR = 0.1 / 255
SCREEN = Blend.SCREEN
FACTOR = 0.9  # opacity of the pictures
HOLDER = shades.radial((0.4, 0.5), 0.4, (Stop(0, (1, 0, 0), 0.5), Stop(1, (0, 0, 1), 0.9)), focus=(0.5, 0.6))
"""Stands for a picture until its texels are there."""

DRAWINGS = {
    "square": Drawing((shades.painted_path(shades.SQUARE, HOLDER),)),
    "disc": Drawing(
        (shades.painted_path(shades.SQUARE, Paint((0.9, 0.8, 0.3))), shades.painted_path(shades.DISC, HOLDER))
    ),
    "over a gradient": Drawing((shades.UPWARDS, shades.painted_path(shades.DISC, HOLDER))),
    "screen": Drawing((shades.UPWARDS, shades.painted_path(shades.LENS, HOLDER, 0)), groups=(Group(-1, 0.7, SCREEN),)),
    "mask": Drawing(
        (
            shades.painted_path(shades.SQUARE, HOLDER, 0),
            shades.painted_path(shades.DISC, shades.linear((0.1, 0.2), (0.9, 0.7), shades.FADING), 1),
        ),
        groups=(Group(), Group(0, mask=Mask.OPACITY)),
    ),
}
VIEWS = {
    "37 pixels": ((37, 37), fit((37, 37))),
    "64 pixels": ((64, 64), fit((64, 64))),
    "64 pixels, any": nudged_view(((64, 64), fit((64, 64)))),
    "turned by 30 degrees": turned_view(50, 30),
    "turned by 45 degrees, 6:1": turned_view(90, 45, 6),
    "a tilted plane": ((97, 64), TILTED),
    "close": ((40, 40), window(0.41, 0.52, 0.05, 0.05).matrix((40, 40))),
    "close, turned": ((40, 40), window(0.41, 0.52, 0.05, 0.05, 30.0).matrix((40, 40))),
    "closer": ((40, 40), window(0.4123, 0.5231, 2e-4, 2e-4, 20.0).matrix((40, 40))),
}


class MapTexture:
    """A map with a picture of about so many columns and rows."""

    def __init__(self, name: str, side: int, is_smooth: bool) -> None:
        pixels = noise(side)[: side - 3, :]
        if name != "square":
            pixels[: side // 2, :, :] //= 2
        flat = map_texels(build_map(DRAWINGS[name], tolerance=2e-5), 0)
        self.to_pixels = ((float(side), 0.0, 0.0), (0.0, 3.0 - side, side - 3.0))
        self.pixels, self.is_smooth = pixels, is_smooth
        self.texels = texel_rows(with_pictures(flat, MAP_HEAD, self.to_pixels, pixels, is_smooth=is_smooth))
        self.quads = np.array([MAP_HEAD])


texture = cache(MapTexture)


@pytest.mark.slow
@pytest.mark.parametrize("is_smooth", [False, True])
@pytest.mark.parametrize("name", DRAWINGS)
def test_the_shader_draws_what_its_mirror_draws(name: str, is_smooth: bool) -> None:
    need_gpu()
    for side in (512, 24):
        drawn = texture(name, side, is_smooth)
        assert gradients_of(drawn, MAP_HEAD) == 2
        for view, (size, matrix) in VIEWS.items():
            on_cpu = render_cpu_colours(drawn, size, matrix)
            gap = np.abs(on_cpu - render_gpu_colours(drawn, size, matrix)).max()
            assert gap < NEAR, (side, view, 255 * gap)
            assert np.ptp(on_cpu) > 0.05 or view == "closer"


@pytest.mark.slow
@pytest.mark.parametrize("is_smooth", [False, True])
def test_wgsl_draws_what_the_mirror_draws(is_smooth: bool) -> None:
    device()
    drawn, (size, matrix) = texture("over a gradient", 512, is_smooth), VIEWS["turned by 30 degrees"]
    uniforms = uniforms_of(drawn, size, matrix, 0)
    given = {"vextureTexels": drawn.texels, "to_unit": uniforms.to_unit, "base": uniforms.base, "root": uniforms.quad}
    numbers = {"VEXTURE_FLAT": int(uniforms.is_flat), "VEXTURE_WRAP": 0, "VEXTURE_GRADIENTS": 2, "VEXTURE_LINEAR": 0}
    text = shader_text("view_color.glsl") + "\nvec4 shown(vec2 pixel) { return view_color(pixel); }\n"
    found = by_wgsl(text, tuple(numbers.items()), given, size)
    assert np.abs(found - render_cpu_colours(drawn, size, matrix)).max() < NEAR


@pytest.mark.parametrize("is_smooth", [False, True])
@pytest.mark.parametrize(("pixels", "most"), [(700, 0.5), (37, 2.5), (20, 2.5)])
def test_a_square_of_a_picture_is_exact(pixels: int, most: float, is_smooth: bool) -> None:
    drawn, step = texture("square", 512, is_smooth), 512 / pixels
    image = render_cpu_colours(drawn, (pixels, pixels))
    rng = np.random.default_rng(1)
    for row, column in rng.integers(1, pixels - 1, (120, 2)).tolist():
        middle = ((column + 0.5) * step, 509 - (1 - (row + 0.5) / pixels) * 509)
        expected = true_mean(drawn.pixels, middle, (step, 0), (0, 509 / pixels), is_smooth=is_smooth)
        gap = np.abs(image[row, column] - FACTOR * expected / 255).max()
        assert 255 * gap < most, (row, column, 255 * gap)


def test_pictures_are_left_out_where_there_are_none() -> None:
    for gradients in (0, 1, 2):
        assert f"#define VEXTURE_GRADIENTS {gradients}\n" in color_source("330", False, False, gradients)
    for options, number in (({}, 2), ({"pictures": False}, 1), ({"gradients": False}, 0)):
        assert f"#define VEXTURE_GRADIENTS {number}\n" in shader_source(part="color", **options)
        text = shader_source("wgsl", "color", **options)
        assert ("fn vexture_picture_mean(" in text) == (number == 2)
        assert ("fn vexture_program(" in text) == (number > 0)
