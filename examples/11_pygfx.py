"""A drawing on a mesh in pygfx, by the shader in WGSL: a material of your own in forty lines, offscreen.

python examples/11_pygfx.py [FOLDER]        needs pygfx and rendercanvas (pip), and a GPU or a Vulkan driver
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pygfx as gfx
from PIL import Image
from pygfx.renderers.wgpu import Binding, GfxTextureView, load_wgsl, register_wgpu_render_function
from pygfx.renderers.wgpu.shaders.meshshader import MeshShader
from rendercanvas.offscreen import OffscreenRenderCanvas

import vexture

SHAPES = Path(__file__).parent / "shapes"
ALPHA_TEST = "do_alpha_test(diffuse_color.a);"
COVERED = """let at = vec2f(varyings.texcoord.x, 1.0 - varyings.texcoord.y);  // pygfx counts v from the top
    diffuse_color.a *= vextureCoverage(t_vexture, {{ vexture_quad }}u, at, dpdx(at), dpdy(at));
    """


class VectorMaterial(gfx.MeshBasicMaterial):
    """A shape of a texture in one colour."""

    def __init__(self, texture: vexture.Texture, root: int = 0, **others: Any) -> None:
        super().__init__(alpha_mode="blend", **others)
        self.quad = int(texture.quads[root])
        rows, width = texture.texels.shape[:2]
        words = np.ascontiguousarray(texture.texels)
        self.texels = gfx.Texture(words, dim=2, format="rgba32uint", size=(width, rows, 1))


@register_wgpu_render_function(gfx.WorldObject, VectorMaterial)
class VectorShader(MeshShader):
    """pygfx's shader of meshes, in which a pixel counts by the share that the shape covers of it."""

    def get_bindings(self, wobject: Any, shared: Any, scene: Any) -> Any:
        groups = super().get_bindings(wobject, shared, scene)
        self["used_uv"], self["vexture_quad"] = {0: 2}, wobject.material.quad
        uv = Binding("s_texcoords", "buffer/read_only_storage", wobject.geometry.texcoords, "VERTEX")
        texels = Binding("t_vexture", "texture/uint", GfxTextureView(wobject.material.texels), "FRAGMENT")
        groups[2] = {0: uv, 1: texels}
        self.define_bindings(2, groups[2])
        return groups

    def get_code(self) -> str:
        code = load_wgsl("mesh.wgsl")
        assert ALPHA_TEST in code, "this pygfx has another mesh.wgsl"
        return vexture.shader_source("wgsl") + code.replace(ALPHA_TEST, COVERED + ALPHA_TEST)


def main() -> None:
    """Draw the duck on a turned plane, and say how far a flat picture is from the exact one."""
    folder = Path(sys.argv[1] if sys.argv[1:] else ".")
    folder.mkdir(parents=True, exist_ok=True)
    drawing = vexture.read(SHAPES / "duck.svg")
    texture = vexture.convert(drawing)
    canvas = OffscreenRenderCanvas(size=(512, 512), pixel_ratio=1)
    renderer = gfx.WgpuRenderer(canvas, pixel_ratio=1, ppaa="none")
    plane = gfx.Mesh(gfx.plane_geometry(1, 1), VectorMaterial(texture, color="#fff"))
    scene = gfx.Scene().add(gfx.Background.from_color("#000"), plane)
    flat = gfx.OrthographicCamera(1, 1, maintain_aspect=True)
    canvas.request_draw(lambda: renderer.render(scene, flat))
    shown = np.asarray(canvas.draw())[..., 0] / 255.0
    light = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    exact = vexture.coverage(drawing, 512, renderer="exact")
    print(f"pygfx {gfx.__version__}: mean error {255 * np.abs(light - exact).mean():.3f} of 255")
    plane.local.euler = (-1.0, 0.4, 0.0)
    tilted = gfx.PerspectiveCamera(40, 1)
    tilted.local.position = (0, 0, 1.6)
    canvas.request_draw(lambda: renderer.render(scene, tilted))
    Image.fromarray(np.asarray(canvas.draw())).save(folder / "pygfx.png")


if __name__ == "__main__":
    main()
