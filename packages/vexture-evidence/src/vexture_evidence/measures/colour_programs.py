"""The shaders of drawings in colours, to be timed: planar maps, stacked layers, and a silhouette beside them."""

from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.renderers.gpu import gradients_of
from vexture.renderers.shader import WRAPS, shader_text
from vexture.texture.texture import Texture
from vexture_evidence.measures.colour_fetches import SheetStack
from vexture_evidence.measures.programs import (
    MAIN,
    VERSION,
    Framebuffer,
    Program,
    compile_shader,
    current_context,
    nearest,
)

ONE: Final = 65536
"""1 as a coordinate of a box in the texture of layers."""

COLOR_MAIN: Final = MAIN.replace("float coverage_of_pixel", "vec4 coverage_of_pixel")
INPUTS: Final = "uniform uint root;\nuniform int count;\nuniform uvec2 base;\n"


def source(file: str, call: str, *, is_flat: bool, gradients: int = 0) -> str:
    """Fragment shader that draws an expression of uv, dx and dy in four channels."""
    chosen = {"WRAP": WRAPS["none"], "FLAT": int(is_flat), "LINEAR": 0, "GRADIENTS": gradients}
    lines = "".join(f"#define VEXTURE_{name} {value}\n" for name, value in chosen.items())
    # 16-bit halves of words, which OpenGL has from 4.2 on and WebGL2 always
    first = f"#version {VERSION}\n#extension GL_ARB_shading_language_packing : require\n"
    return first + lines + shader_text(file) + INPUTS + COLOR_MAIN.replace("CALL", call)


def map_source(*, is_flat: bool, gradients: int) -> str:
    """Fragment shader of one planar map."""
    call = "vextureWrappedColor(root, base, uv, dx, dy)"
    return source("sheets.glsl", call, is_flat=is_flat, gradients=gradients)


def sheets_program(sheets: SheetStack, *, is_flat: bool) -> Program:
    """Program that draws one map, layers, or several maps and layers."""
    texture, count = sheets.texture, len(sheets.texture.roots)
    maps = [root.quad for root in texture.roots if root.is_map]
    gradients = max((gradients_of(texture, quad) for quad in maps), default=0)
    textures: dict[str, Any] = {"vextureTexels": nearest(texture.texels, "u4")}
    if count == 1 and maps:
        text = map_source(is_flat=is_flat, gradients=gradients)
        return Program("map", {}, compile_shader(text), textures, {"root": maps[0]}, based=True)
    textures["vexturePaints"] = nearest(layers_image(sheets), "u4")
    file, name = ("sheets.glsl", "vextureSheets") if maps else ("layers.glsl", "vextureLayers")
    text = source(file, f"{name}(0, count, base, uv, dx, dy)", is_flat=is_flat, gradients=gradients)
    return Program(name, {}, compile_shader(text), textures, {"count": count}, based=True)


def silhouette_program(texture: Texture, *, is_flat: bool) -> Program:
    """Program of the coverage of a texture's first shape, in its four channels."""
    text = source("layers.glsl", "vec4(vextureWrapped(root, base, uv, dx, dy))", is_flat=is_flat)
    textures = {"vextureTexels": nearest(texture.texels, "u4")}
    return Program("silhouette", {}, compile_shader(text), textures, {"root": texture.roots[0].quad}, based=True)


def layers_image(sheets: SheetStack) -> NDArray[np.uint32]:
    """Content of ``vexturePaints`` for layers, (n, 2, 4): quad, paint and kind, and the box of each."""
    rows = np.zeros((len(sheets.texture.roots), 2, 4), np.uint32)
    for row, root, (low, high) in zip(rows, sheets.texture.roots, sheets.boxes, strict=True):
        paint = (0.0, 0.0, 0.0, 1.0) if root.paint is None else (*root.paint.color, root.paint.opacity)
        red, green, blue, opacity = np.rint(65535.0 * np.array(paint)).astype(np.int64).tolist()
        row[0] = root.quad, red | green << 16, blue | opacity << 16, int(root.is_map)
        row[1] = np.clip([*np.floor(ONE * low), *np.ceil(ONE * high)], 0, ONE)
    return rows


@cache
def color_target(size: tuple[int, int]) -> Framebuffer:
    """Target with four float32 channels, cached for the next caller."""
    gl = current_context()
    return Framebuffer(size, gl.framebuffer([gl.texture(size, 4, dtype="f4")]))
