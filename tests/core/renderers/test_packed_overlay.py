"""The overlays' shader against the texture's tree as Python reads it, cell by cell."""

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hand import need_gpu
from numpy.typing import NDArray

from cells import Cells, finest_level
from vexture.base.layout import COVERAGE_ONE, MOST_DEPTH
from vexture.conversion.pipeline import convert
from vexture.renderers.device import context
from vexture.renderers.shader import VERSIONS, shader_text, vertex_source
from vexture.renderers.view import view_base, window
from vexture.texture.texture import Texture

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"
SIZE = (210, 210)
WEB = "300 es"

MAIN = """
uniform mat3 to_unit;
uniform uvec2 base;
out vec4 shown;
void main() {
    vec2 offset = (to_unit * vec3(gl_FragCoord.xy, 1.0)).xy;
    shown = vextureOverlay(vec4(0.25, 0.5, 0.75, 1.0), base, offset, to_unit[0].xy, to_unit[1].xy);
}
"""
PICTURE = np.array([0.25, 0.5, 0.75])
EMPTY, FULL = np.array([1.0, 0.9, 0.8]), np.array([0.0, 0.2, 0.4])
DEPTHS = np.stack([np.arange(MOST_DEPTH + 1) / MOST_DEPTH, *np.zeros((2, MOST_DEPTH + 1))], axis=1)


@cache
def program() -> Any:
    gl = context()
    fragment = VERSIONS[WEB] + shader_text("overlay.glsl") + MAIN
    return gl.vertex_array(gl.program(vertex_shader=vertex_source(WEB), fragment_shader=fragment), [])


def overlay(
    texture: Texture,
    matrix: NDArray[np.float64],
    show: tuple[float, float, float] = (0.0, 0.0, 0.0),
    cutoff: float = 0.0,
) -> NDArray[np.float32]:
    need_gpu()
    base = view_base(matrix, SIZE)
    relative = matrix.copy()
    relative[:2] -= np.outer(base, matrix[2]) / 2.0**32
    with context() as gl:
        triangle = program()
        uniforms = triangle.program
        rows, width = texture.texels.shape[:2]
        uploaded = gl.texture((width, rows), 4, np.ascontiguousarray(texture.texels).tobytes(), dtype="u4")
        uploaded.filter = (gl.NEAREST, gl.NEAREST)
        uploaded.use(0)
        uniforms["vextureTexels"] = 0
        uniforms["to_unit"].write(relative.T.astype(np.float32).tobytes())
        uniforms["base"] = base
        uniforms["vextureOverlayRoot"] = texture.roots[0].quad
        uniforms["vextureOverlayShow"] = show
        uniforms["vextureOverlayCutoff"] = cutoff
        uniforms["vextureOverlayCoverage"].write(np.array([EMPTY, FULL], np.float32).tobytes())
        uniforms["vextureOverlayStored"].write(np.array([FULL, EMPTY], np.float32).tobytes())
        uniforms["vextureOverlayDepth"].write(DEPTHS.astype(np.float32).tobytes())
        image = gl.texture(SIZE, 4, dtype="f4")
        target = gl.framebuffer([image])
        target.use()
        triangle.render(vertices=3)
        pixels = np.frombuffer(target.read(components=4, dtype="f4"), np.float32).reshape(*SIZE[::-1], 4).copy()
        for made in (target, image, uploaded):
            made.release()
    assert (pixels[..., 3] == 1.0).all()
    return pixels[..., :3]


@cache
def texture_of(name: str) -> Texture:
    texture = convert(SHAPES / f"{name}.svg", capacity=4)
    assert isinstance(texture, Texture)
    return texture


WINDOWS = {
    "whole": window(-0.1, -0.1, 1.2, 1.2).matrix(SIZE),
    "100x": window(0.4937, 0.17, 0.01, 0.01).matrix(SIZE),
    "10,000x": window(0.5 - 3e-5, 0.25 - 2e-5, 1e-4, 1e-4).matrix(SIZE),
}


@pytest.mark.parametrize("name", ["duck", "ocean", "font"])
@pytest.mark.parametrize("view", WINDOWS)
def test_coverage_and_depth_are_those_of_the_cell_at_the_pixel(name: str, view: str) -> None:
    texture, matrix = texture_of(name), WINDOWS[view]
    cells = Cells(texture, matrix, SIZE, finest_level(matrix))
    depth = overlay(texture, matrix, (0.0, 0.0, 1.0))
    assert np.abs(depth - DEPTHS[cells.depth])[cells.inside].max() < 1e-5
    shade = overlay(texture, matrix, (0.0, 0.5, 0.0))
    expected = 0.5 * PICTURE + 0.5 * (EMPTY + cells.coverage[..., None] * (FULL - EMPTY))
    assert np.abs(shade - expected)[cells.inside].max() < 1e-5
    for shown in (depth, shade):
        assert (shown[~cells.inside] == PICTURE.astype(np.float32)).all()


@pytest.mark.parametrize("name", ["duck", "ocean"])
@pytest.mark.parametrize("view", WINDOWS)
def test_borders_are_one_pixel_wide_at_each_zoom(name: str, view: str) -> None:
    texture, matrix = texture_of(name), WINDOWS[view]
    cells = Cells(texture, matrix, SIZE, finest_level(matrix))
    shown = overlay(texture, matrix, (1.0, 0.0, 0.0))
    drawn = 1.0 - shown[..., 0] / PICTURE[0] if shown[..., 0].max() <= PICTURE[0] + 1e-6 else None
    light = (shown[..., 0] - PICTURE[0]) / (1.0 - PICTURE[0]) if drawn is None else drawn
    assert cells.border[cells.inside].max() > 0.5
    assert np.abs(light - cells.border)[cells.inside].max() < 0.01


@pytest.mark.parametrize("cutoff", [3.6, 5.0, 8.0])
def test_at_the_cut_off_quads_show_what_they_store(cutoff: float) -> None:
    texture, matrix = texture_of("ocean"), WINDOWS["whole"]
    cells = Cells(texture, matrix, SIZE, finest_level(matrix, cutoff))
    shown = overlay(texture, matrix, cutoff=cutoff)
    stored = FULL + cells.coverage[..., None] * (EMPTY - FULL)
    expected = np.where(cells.is_quad[..., None], stored, PICTURE)
    assert cells.is_quad.any()
    rounded = np.where(cells.is_quad[..., None], 1.0 / COVERAGE_ONE, 0.0)  # it shows the mean of the quad's cells
    assert (np.abs(shown - expected) <= rounded + 1e-5)[cells.inside].all()


def test_many_small_cells_do_not_turn_a_view_grey() -> None:
    texture, matrix = texture_of("ocean"), window(-2.0, -2.0, 5.0, 5.0).matrix(SIZE)
    shown = overlay(texture, matrix, (1.0, 0.0, 0.0))
    cells = Cells(texture, matrix, SIZE, finest_level(matrix))
    assert np.abs(shown - PICTURE)[cells.inside].mean() < 0.15


def test_nothing_switched_on_changes_nothing() -> None:
    shown = overlay(texture_of("duck"), WINDOWS["whole"])
    assert (shown == PICTURE.astype(np.float32)).all()
