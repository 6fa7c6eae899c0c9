"""The shaders that are compared, each compiled once and used both for pictures and for timing.

All have the same `main`: the pixel's place in the unit square and its derivatives come from a matrix, never
from neighbouring pixels, and the picture may repeat in tiles, so that small views can be drawn many times at once.
"""

import re
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture.renderers.device import context
from vexture.renderers.exact import render_exact
from vexture.renderers.flat import flat
from vexture.renderers.shader import shader_source, vertex_source
from vexture.renderers.view import view_base
from vexture.texture.encode import encode
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.thesis import method
from vexture.thesis.shader_text import TextureSizes, compose
from vexture.thesis.texture import ThesisTexture, fold
from vexture.tree.build import build_tree
from vexture_evidence.measures.bands import BandTexture, band_constants, band_shader

VERSION: Final = "330"
IMAGE_SIDE: Final = 1024
"""Pixels along a side of the mip-mapped picture."""

ROUND_SIDE: Final = 256
"""Pixels; the sides of targets are multiples of this, so that few targets are needed."""

FLAT_INPUTS: Final = "uniform vec2 extent;\nuniform float inverse_area;\nuniform int finest;\n"
FLAT_VIEW: Final = "VextureFlat(extent, inverse_area, finest)"

MAIN: Final = """
uniform mat3 to_unit;  // from pixel coordinates, y down, to the unit square
uniform vec2 tile;     // pixels after which the picture repeats
out float coverage_of_pixel;
void main() {
    vec3 h = to_unit * vec3(mod(gl_FragCoord.xy, tile), 1.0);
    vec2 uv = h.xy / h.z;
    vec2 dx = (to_unit[0].xy - uv * to_unit[0].z) / h.z;
    vec2 dy = (to_unit[1].xy - uv * to_unit[1].z) / h.z;
    coverage_of_pixel = CALL;
}
"""


@dataclass(frozen=True, slots=True, eq=False)
class Framebuffer:
    """A framebuffer to draw into."""

    size: tuple[int, ...]
    frame: Any


@dataclass(frozen=True, slots=True, eq=False)
class Program:
    """A compiled shader and the textures that it reads.

    Parameters
    ----------
    name : str
        Name in the tables.
    constants : mapping
        Constants that were compiled in, for the tables.
    triangle : moderngl.VertexArray
        The compiled program with a triangle that covers the picture.
    textures : mapping
        Textures by the names of the shader's samplers.
    uniforms : mapping
        Further values to set.
    based : bool
        Whether the shader takes positions relative to the uniform `base`, a point in view (1.0 is 2^32).
    is_flat : bool
        Whether it takes what all pixels of a view have in common.
    """

    name: str
    constants: Mapping[str, Any]
    triangle: Any
    textures: Mapping[str, Any]
    uniforms: Mapping[str, Any] = field(default_factory=dict)
    based: bool = False
    is_flat: bool = False

    def prepare(self, to_unit: NDArray[np.float64], tile: tuple[int, int]) -> None:
        """Bind the textures and set the uniforms; the target is set by the caller."""
        shader = self.triangle.program
        for unit, (name, texture) in enumerate(self.textures.items()):
            texture.use(unit)
            shader[name] = unit
        for name, value in self.uniforms.items():
            shader[name] = value
        shader["tile"] = tile
        if self.is_flat:
            common = flat((to_unit[0, 0], to_unit[1, 0]), (to_unit[0, 1], to_unit[1, 1]))
            shader["extent"], shader["inverse_area"], shader["finest"] = common
        if self.based:
            base = view_base(to_unit, tile)
            shader["base"] = base
            to_unit = to_unit.copy()
            to_unit[:2] -= np.outer(base, to_unit[2]) / 2.0**32
        shader["to_unit"].write(to_unit.T.astype(np.float32).tobytes())

    def image(self, size: tuple[int, int], to_unit: NDArray[np.float64]) -> NDArray[np.float32]:
        """Draw one picture, (height, width)."""
        current_context()
        frame = framebuffer(tuple(-(-side // ROUND_SIDE) * ROUND_SIDE for side in size)).frame
        frame.viewport = (0, 0, *size)
        frame.use()
        self.prepare(to_unit, size)
        self.triangle.render(vertices=3)
        pixels = np.frombuffer(frame.read(viewport=frame.viewport, components=1, dtype="f4", alignment=1), np.float32)
        return pixels.reshape(size[1], size[0]).copy()


def current_context() -> Any:
    """Make the OpenGL context current and return it; it stays current: these programs are for one thread."""
    return context().__enter__()


@cache
def framebuffer(size: tuple[int, ...]) -> Framebuffer:
    """Target with one float32 channel, cached for the next caller."""
    gl = current_context()
    return Framebuffer(size, gl.framebuffer([gl.texture(size, 1, dtype="f4")]))


def driver() -> str:
    """Name and version of the OpenGL driver."""
    info = current_context().info
    return f"{info['GL_RENDERER']}, {info['GL_VERSION']}"


def seconds(
    program: Program, target: Framebuffer, to_unit: NDArray[np.float64], tile: tuple[int, int], draws: int
) -> float:
    """Time of `draws` draws, from the first call until the device has finished the last."""
    gl = current_context()
    target.frame.viewport = (0, 0, *target.size)
    target.frame.use()
    program.prepare(to_unit, tile)
    gl.finish()
    start = time.perf_counter()
    for _ in range(draws):
        program.triangle.render(vertices=3)
    gl.finish()
    return time.perf_counter() - start


def main_calling(call: str) -> str:
    """Text of `main` that evaluates an expression of uv, dx and dy."""
    return MAIN.replace("CALL", call)


def fragment(text: str, call: str) -> str:
    """Complete fragment shader: the given text and the common `main`."""
    return f"#version {VERSION}\n" + text + main_calling(call)


@cache
def compile_shader(source: str) -> Any:
    """Triangle with the program of a fragment shader, compiled once for each text."""
    gl = current_context()
    return gl.vertex_array(gl.program(vertex_shader=vertex_source(VERSION), fragment_shader=source), [])


def nearest(pixels: NDArray[Any], kind: str) -> Any:
    """Texture of an array (rows, width, channels), without filtering."""
    made = current_context().texture(
        pixels.shape[1::-1], pixels.shape[2], np.ascontiguousarray(pixels).tobytes(), dtype=kind
    )
    made.filter = (0x2600, 0x2600)  # GL_NEAREST
    return made


def rows_of(values: NDArray[Any], width: int) -> NDArray[Any]:
    """Arrange a list of texels in the rows of a texture; the last row is padded with zeros."""
    padded = np.zeros((-(-len(values) // width) * width, values.shape[1]), values.dtype)
    padded[: len(values)] = values
    return padded.reshape(-1, width, values.shape[1])


def band_source(bands: int) -> str:
    """Fragment shader of the band method."""
    return fragment(band_shader(bands), "band_coverage(uv, dx, dy)")


def band_program(texture: BandTexture) -> Program:
    """Program of the band method for a texture."""
    constants = band_constants(texture.bands)
    width = 1 << int(constants["ROW_BITS"])
    lists = nearest(rows_of(texture.lists[:, None], width), "u4")
    outlines = nearest(rows_of(texture.outlines, width), "f4")
    textures = {"band_lists": lists, "outlines": outlines}
    source = band_source(texture.bands)
    return Program("bands", constants, compile_shader(source), textures, {"band_box": tuple(texture.box)})


def packed_texture(drawing: Drawing, **parameters: Any) -> Texture:
    """Packed texture of one drawing; `parameters` are those of `build_tree`."""
    return encode([build_tree(drawing, **parameters)], [Root(drawing.name)], name=drawing.name)


def packed_source(is_flat: bool = False) -> str:
    """Fragment shader of the packed encoding: for any view, or for those whose pixels are upright and alike."""
    inputs = shader_source(VERSION) + "uniform uint root;\nuniform uvec2 base;\n"
    if is_flat:
        return fragment(inputs + FLAT_INPUTS, f"vextureFlatCoverage(root, base, uv, {FLAT_VIEW})")
    return fragment(inputs, "vextureCoverage(root, base, uv, dx, dy)")


def packed_program(texture: Texture, is_flat: bool = False, root: int = 0) -> Program:
    """Program of `packed_source` for a texture."""
    source = packed_source(is_flat)
    constants = {name: float(value) for name, value in re.findall(r"#define VEXTURE_(\w+) ([-.e\d]+)\n", source)}
    textures = {"vextureTexels": nearest(texture.texels, "u4")}
    uniforms = {"root": texture.roots[root].quad}
    return Program("flat" if is_flat else "any", constants, compile_shader(source), textures, uniforms, True, is_flat)


def thesis_source(sizes: TextureSizes) -> str:
    """Fragment shader of the thesis's encoding."""
    inputs = "uniform sampler2D quads;\nuniform sampler2D curves;\n"
    return compose(VERSION, "coverage.glsl", inputs + main_calling("coverage(quads, curves, uv, dx, dy)"), sizes)


def thesis_program(texture: ThesisTexture) -> Program:
    """Program of the thesis's encoding for a texture."""
    sizes = TextureSizes.of_texture(texture, current_context().info["GL_MAX_TEXTURE_SIZE"])
    textures = {
        name: nearest(fold(rows, sizes.fold_height), "f4")
        for name, rows in (("quads", texture.quads), ("curves", texture.curves))
    }
    lengths = {"list_lengths": (len(texture.quads), len(texture.curves))}
    constants = {"SAMPLES": method.SAMPLES, "bits": 8 * texture.quads.dtype.itemsize}
    return Program("thesis", constants, compile_shader(thesis_source(sizes)), textures, lengths)


def fetch_source() -> str:
    """Fragment shader of one fetch from a picture."""
    return fragment("uniform sampler2D image;\n", "texture(image, uv).x")


def fetch_program(drawing: Drawing) -> Program:
    """Program of one trilinear fetch from a mip-mapped picture of the drawing: the upper limit of speed."""
    size = (IMAGE_SIDE, IMAGE_SIDE)
    pixels = np.rint(255.0 * render_exact(drawing, size)).astype(np.uint8)[::-1]
    made = current_context().texture(size, 1, np.ascontiguousarray(pixels).tobytes())
    made.build_mipmaps()
    made.filter = (0x2703, 0x2601)  # GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR
    return Program("fetch", {"side": IMAGE_SIDE}, compile_shader(fetch_source()), {"image": made})
