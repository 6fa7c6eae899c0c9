"""Planar maps with splines: the shader in both languages against its mirror, and the mirror against the splines."""

from functools import cache

import numpy as np
import pytest
from hand import need_gpu
from test_picture_maps import DRAWINGS, VIEWS

from either_language import by_wgsl, device
from spline_texels import blurred, colored, mean_of_spline, with_splines
from vexture.base.layout import MAP_HEAD
from vexture.drawing.picture import Sampling
from vexture.renderers.colour import render_cpu_colours
from vexture.renderers.gpu import gradients_of, render_gpu_colours
from vexture.renderers.shader import shader_text
from vexture.renderers.uniforms import uniforms_of
from vexture.texture.encode import texel_rows
from vexture.texture.planar import map_texels
from vexture.tree.planar.build import build_map

NEAR = 0.1 / 255
FACTOR = 0.9  # opacity of the splines
SPLINES = (Sampling.SPLINE, Sampling.OPACITY, Sampling.INVERSE)
COLOR = (51, 153, 255)


class SplineTexture:
    """A map with a spline of these columns, three rows fewer, over the unit square."""

    def __init__(self, name: str, columns: int, sampling: Sampling) -> None:
        pixels = blurred("corner", columns, columns - 3)
        self.pixels = colored(pixels) if sampling is Sampling.SPLINE else pixels
        flat, rows = map_texels(build_map(DRAWINGS[name], tolerance=2e-5), 0), float(columns - 3)
        to_pixels = ((float(columns), 0.0, 0.0), (0.0, -rows, rows))
        color = sum(part << 8 * k for k, part in enumerate(COLOR))
        self.texels = texel_rows(with_splines(flat, MAP_HEAD, to_pixels, self.pixels, sampling, color))
        self.quads = np.array([MAP_HEAD])


texture = cache(SplineTexture)


@pytest.mark.slow
@pytest.mark.parametrize("sampling", SPLINES)
@pytest.mark.parametrize("name", DRAWINGS)
def test_the_shader_draws_what_its_mirror_draws(name: str, sampling: Sampling) -> None:
    need_gpu()
    for columns in (14, 60, 350):
        drawn = texture(name, columns, sampling)
        assert gradients_of(drawn, MAP_HEAD) == 2
        for view, (size, matrix) in VIEWS.items():
            on_cpu = render_cpu_colours(drawn, size, matrix)
            gap = np.abs(on_cpu - render_gpu_colours(drawn, size, matrix)).max()
            assert gap < NEAR, (columns, view, 255 * gap)


@pytest.mark.slow
@pytest.mark.parametrize("sampling", [Sampling.SPLINE, Sampling.INVERSE])
def test_wgsl_draws_what_the_mirror_draws(sampling: Sampling) -> None:
    device()
    drawn, (size, matrix) = texture("over a gradient", 60, sampling), VIEWS["turned by 45 degrees, 6:1"]
    uniforms = uniforms_of(drawn, size, matrix, 0)
    given = {"vextureTexels": drawn.texels, "to_unit": uniforms.to_unit, "base": uniforms.base, "root": uniforms.quad}
    numbers = {"VEXTURE_FLAT": int(uniforms.is_flat), "VEXTURE_WRAP": 0, "VEXTURE_GRADIENTS": 2, "VEXTURE_LINEAR": 0}
    text = shader_text("view_color.glsl") + "\nvec4 shown(vec2 pixel) { return view_color(pixel); }\n"
    found = by_wgsl(text, tuple(numbers.items()), given, size)
    assert np.abs(found - render_cpu_colours(drawn, size, matrix)).max() < NEAR


@pytest.mark.parametrize("sampling", SPLINES)
@pytest.mark.parametrize("columns", [14, 60, 180])
def test_a_square_of_a_spline_is_its_mean(columns: int, sampling: Sampling) -> None:
    drawn, pixels = texture("square", columns, sampling), 25
    image = render_cpu_colours(drawn, (pixels, pixels))
    across, down = columns / pixels, (columns - 3) / pixels
    for row, column in np.random.default_rng(1).integers(1, pixels - 1, (60, 2)).tolist():
        middle = ((column + 0.5) * across, (row + 0.5) * down)
        expected = mean_of_spline(drawn.pixels, middle, (across, 0), (0, down)) / 255
        if sampling is not Sampling.SPLINE:
            opacity = 1 - expected if sampling is Sampling.INVERSE else expected
            expected = opacity * np.array([*COLOR, 255]) / 255
        gap = np.abs(image[row, column] - FACTOR * expected).max()
        assert 255 * gap < (1.3 if sampling is Sampling.SPLINE else 0.3), (row, column, 255 * gap)
