"""A material of pygfx that shows a shape of a texture in one colour, by the shader in WGSL."""

from typing import Any

import numpy as np
import pygfx as gfx
from pygfx.renderers.wgpu import Binding, GfxTextureView, load_wgsl, register_wgpu_render_function
from pygfx.renderers.wgpu.shaders.meshshader import MeshShader

import vexture

ALPHA_TEST = "do_alpha_test(diffuse_color.a);"
COVERED = """let at = vec2f(varyings.texcoord.x, 1.0 - varyings.texcoord.y);  // pygfx counts v from the top
    diffuse_color.a *= vextureCoverage(t_vexture, {{ vexture_quad }}u, at, dpdx(at), dpdy(at));
    """


class VectorMaterial(gfx.MeshBasicMaterial):
    """A shape of a texture in one colour: its own, if it has one and no `color` is given."""

    def __init__(self, texture: vexture.Texture, root: int = 0, **others: Any) -> None:
        if (paint := texture.roots[root].paint) is not None:
            others.setdefault("color", (*paint.color, paint.opacity))
        super().__init__(alpha_mode="blend", **others)
        self.quad = int(texture.quads[root])
        rows, width = texture.texels.shape[:2]
        words = np.ascontiguousarray(texture.texels)
        self.texels = gfx.Texture(words, dim=2, format="rgba32uint", size=(width, rows, 1))


@register_wgpu_render_function(gfx.WorldObject, VectorMaterial)
class VectorShader(MeshShader):
    """pygfx's shader of meshes, in which a pixel counts by the share that the shape covers of it."""

    def get_bindings(self, wobject: Any, shared: Any, scene: Any) -> Any:
        """The texture coordinates, and the texture's words."""
        groups = super().get_bindings(wobject, shared, scene)
        self["used_uv"], self["vexture_quad"] = {0: 2}, wobject.material.quad
        uv = Binding("s_texcoords", "buffer/read_only_storage", wobject.geometry.texcoords, "VERTEX")
        texels = Binding("t_vexture", "texture/uint", GfxTextureView(wobject.material.texels), "FRAGMENT")
        groups[2] = {0: uv, 1: texels}
        self.define_bindings(2, groups[2])
        return groups

    def get_code(self) -> str:
        """What gives the functions, and the shader of meshes with a call of one."""
        code = load_wgsl("mesh.wgsl")
        assert ALPHA_TEST in code, "this pygfx has another mesh.wgsl"
        return vexture.shader_source("wgsl") + code.replace(ALPHA_TEST, COVERED + ALPHA_TEST)
