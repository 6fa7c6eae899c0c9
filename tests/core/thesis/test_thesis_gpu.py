import numba
import numpy as np
import pytest
from hand import CHORDS, EMPTY, FULL, NEAR, TREE, Floats, distance, need_gpu, speckles, texture_of, view_of
from numpy.typing import NDArray

from vexture.base.errors import FormatError
from vexture.conversion.images import coverage
from vexture.renderers.device import context
from vexture.renderers.shader import vertex_source
from vexture.thesis.cpu import render_thesis_cpu
from vexture.thesis.shader_text import compose
from vexture.thesis.texture import ThesisTexture, fold, program, render_thesis_gpu

SHIFT = 0.00123  # so that no point falls on the edge of a cell


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize("size", [3, 61, pytest.param(250, marks=pytest.mark.slow)])
def test_the_tree_of_everything_is_drawn_as_counted(size: int, bits: int) -> None:
    need_gpu()
    texture, view = texture_of(TREE, bits), view_of((SHIFT, SHIFT), 0.99, size)
    image = coverage(texture, (size, size), view)
    assert image.dtype == np.float32
    assert speckles(texture, image, view) == 0
    assert np.abs(image - render_thesis_cpu(texture, (size, size), view)).max() <= 1 / 16


def test_a_tilted_view_is_the_mirrors() -> None:
    need_gpu()
    texture = texture_of(TREE)
    tilted = [[0.02, 0.0, -0.5], [0.001, -0.02, 1.1], [0.0, 0.012, 0.1]]
    on_gpu, on_cpu = (f(texture, (97, 64), tilted) for f in (render_thesis_gpu, render_thesis_cpu))
    assert on_cpu.mean() > 0.05
    assert np.abs(on_gpu - on_cpu).mean() < 1e-3


def test_beyond_the_horizon_is_nothing() -> None:
    need_gpu()
    horizon = [[0.05, 0.0625, -0.25], [0.0, 0.0625, -0.23], [0.0, 0.125, -0.5]]  # at the middle of the image
    image = render_thesis_gpu(texture_of([FULL] * 4), (8, 8), horizon)
    assert not image[:4].any()
    assert image[-1, :3].all()


def test_the_edge_of_the_square_is_smoothed() -> None:
    need_gpu()
    image = render_thesis_gpu(texture_of([FULL] * 4), (6, 4), [[0.25, 0, -0.125], [0, -0.25, 1.0625]])
    np.testing.assert_allclose(image[1:-1], [[0.5, 1, 1, 1, 0.5, 0]] * 2)
    np.testing.assert_allclose(image[:, 2], [0.75, 1, 1, 1])


@pytest.mark.parametrize("fold_height", [1, 3, 5, 1000])
def test_a_folded_texture_is_the_same_picture(fold_height: int) -> None:
    need_gpu()
    texture = texture_of(TREE)
    assert len(texture.curves) > 2 * 5
    np.testing.assert_array_equal(
        render_thesis_gpu(texture, (64, 64), fold_height=fold_height), render_thesis_gpu(texture, (64, 64))
    )


def test_folding_puts_the_next_rows_on_the_right() -> None:
    rows = np.arange(5 * 2 * 3, dtype=np.uint8).reshape(5, 2, 3)
    folded = fold(rows, 2)
    assert folded.shape == (2, 6, 4)
    for row in range(5):
        block = folded[row % 2, row // 2 * 2 : row // 2 * 2 + 2, :3]
        np.testing.assert_array_equal(block, rows[row] / np.float32(255))


def test_the_longest_list_is_read_to_its_last_row() -> None:
    need_gpu()
    curves = np.zeros((65_000, 2, 3), np.uint16)
    curves[-1] = [(49_151, 41_000, 41_000), (16_384, 41_000, 41_000)]  # a diagonal
    quads = np.zeros((1, 4, 3), np.uint16)
    quads[0, :, 1] = 65_535, round(65_535 / 64_999), 0, round(65_535 * 64_998 / 64_999)
    texture = ThesisTexture(quads, curves)
    image = render_thesis_gpu(texture, (64, 64))
    np.testing.assert_array_equal(image, render_thesis_cpu(texture, (64, 64)))
    assert image[:32, :32].mean() == pytest.approx(0.5, abs=0.02)


def test_one_program_serves_all_textures_of_a_depth() -> None:
    need_gpu()
    render_thesis_gpu(texture_of([FULL, EMPTY, FULL, EMPTY]), (4, 4))
    made = program.cache_info().misses
    render_thesis_gpu(texture_of([FULL, *TREE[:1], FULL, EMPTY]), (5, 4))
    assert program.cache_info().misses == made


def test_a_texture_without_end_is_refused() -> None:
    need_gpu()
    with pytest.raises(FormatError, match="below itself"):
        render_thesis_gpu(
            ThesisTexture(np.full((1, 4, 3), (255, 0, 0), np.uint8), np.zeros((2, 2, 3), np.uint8)), (4, 4)
        )


MANY = """
uniform sampler2D controls;
uniform sampler2D points;
out float inside;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 control = texelFetch(controls, ivec2(0, at.y), 0);
    inside = inside_curve(control.xy, control.zw, texelFetch(points, at, 0).xy) ? 1.0 : 0.0;
}
"""


def inside_on_gpu(controls: Floats, points: Floats, text: str) -> NDArray[np.bool_]:
    """Test many points of many curves, in the bases of their chords and in float32, (curves, points)."""
    curves, count = points.shape[:2]
    with context() as gl:
        shader = gl.program(vertex_shader=vertex_source("330"), fragment_shader=text)
        given = gl.texture((1, curves), 4, controls.astype(np.float32).tobytes(), dtype="f4")
        places = gl.texture((count, curves), 2, points.astype(np.float32).tobytes(), dtype="f4")
        image = gl.texture((count, curves), 1, dtype="f4")
        given.use(0)
        places.use(1)
        shader["controls"], shader["points"] = 0, 1
        target = gl.framebuffer([image])
        target.use()
        gl.vertex_array(shader, []).render(vertices=3)
        return np.frombuffer(target.read(components=1, dtype="f4"), np.float32).reshape(curves, count) > 0.5


def chords_of(control: Floats, count: int) -> Floats:
    t = np.linspace(0, 1, count + 1)[:, None]
    return 3 * (1 - t) ** 2 * t * control[:2] + 3 * (1 - t) * t**2 * control[2:] + t**3 * (1, 0)


@numba.njit
def count_crossings(line, points):
    """Whether chords and rays are crossed an odd number of times above each point."""
    inside = np.zeros(len(points), np.bool_)
    for i in range(len(points)):
        x, y = points[i]
        odd = y < 0 and not 0 <= x < 1
        for j in range(len(line) - 1):
            (x0, y0), (x1, y1) = line[j], line[j + 1]
            if (x0 > x) != (x1 > x) and y0 + (x - x0) * (y1 - y0) / (x1 - x0) > y:
                odd = not odd
        inside[i] = odd
    return inside


def nearly(name: str, rng: np.random.Generator, count: int) -> Floats:
    """Control points P1 P2 in the basis of their chord, (count, 4), near a border between two solution paths."""
    kind, size = name.split()
    step = float(size)
    x1, x2, y1, y2 = rng.uniform(-2, 3, (4, count))
    nudge = step * rng.uniform(0.3, 1, count) * rng.choice([-1, 1], count)
    if kind == "free":
        return step * np.column_stack([x1, y1, x2, y2])
    if kind == "quadratic":  # a is nearly 0
        x2 = x1 + (1 - nudge) / 3
    if kind == "straight":  # a and b are
        x1, x2 = 1 / 3 + nudge, 2 / 3 + nudge * rng.uniform(-1, 1, count)
    if kind == "cusp":  # Delta_0 is
        x1 = rng.uniform(0.0, 4 / 3, count)
        x2 = (x1 + rng.choice([-1, 1], count) * np.sqrt(np.maximum(4 * x1 - 3 * x1 * x1, 0))) / 2 + nudge
    return np.column_stack([x1, y1, x2, y2])


def points_near(controls: Floats, rng: np.random.Generator, count: int) -> Floats:
    """Half of them anywhere, half close in x to where the curve turns, bends over or ends, (curves, count, 2)."""
    x1, _, x2, _ = controls.T[..., None]
    a, b, c = 3 * (x1 - x2) + 1, 3 * x2 - 6 * x1, 3 * x1
    root = np.sqrt(np.maximum(b * b - 3 * a * c, 0))
    with np.errstate(divide="ignore", invalid="ignore"):
        special = np.hstack(
            [(-b - root) / (3 * a), (-b + root) / (3 * a), -c / (2 * b), -b / (3 * a), 0 * a, 0 * a + 1]
        )
    t = np.clip(np.nan_to_num(special, nan=0.5), 0, 1)
    x = ((a * t + b) * t + c) * t
    reach = np.maximum(np.abs(controls).max(1), 1)[:, None]
    x = np.take_along_axis(x, rng.integers(0, x.shape[1], (len(controls), count)), 1)
    x += rng.choice([-1, 0, 1], x.shape) * reach * 10 ** rng.uniform(-8, -2, x.shape)
    x = np.where(rng.random(x.shape) < 0.5, x, rng.uniform(-1, 2, x.shape) * reach)
    return np.stack([x, rng.uniform(-1, 1, x.shape) * reach], axis=-1)


BORDERS = ["free 1", "free 7", "free 1000"]
BORDERS += [f"{kind} 1e-{digits}" for kind in ("quadratic", "straight", "cusp") for digits in range(1, 9)]


def worst_speckle(name: str, text: str) -> float:
    """Distance from the outline, in cells, of the point farthest from it that the shader puts on the wrong side."""
    rng = np.random.default_rng(1)
    controls = nearly(name, rng, 150).astype(np.float32).astype(float)
    points = points_near(controls, rng, 256).astype(np.float32).astype(float)
    worst = 0.0
    for control, place, inside in zip(controls, points, inside_on_gpu(controls, points, text), strict=True):
        line = chords_of(control, 2 * CHORDS)
        wrong = place[inside != count_crossings(line, place)]
        if len(wrong):
            cells = max(np.abs(control).max(), 1.0) / 3.5  # a cell, when the control points span as much as they can
            worst = max(worst, distance(line, wrong).max() / cells)
    return worst


@pytest.mark.parametrize("name", BORDERS)
def test_float32_draws_no_speckles_near_the_border_of_any_case(name: str) -> None:
    need_gpu()
    assert worst_speckle(name, compose("330", "inside.glsl", MANY)) < NEAR


@pytest.mark.parametrize("name", ["free 1", "quadratic 1e-2", "quadratic 1e-4", "cusp 1e-2", "cusp 1e-4"])
def test_a_gpu_with_coarse_functions_draws_none_either(name: str) -> None:
    need_gpu()
    text = compose("330", "inside.glsl", MANY)
    for exact in ("cos(angle / 3.0)", "cosh(acosh(ratio) / 3.0)", "pow(abs(q), 1.0 / 3.0)"):
        assert text.count(exact) == 1
        text = text.replace(exact, f"{exact} * (1.0 + 4.9e-4 * sin(1e5 * d))")  # Vulkan allows 2^-11
    assert worst_speckle(name, text) < NEAR
