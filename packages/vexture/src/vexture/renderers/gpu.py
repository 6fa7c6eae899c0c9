"""Render a packed texture with its shader on the GPU, without a window."""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.base.layout import MAP_HEAD
from vexture.renderers.device import ONE_AT_A_TIME, VERSION, compile_shader, context, draw, upload
from vexture.renderers.shader import color_source, view_source
from vexture.renderers.uniforms import HasTexels, Uniforms, uniforms_of
from vexture.renderers.view import Size, ViewLike


@cache
def program(is_flat: bool) -> Any:
    """Compiled shader, with its triangle, for all packed textures, in flat views only or in any."""
    return compile_shader(view_source(VERSION, is_flat))


@cache
def color_program(is_flat: bool, is_linear: bool, gradients: int) -> Any:
    """Compiled shader, with its triangle, for planar maps, averaged in linear light or in sRGB."""
    return compile_shader(color_source(VERSION, is_flat, is_linear, gradients))


def gradients_of(texture: HasTexels, quad: int) -> int:
    """Value of ``VEXTURE_GRADIENTS`` for the planar map with root quad `quad` (FORMAT.md, D.1).

    It is 0 if no paint is a program, 1 if programs hold no pictures, and 2 if they do.
    """
    flat, head = texture.texels.reshape(-1, 4), quad - MAP_HEAD
    if not 0 <= head < len(flat):
        return 1
    return 2 if flat[head, 3] else int(flat[head, 1] > 0)


def drawn(gl: Any, triangle: Any, texture: HasTexels, uniforms: Uniforms, channels: int) -> NDArray[np.float32]:
    """Draw one shape with a compiled shader; return a picture (height, width, channels)."""
    uploaded = upload(gl, texture.texels, 0, "u4")
    triangle.program["vextureTexels"] = 0
    triangle.program["to_unit"].write(uniforms.to_unit.T.astype(np.float32).tobytes())
    triangle.program["base"] = uniforms.base
    triangle.program["root"] = uniforms.quad
    pixels = draw(gl, triangle, uniforms.size, channels)
    uploaded.release()
    return pixels


def render_gpu(texture: HasTexels, size: Size, view: ViewLike = None, *, root: int = 0) -> NDArray[np.float32]:
    """Render one shape of a packed texture; parameters as in `vexture.renderers.cpu.render_cpu`.

    Raises a `DeviceError` without OpenGL, and a `LimitError` if the image is larger than the device allows.
    """
    uniforms = uniforms_of(texture, size, view, root)
    with ONE_AT_A_TIME, context() as gl:
        return drawn(gl, program(uniforms.is_flat), texture, uniforms, 1)[..., 0]


def render_gpu_colours(
    texture: HasTexels, size: Size, view: ViewLike = None, *, root: int = 0, is_linear: bool = False
) -> NDArray[np.float32]:
    """Render one planar map of a texture; parameters as in `vexture.renderers.colour.render_cpu_colours`.

    Errors as in `render_gpu`.
    """
    uniforms = uniforms_of(texture, size, view, root)
    with ONE_AT_A_TIME, context() as gl:
        return drawn(
            gl, color_program(uniforms.is_flat, is_linear, gradients_of(texture, uniforms.quad)), texture, uniforms, 4
        )
