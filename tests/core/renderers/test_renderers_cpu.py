"""The packed shader's mirror: against the shader, against the truth, and on random bits."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hand import need_gpu
from hypothesis import given, settings
from hypothesis import strategies as st
from packed_views import ENTRIES, View, texture_of, turned_view, views, zoomed_view

import corpora
import degenerate
from vexture.base.errors import VextureError
from vexture.drawing.drawing import Drawing
from vexture.drawing.drawing import Path as Outline
from vexture.renderers.cells import finest_bit
from vexture.renderers.cpu import render_cpu
from vexture.renderers.exact import render_exact
from vexture.renderers.gpu import render_gpu
from vexture.renderers.method import POSITION_BITS
from vexture.renderers.view import window
from vexture.svg.read import read_svg
from vexture.texture.texture import Root, Texture
from vexture.tree.build import build_tree
from vexture.tree.tree import Tree

STEP = 1 / 255
SHAPES = sorted((Path(__file__).parents[3] / "examples" / "shapes").glob("*.svg"))


def circles(across: int) -> Drawing:
    """A square grid of circles: many cells in every pixel, and chords at 45 degrees in every cell."""
    steps = (np.arange(across) + 0.5) / across
    return Drawing(tuple(Outline((degenerate.circle((x, y), 0.35 / across),)) for x in steps for y in steps))


def holed_disc(radius: float) -> Drawing:
    hole = degenerate.polygon([(0.4, 0.35), (0.45, 0.61), (0.66, 0.52)])
    return Drawing((Outline((degenerate.circle((0.52, 0.47), radius), hole)),))


def icon(index: int) -> Drawing:
    return read_svg(corpora.mdi(index + 1, seed=2)[index])


def letter(character: str) -> Drawing:
    return corpora.glyphs(corpora.dejavu_sans(), character)[0]


SOURCES: dict[str, tuple[Callable[..., Drawing], object]] = {
    **{path.stem: (read_svg, path) for path in SHAPES},
    **{f"letter {character}": (letter, character) for character in "g&8"},
    **{f"icon {index}": (icon, index) for index in range(3)},
    **{f"degenerate {seed}": (degenerate.drawing, seed) for seed in (5, 8, 12, 19, 21)},
    "circles": (circles, 8),
    "holed disc": (holed_disc, 0.41),
}


@cache
def source(name: str) -> tuple[Drawing, Texture]:
    read, what = SOURCES[name]
    try:
        drawing = read(what)
    except VextureError as error:
        pytest.skip(str(error))
    return drawing, texture_of(drawing)


def difference(texture: Texture, view: View) -> float:
    size, matrix = view
    cpu = render_cpu(texture, size, matrix)
    return float(np.abs(cpu - render_gpu(texture, size, matrix)).max() / STEP)


@pytest.mark.parametrize("name", SOURCES)
def test_the_shader_draws_what_its_mirror_draws(name: str) -> None:
    need_gpu()
    drawing, texture = source(name)
    for title, view in views(drawing):
        assert difference(texture, view) < 0.05, title


@pytest.mark.parametrize("name", ["duck", "letter g"])
def test_so_it_does_at_a_thousand_pixels(name: str) -> None:
    need_gpu()
    assert difference(source(name)[1], turned_view(1000, 0)) < 0.05


def test_so_it_does_in_deep_zoom() -> None:
    need_gpu()
    drawing = source("duck")[0]
    assert difference(texture_of(drawing, precision=1e-7), zoomed_view(drawing, 2.0**-14, 100)) < 0.05


@pytest.mark.parametrize("zoom", [10, 12, 14])
@pytest.mark.parametrize("name", ["simple-big", "holed disc"])
def test_deep_zoom_shows_no_line_where_pieces_meet_beside_the_view(name: str, zoom: int) -> None:
    need_gpu()
    width = 2.0**-zoom
    view = window(0.5 - width / 2, 0.5 - width / 2, width, width).matrix((128, 128))
    assert difference(source(name)[1], ((128, 128), view)) < 0.5


# --- the truth --------------------------------------------------------------------------------------------------------


def deepest(tree: Tree) -> int:
    """Level of the smallest leaves."""
    depth = np.ones(len(tree.is_quad), np.int64)
    for quad, cells in enumerate(tree.is_quad):
        below = tree.first_quad[quad] + np.arange(cells.sum())
        depth[below] = depth[quad] + 1
    return int(depth.max())


def errors(drawing: Drawing, view: View) -> tuple[float, float, bool]:
    """Mean and largest error in 1/255, and whether every pixel of an affine view sees the leaves themselves."""
    size, matrix = view
    tree = build_tree(drawing)
    texture = texture_of(drawing)
    error = np.abs(render_cpu(texture, size, matrix) - render_exact(drawing, size, matrix))
    steps = matrix[:2, :2]
    one = 2.0**POSITION_BITS
    finest = finest_bit(one**2 * abs(np.linalg.det(steps)), one**2 * (steps**2).sum(axis=0).max())
    return float(error.mean() / STEP), float(error.max() / STEP), deepest(tree) <= POSITION_BITS - finest


@st.composite
def plain_drawings(draw: st.DrawFn) -> Drawing:
    """A few contours: polygons on a coarse grid, circles, random cubics that may cross themselves and one another."""
    rng = np.random.default_rng(draw(st.integers(0, 10**9)))
    paths = []
    for kind in draw(st.lists(st.sampled_from(["polygon", "circle", "cubics"]), min_size=1, max_size=3)):
        if kind == "polygon":
            contour = degenerate.polygon(rng.permutation(81)[:5, None] // (9, 1) % 9 / 8)
        elif kind == "circle":
            contour = degenerate.circle(rng.integers(3, 6, 2) / 8, rng.integers(1, 4) / 8)
        else:
            n = int(rng.integers(2, 5))
            contour = degenerate.closed(rng.random((n, 2)) * 0.9 + 0.05, rng.random((n, 2, 2)) * 0.96 + 0.02)
        paths.append(Outline((contour,)))
    return Drawing(tuple(paths))


sizes = st.floats(8.0, 200.0)
angles = st.integers(0, 3600).map(lambda tenths: tenths / 10) | st.sampled_from([0.0, 30.0, 45.0, 90.0, 180.0, 270.0])


@settings(max_examples=60)
@given(plain_drawings(), sizes, angles, st.floats(1.0, 12.0))
def test_exact_is_the_footprints_exact_coverage(drawing: Drawing, pixels: float, degrees: float, narrow: float) -> None:
    mean, largest, leaves = errors(drawing, turned_view(pixels, degrees, narrow))
    assert mean < 0.3
    if leaves:
        assert largest < 1.0


@settings(max_examples=15)
@given(plain_drawings(), st.floats(0.005, 0.03), st.floats(0.0, 0.02))
def test_tilted_planes(drawing: Drawing, step: float, tilt: float) -> None:
    view = (97, 64), np.array([[step, 0.0, -0.3], [0.001, -step, 1.1], [0.0, tilt, 0.3]])
    assert errors(drawing, view)[0] < 0.5


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.parametrize(("seed", "pixels"), [(19, 61), (50, 100), (59, 100), (110, 100), (19, 200), (115, 200)])
def test_a_drawing_of_few_quads_is_exact_where_pixels_cut_them(seed: int, pixels: int, entry: str) -> None:
    """Quads that a pixel of these sizes cuts: by means alone it is off by up to 4/255."""
    drawing = degenerate.drawing(seed)
    texture = texture_of(drawing)
    for shift in (0.0, 0.37):
        matrix = np.array([[1 / pixels, 0.0, -shift / pixels], [0.0, -1 / pixels, 1 + shift / pixels], [0.0, 0.0, 1.0]])
        size, view = ENTRIES[entry](((pixels, pixels), matrix))
        assert np.abs(render_cpu(texture, size, view) - render_exact(drawing, size, view)).max() < STEP


def test_full_cells_fill_the_image() -> None:
    full_cells = np.array([[[0, 0, 0, 0xFFFFFFFF]]], np.uint32)
    image = render_cpu(Texture(full_cells, (Root("full"),)), (1, 1))
    np.testing.assert_allclose(image, [[1.0]])
    assert image.dtype == np.float32
