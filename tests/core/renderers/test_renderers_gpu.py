import math
from typing import Any

import numpy as np
import pytest
from hand import need_gpu
from numpy.typing import NDArray
from packed_views import ENTRIES, texture_of, turned_view

from vexture.base.errors import ParameterError
from vexture.drawing.drawing import Drawing, Path
from vexture.renderers.cpu import render_cpu
from vexture.renderers.device import context
from vexture.renderers.exact import render_exact
from vexture.renderers.gpu import render_gpu
from vexture.renderers.shader import VERSIONS, shader_source, vertex_source, view_source
from vexture.renderers.view import window
from vexture.texture.encode import encode
from vexture.texture.texture import Root, Texture
from vexture.tree.build import build_tree

K = 0.5522847498
STEP = 1 / 255


def blob() -> Drawing:
    """A ring of cubics with a straight-edged hole: curves, corners and a winding of both signs."""
    arcs = []
    for quarter in range(4):
        turn = np.linalg.matrix_power(np.array([[0.0, -1.0], [1.0, 0.0]]), quarter)
        arcs.append(np.array([(1, 0), (1, K), (K, 1), (0, 1)]) @ turn.T * 0.41 + (0.52, 0.47))
    for arc, following in zip(arcs, arcs[1:] + arcs[:1], strict=True):
        arc[3] = following[0]
    hole = Drawing.polygon([(0.4, 0.35), (0.45, 0.61), (0.66, 0.52)]).paths[0].contours[0]
    return Drawing((Path((np.array(arcs), hole)),), name="blob")


def straight(a: tuple[float, float], b: tuple[float, float]) -> NDArray[np.float64]:
    return np.linspace(a, b, 4)


def mean_error(drawing: Drawing, size: tuple[int, int], view: NDArray[np.float64], **options: float) -> float:
    truth = render_exact(drawing, size, view)
    image = render_gpu(texture_of(drawing, **options), size, view)
    assert np.isfinite(image).all()
    touched = np.maximum(image, truth) > 0.0001
    return float(np.abs(image - truth)[touched].mean() / STEP)


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.parametrize("pixels", [1, 4, 16, 90, 400])
def test_upright_pixels_get_their_exact_coverage(pixels: float, entry: str) -> None:
    need_gpu()
    assert mean_error(blob(), *ENTRIES[entry](turned_view(pixels, 0.0))) < 0.1


@pytest.mark.parametrize(("degrees", "narrow"), [(30, 1), (45, 8), (-70, 3)])
@pytest.mark.parametrize("pixels", [12, 90])
def test_exact_is_exact_at_every_tilt(pixels: float, degrees: float, narrow: float) -> None:
    need_gpu()
    assert mean_error(blob(), *turned_view(pixels, degrees, narrow)) < 0.1


def test_a_plane_to_the_horizon() -> None:
    need_gpu()
    view = np.array([[0.02, 0.0, -0.5], [0.001, -0.02, 1.1], [0.0, 0.012, 0.1]])
    assert mean_error(blob(), (97, 64), view) < 2.0


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.parametrize(("zoom", "precision"), [(1e3, None), (1e4, 1e-7)])
def test_no_step_where_the_outline_crosses_a_cell_border(entry: str, zoom: float, precision: float | None) -> None:
    need_gpu()
    options = {} if precision is None else {"precision": precision}
    texture = texture_of(blob(), **options)
    width = 0.2 / zoom
    for x, y in [(0.5, 0.47 + math.sqrt(0.41**2 - 0.02**2)), (0.5, 0.47 - math.sqrt(0.41**2 - 0.02**2))]:
        near = window(x - width / 2, y - width / 2, width, width).matrix((200, 200))
        _, view = ENTRIES[entry](((200, 200), near))
        image, truth = render_gpu(texture, (200, 200), view), render_exact(blob(), (200, 200), view)
        off = (image - truth).sum(axis=0, dtype=np.float64)
        assert np.abs(np.diff(off)).max() < 0.05
        assert np.abs(off).max() < (0.5 if precision else 150)


def test_the_inside_is_plain_though_a_step_of_t_is_a_part_of_a_pixel() -> None:
    need_gpu()
    steep = np.array([(0.1, 0.1), (0.1, 0.85), (0.9, 0.15), (0.9, 0.9)])
    contour = np.array([steep, straight((0.9, 0.9), (0.9, 0.1)), straight((0.9, 0.1), (0.1, 0.1))])
    view = window(0.4999, 0.0999, 2e-4, 2e-4).matrix(
        (200, 200)
    )  # on the straight side, far from the curve in the same leaf
    drawing = Drawing((Path((contour,)),), name="s")
    image = render_gpu(texture_of(drawing), (200, 200), view)
    assert render_exact(drawing, (200, 200), view)[:90].min() == 1.0
    assert image[:90].min() > 0.999


@pytest.mark.parametrize("upright", [False, True])
@pytest.mark.parametrize("backwards", [False, True])
def test_an_s_curve_has_no_speckles(upright: bool, backwards: bool) -> None:
    need_gpu()
    curve = np.array([(0.1, 0.1), (0.85, 0.1), (0.15, 0.9), (0.9, 0.9)])
    contour = np.array([curve, straight((0.9, 0.9), (0.1, 0.9)), straight((0.1, 0.9), (0.1, 0.1))])
    contour = contour[:, :, ::-1] if upright else contour
    contour = contour[::-1, ::-1].copy() if backwards else contour
    drawing = Drawing((Path((contour,)),), name="s")
    image = render_gpu(texture_of(drawing), (700, 700))
    assert np.abs(image - render_exact(drawing, (700, 700))).max() < 4 * STEP


@pytest.mark.parametrize("renderer", [render_cpu, render_gpu])
@pytest.mark.parametrize("pixels", [63, 64, 128, 256])
def test_a_pixel_whose_search_starts_where_the_piece_stands_still(pixels: int, renderer: Any) -> None:
    """At this flat inflection both derivatives are nothing: the search must leave it."""
    if renderer is render_gpu:
        need_gpu()
    a, b = (0.0, 0.8431625601235806), (0.796875, 0.109375)
    curve = [a, (0.1748046875, 0.5546875), (0.49668078464495724, 0.7266572749339014), b]
    drawing = Drawing((Path((np.array([curve, [b, a, b, a]]),)),))
    image = renderer(texture_of(drawing), pixels)
    assert np.abs(image - render_exact(drawing, pixels)).max() < STEP


@pytest.mark.parametrize("version", VERSIONS)
def test_the_shader_compiles_in_both_dialects(version: str) -> None:
    need_gpu()
    with context() as gl:
        for is_flat in (False, True):
            fragment = view_source(version, is_flat)
            assert fragment.startswith(f"#version {version}\n")
            gl.program(vertex_shader=vertex_source(version), fragment_shader=fragment).release()
        main = "out float c;\nin vec2 uv;\nvoid main() { c = vextureCoverage(3u, uv, dFdx(uv), dFdy(uv)); }\n"
        vertex = (
            VERSIONS[version] + "out vec2 uv;\nvoid main() { uv = vec2(gl_VertexID); gl_Position = vec4(uv, 0, 1); }\n"
        )
        gl.program(vertex_shader=vertex, fragment_shader=VERSIONS[version] + shader_source(version) + main).release()


def test_nothing_lies_outside_the_square_and_its_edge_is_smoothed() -> None:
    need_gpu()
    everything = texture_of(Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]))
    image = render_gpu(everything, (6, 4), [[0.25, 0, -0.125], [0, -0.25, 1.0625]])
    np.testing.assert_allclose(image[1:-1], [[0.5, 1, 1, 1, 0.5, 0]] * 2, atol=1e-6)
    np.testing.assert_allclose(image[:, 2], [0.75, 1, 1, 1], atol=1e-6)


@pytest.mark.parametrize("renderer", [render_cpu, render_gpu])
@pytest.mark.parametrize(("wide", "pixels"), [(16, 3), (20, 3), (30, 3), (64, 9)])
def test_pixels_wider_than_the_square(wide: float, pixels: int, renderer: Any) -> None:
    """Their boxes do not fit the shader's integers, and their centres lie far from the square."""
    if renderer is render_gpu:
        need_gpu()
    everything = Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    view = np.array([[wide / pixels, 0.0, 0.5 - wide / 2], [0.0, -1 / pixels, 1.0], [0.0, 0.0, 1.0]])
    image = renderer(texture_of(everything), (pixels, pixels), view)
    assert np.abs(image - render_exact(everything, (pixels, pixels), view)).max() < 0.01 * STEP


@pytest.mark.parametrize("renderer", [render_cpu, render_gpu])
def test_nothing_shows_above_a_plane_near_its_horizon(renderer: Any) -> None:
    if renderer is render_gpu:
        need_gpu()
    everything = Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    view = np.array([[0.012, 0.0, -0.15], [0.0, -0.008, 0.8], [0.0, 0.022, -0.1]])
    image = renderer(texture_of(everything), (100, 100), view)
    truth = render_exact(everything, (100, 100), view)
    assert not image[:20].any()
    assert np.abs(image - truth).max() < 4 * STEP


def test_one_texture_holds_many_shapes() -> None:
    need_gpu()
    shapes = [Drawing.polygon([(0.1, 0.1), (0.8, 0.2), (0.4, 0.9)]), blob()]
    together = encode([build_tree(shape) for shape in shapes], [Root("a"), Root("b")], name="both")
    for root, shape in enumerate(shapes):
        alone = render_gpu(texture_of(shape), (50, 50))
        np.testing.assert_array_equal(render_gpu(together, (50, 50), root=root), alone)


def test_random_bits_end_and_are_numbers() -> None:
    need_gpu()
    bits = np.random.default_rng(7).integers(0, 1 << 32, (3, 2048, 4), dtype=np.uint32)
    image = render_gpu(Texture(bits, (Root("noise"),)), (40, 40))
    assert np.isfinite(image).all()
    assert image.min() >= 0.0
    assert image.max() <= 1.0


def test_a_version_that_does_not_exist_is_named() -> None:
    with pytest.raises(ParameterError, match="'100'"):
        shader_source("100")


def test_the_text_can_be_pasted() -> None:
    text = shader_source()
    assert "#version" not in text
