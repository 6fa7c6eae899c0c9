"""The face at a point: the shader against its mirror, and that against the windings of the drawing."""

from functools import cache

import numpy as np
import pytest
from hand import need_gpu

import degenerate
import planar
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing
from vexture.renderers.device import ONE_AT_A_TIME, compile_shader, context, draw, upload
from vexture.renderers.feature import feature
from vexture.renderers.shader import VERSIONS, shader_text, vertex_source
from vexture.texture.texture import Texture

SIDE = 48
MAIN = """
uniform uint root;
uniform uvec2 base;
uniform vec4 window;  // of the unit square: low x, low y, width, height
out float number_of_pixel;
void main() {
    number_of_pixel = float(vextureFeature(root, base, window.xy + gl_FragCoord.xy * window.zw / 48.0));
}
"""
WINDOWS = {
    "whole": ((0, 0), (0.0, 0.0, 1.0, 1.0)),
    "beyond": ((0, 0), (-0.3, -0.2, 1.5, 1.5)),
    "near": ((0x5A123456, 0x71234567), (0.0, 0.0, 1e-3, 1e-3)),
}


@cache
def made(seed: int) -> tuple[Drawing, Texture]:
    of = planar.colour_paths(
        Drawing(degenerate.drawing(seed).paths + degenerate.drawing(seed + 100).paths), np.random.default_rng(seed)
    )
    return of, run(of, Parameters("faces", restyle=True)).texture


def points_of(window: tuple[float, ...]) -> list[tuple[float, float]]:
    low_x, low_y, width, height = window
    places = (np.arange(SIDE) + 0.5) / SIDE
    return [(low_x + width * x, low_y + height * y) for y in places for x in places]


def on_cpu(texture: Texture, base: tuple[int, int], window: tuple[float, ...]) -> np.ndarray:
    found = [feature(texture.texels, texture.roots[0].quad, base, point) for point in points_of(window)]
    return np.array(found).reshape(SIDE, SIDE)


def on_gpu(texture: Texture, base: tuple[int, int], window: tuple[float, ...]) -> np.ndarray:
    with ONE_AT_A_TIME, context() as gl:
        triangle = compile_shader(VERSIONS["330"] + shader_text("feature.glsl") + MAIN)
        uploaded = upload(gl, texture.texels, 0, "u4")
        triangle.program["vextureTexels"] = 0
        triangle.program["root"] = texture.roots[0].quad
        triangle.program["base"] = base
        triangle.program["window"] = window
        picture = draw(gl, triangle, (SIDE, SIDE))[..., 0]
        uploaded.release()
    return picture.astype(int)


@pytest.mark.parametrize("seed", [3, 6, 7, 13])
@pytest.mark.parametrize("window", WINDOWS)
def test_the_shader_finds_what_its_mirror_finds(seed: int, window: str) -> None:
    need_gpu()
    _, texture = made(seed)
    cpu, gpu = on_cpu(texture, *WINDOWS[window]), on_gpu(texture, *WINDOWS[window])
    assert (cpu != gpu).mean() < 2e-3  # on outlines float32 may find the other side
    assert (cpu[0, 0] == -1) == (window == "beyond")


@pytest.mark.parametrize("seed", [3, 6, 7, 13])
def test_the_mirror_finds_the_element_that_is_topmost(seed: int) -> None:
    _, texture = made(seed)
    base, window = WINDOWS["whole"]
    paints, top = on_cpu(texture, base, window).ravel(), np.append(texture.roots[0].style.top, -1)
    found = texture.element_at(points_of(window)).element
    known = paints >= 0
    assert known.mean() > 0.99
    assert (top[paints] == found)[known].all()


@pytest.mark.parametrize("version", VERSIONS)
def test_the_shader_compiles_in_both_dialects(version: str) -> None:
    need_gpu()
    with context() as gl:
        fragment = VERSIONS[version] + shader_text("feature.glsl") + MAIN
        assert fragment.startswith(f"#version {version}\n")
        gl.program(vertex_shader=vertex_source(version), fragment_shader=fragment).release()
