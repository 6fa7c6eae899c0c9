"""From coloured outlines to texels in one kernel: the same texels as in steps, and none where a limit is passed."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import vexture
from gradient_drawings import DRAWINGS, SQUARE, WARM, linear, painted_path, radial
from vexture import Drawing
from vexture.base.errors import SourceError
from vexture.base.layout import MAP_HEAD
from vexture.base.tolerance import UNSEEN
from vexture.drawing.drawing import Path as Outline
from vexture.drawing.paint import Paint, Spread
from vexture.drawing.unit_square import FARTHEST
from vexture.texture.map_entry import coloured_texels
from vexture.tree.bounds import DEFAULT_DEPTH, bounds_of
from vexture.tree.planar.build import DEFAULT_MAP_CAPACITY, build_map
from vexture.tree.planar.source import source_of
from vexture.tree.tree import MOST_QUADS

pytestmark = pytest.mark.slow  # compiling takes minutes; tests/web/test_conversion_in_node.py has its WebAssembly

SHAPES = sorted((Path(__file__).parents[3] / "examples" / "shapes").glob("*.svg"))
BOUNDS = bounds_of(UNSEEN, DEFAULT_DEPTH, DEFAULT_MAP_CAPACITY, None, MOST_QUADS)
ENDLESS = 2**62


def check(drawing: Drawing, restyle: bool = False) -> None:
    wanted = vexture.convert(drawing, split="faces", restyle=restyle)
    arrays = source_of(drawing, restyle)
    texels, starts, members, hides, *numbers = coloured_texels(arrays, BOUNDS, int(restyle), 0, ENDLESS, ENDLESS)
    np.testing.assert_array_equal(texels, wanted.flat[: len(texels)])
    assert not wanted.flat[len(texels) :].any()
    outside, reach, deviation, unresolved, *_, paints, flattened = numbers
    assert 0.0 <= outside <= 1e-9
    assert 0.0 <= reach <= FARTHEST
    assert 0.0 <= deviation <= UNSEEN
    assert (unresolved, paints, flattened) == (0, int(texels[1, 0]), 0)
    assert (len(starts), starts[-1]) == (paints + 1, len(members))
    if restyle:
        style, element = wanted.roots[0].style, arrays.paths[:, 2]
        np.testing.assert_array_equal(style.starts, starts)
        np.testing.assert_array_equal(style.members, element[members])
        assert set(element[hides == 1]) == set(np.flatnonzero(style.hides))


@pytest.mark.parametrize("name", DRAWINGS)
def test_texels_of_one_kernel_are_those_of_a_texture(name: str) -> None:
    check(DRAWINGS[name])


@pytest.mark.parametrize("restyle", [False, True])
def test_texels_of_examples(restyle: bool) -> None:
    ground = painted_path(SQUARE, Paint((1.0, 0.0, 0.0)))
    for drawing in map(vexture.read, SHAPES):
        named = (replace(path, element=str(k), hides=k == 0) for k, path in enumerate(drawing.paths))
        check(replace(drawing, paths=(ground, *named)), restyle)


def test_texels_of_the_second_shape_of_a_texture() -> None:
    drawing = DRAWINGS["groups"]
    both = vexture.atlas([drawing, replace(drawing, name="second")])
    first = both.roots[1].quad - MAP_HEAD
    texels, *_ = coloured_texels(source_of(drawing), BOUNDS, 0, first, ENDLESS, ENDLESS)
    np.testing.assert_array_equal(texels, both.flat[first : first + len(texels)])


def test_no_texels_where_a_limit_is_passed() -> None:
    corners = np.random.default_rng(1).random((60, 2))
    star, ground = Drawing.polygon(corners).paths[0], painted_path(SQUARE, Paint((1.0, 0.0, 0.0)))
    source = source_of(Drawing((ground, star)))
    *_, quads, curves, paints, _ = coloured_texels(source, BOUNDS, 0, 0, ENDLESS, ENDLESS)
    assert paints > 0
    size = 3 * quads + curves + curves // 4
    many = 10**6
    passed_at_last = ((quads - 1, ENDLESS, ENDLESS), (many, size - 1, ENDLESS))  # by the last cell
    for most_quads, most_texels, most_work in (
        *passed_at_last,
        (5, ENDLESS, ENDLESS),
        (many, size // 2, ENDLESS),
        (many, size, 9),
    ):
        limits = BOUNDS._replace(most_quads=most_quads)
        answer = coloured_texels(source, limits, 0, 0, most_texels, most_work)
        texels, _, _, _, outside, *_, quads, curves, paints, _ = answer
        assert (len(texels), outside, paints) == (0, 0.0, 0)
        assert (quads > most_quads) == (most_quads < many)
        assert (3 * quads + curves + curves // 4 > most_texels) == (most_texels < size)


@pytest.mark.parametrize("far", [1.25, -1e300, np.inf, np.nan])
def test_no_texels_of_an_outline_outside_the_square(far: float) -> None:
    source = source_of(DRAWINGS["repeated"])
    source = source._replace(cubics=source.cubics.copy())  # the drawing's own array is that of other tests, too
    source.cubics[1, 0, 1] = far
    texels, _, _, _, outside, *_ = coloured_texels(source, BOUNDS, 0, 0, ENDLESS, ENDLESS)
    assert len(texels) == 0
    assert not outside <= 1e-9


def test_a_band_that_goes_too_far_is_refused() -> None:
    wide = replace(radial((0.5, 0.5), 0.1, WARM, Spread.REPEAT), to_ramp=((1.0, 0.0, 0.0), (1.0, 1e-12, 0.0)))
    drawing = Drawing((painted_path(SQUARE, wide),))
    texels, _, _, _, _, reach, *_ = coloured_texels(source_of(drawing), BOUNDS, 0, 0, ENDLESS, ENDLESS)
    assert len(texels) == 0
    assert not reach <= FARTHEST
    with pytest.raises(SourceError, match=r"times the size of the drawing away; the limit is 1e\+09"):
        build_map(drawing)


def test_a_path_without_contours_takes_no_part() -> None:
    square = painted_path(SQUARE, linear((0, 0), (1, 1), WARM))
    empty = replace(square, contours=())
    assert isinstance(empty, Outline)
    one, other = (
        coloured_texels(source_of(Drawing(paths)), BOUNDS, 0, 0, ENDLESS, ENDLESS)[0]
        for paths in ((square,), (empty, square, empty))
    )
    np.testing.assert_array_equal(one, other)
