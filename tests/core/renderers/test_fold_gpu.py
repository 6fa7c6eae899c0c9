"""The fold's shader on the GPU against its mirror, place by place."""

from typing import Any

import numpy as np
import pytest
from hand import need_gpu
from numpy.typing import NDArray

from vexture.fold import layout
from vexture.fold.blend import fold as folded
from vexture.fold.fold import Fold
from vexture.renderers.device import context
from vexture.renderers.shader import VERSIONS, WRAPS, shader_text, vertex_source

SIZE = 64
WEB = "300 es"
MAIN = """
uniform uvec2 base;
uniform vec4 view;
layout(location = 0) out vec4 where;
layout(location = 1) out vec4 across;
void main() {
    vec2 offset = view.xy + view.zw * gl_FragCoord.xy;
    VextureFolded found = vextureFold(base, offset, vec2(view.z, 0.0), vec2(0.0, view.w));
    where = vec4(found.uv - offset, 0.0, 1.0);
    across = vec4(found.dx / view.z, found.dy / view.w);
}
"""


def wild(seed: int = 3) -> Fold:
    """Every kind, everywhere another time."""
    rng = np.random.default_rng(seed)
    shape = (9, 14)
    begin, duration = rng.uniform(0.0, 3.9, shape), rng.uniform(0.5, 4.0, shape)
    return Fold(rng.uniform(-0.05, 0.05, (*shape, 2)), rng.integers(0, 5, shape), begin, duration, 4.0)


def on_gpu(fold: Fold, wrap: str, base: tuple[int, int], view: tuple[float, ...], seconds: float) -> Any:
    """Displacements (n, 2) and Jacobians (n, 2, 2), row by row from below."""
    need_gpu()
    with context() as gl:
        fragment = f"{VERSIONS[WEB]}#define VEXTURE_WRAP {WRAPS[wrap]}\n" + shader_text("fold.glsl", layout) + MAIN
        triangle = gl.vertex_array(gl.program(vertex_shader=vertex_source(WEB), fragment_shader=fragment), [])
        uploaded = gl.texture(fold.size, 4, np.ascontiguousarray(fold.texels).tobytes(), dtype="u4")
        uploaded.filter = (gl.NEAREST, gl.NEAREST)
        uploaded.use(0)
        values = {"vextureFolding": 0, "vextureTime": fold.clock(seconds), "vextureCycle": fold.cycle}
        for name, value in {**values, "base": base, "view": view}.items():
            triangle.program[name] = value
        images = [gl.texture((SIZE, SIZE), 4, dtype="f4") for _ in range(2)]
        target = gl.framebuffer(images)
        target.use()
        triangle.render(vertices=3)
        found = [np.frombuffer(image.read(), np.float32).reshape(-1, 4).astype(float) for image in images]
        for made in (target, *images, uploaded, triangle):
            made.release()
    return found[0][:, :2], found[1].reshape(-1, 2, 2).transpose(0, 2, 1)


def on_cpu(fold: Fold, wrap: str, base: tuple[int, int], view: tuple[float, ...], seconds: float) -> Any:
    y, x = np.mgrid[0:SIZE, 0:SIZE] + 0.5
    low, step = np.float32(view[:2]).astype(float), np.float32(view[2:]).astype(float)
    offset: NDArray[np.float64] = low + step * np.stack([x.ravel(), y.ravel()], axis=1)
    now = fold.displacement * fold.progress(seconds)[..., None]
    bases = np.broadcast_to(np.array(base, np.uint32), offset.shape)
    right, up = np.broadcast_to((1.0, 0.0), offset.shape), np.broadcast_to((0.0, 1.0), offset.shape)
    found = folded(now, wrap, bases, offset, right, up)
    return found.uv - offset, np.stack([found.dx, found.dy], axis=2)


@pytest.mark.parametrize("wrap", WRAPS)
@pytest.mark.parametrize("seconds", [0.0, 1.3, 3.99, 86401.7])
def test_the_shader_folds_as_its_mirror_does(wrap: str, seconds: float) -> None:
    for base, view in (((0, 0), (-0.3, -0.6, 1.7 / 64, 2.1 / 64)), ((3 << 29, 5 << 28), (-0.2, -0.1, 0.01, 0.02))):
        moved, along = on_gpu(wild(), wrap, base, view, seconds)
        expected, jacobian = on_cpu(wild(), wrap, base, view, seconds)
        assert np.abs(moved - expected).max() < 2e-6
        assert np.abs(along - jacobian).max() < 2e-5
    assert np.abs(expected).max() > 0.01


@pytest.mark.parametrize(("magnified", "most"), [(1e3, 0.005), (1e4, 0.05), (1e5, 0.4)])
def test_nothing_trembles_far_into_the_picture(magnified: float, most: float) -> None:
    """Positions relative to a fixed point: what a pixel is off is a small part of a pixel."""
    pixel = 1.0 / (512.0 * magnified)
    base, view = (2_222_222_222, 1_717_171_717), (-32.0 * pixel, -32.0 * pixel, pixel, pixel)
    moved, _ = on_gpu(wild(), "none", base, view, 1.3)
    expected, _ = on_cpu(wild(), "none", base, view, 1.3)
    off = (moved - expected) / pixel
    assert np.abs(off - off.mean(axis=0)).max() < most
