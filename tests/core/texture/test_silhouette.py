"""From outlines to texels in one kernel: the same texels as in steps, and none where a limit is passed."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import vexture
from vexture import Drawing
from vexture.base.tolerance import UNSEEN
from vexture.texture.silhouette import silhouette_texels
from vexture.tree.bounds import DEFAULT_CAPACITY, DEFAULT_DEPTH, bounds_of
from vexture.tree.cubics import outlines_of
from vexture.tree.tree import MOST_QUADS

SHAPES = sorted((Path(__file__).parents[3] / "examples" / "shapes").glob("*.svg"))
BOUNDS = bounds_of(UNSEEN, DEFAULT_DEPTH, DEFAULT_CAPACITY, None, MOST_QUADS)
TRIANGLE = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)])
ENDLESS = 2**62


@pytest.mark.parametrize("file", SHAPES, ids=[file.stem for file in SHAPES])
def test_texels_of_one_kernel_are_those_of_a_texture(file: Path) -> None:
    drawing = vexture.read(file)
    wanted = vexture.convert(drawing, split=None).flat
    texels, outside, deviation, unresolved, quads = silhouette_texels(*outlines_of(drawing), BOUNDS, 0, ENDLESS)
    np.testing.assert_array_equal(texels, wanted[: len(texels)])
    assert not wanted[len(texels) :].any()
    assert 0.0 <= outside <= 1e-9
    assert 0.0 <= deviation <= UNSEEN
    assert (unresolved, quads > 0) == (0, True)


def test_texels_of_the_second_shape_of_a_texture() -> None:
    both = vexture.atlas([TRIANGLE, replace(TRIANGLE, name="second")])
    first = both.roots[1].quad
    texels, *_ = silhouette_texels(*outlines_of(TRIANGLE), BOUNDS, first, ENDLESS)
    np.testing.assert_array_equal(texels, both.flat[first : first + len(texels)])


def test_no_texels_where_a_limit_is_passed() -> None:
    outlines = outlines_of(Drawing.polygon(np.random.default_rng(1).random((60, 2))))
    _, _, _, _, quads = silhouette_texels(*outlines, BOUNDS, 0, ENDLESS)
    for most_quads, most_work in ((quads - 5, ENDLESS), (MOST_QUADS, 100)):
        limits = BOUNDS._replace(most_quads=most_quads)
        texels, outside, *_, reached = silhouette_texels(*outlines, limits, 0, most_work)
        assert len(texels) == 0
        assert outside == 0.0
        assert (reached > most_quads) == (most_work == ENDLESS)


@pytest.mark.parametrize(
    ("point", "far"), [(0, 1.25), (0, -1e300), (0, np.inf), (0, np.nan), (1, 7.0), (1, np.inf), (1, np.nan)]
)
def test_no_texels_of_an_outline_outside_the_square(point: int, far: float) -> None:
    outlines = outlines_of(TRIANGLE)
    outlines = outlines._replace(cubics=outlines.cubics.copy())  # the drawing's own array is that of other tests, too
    outlines.cubics[1, point, 1] = far
    texels, outside, *_ = silhouette_texels(*outlines, BOUNDS, 0, ENDLESS)
    assert len(texels) == 0
    assert not outside <= 1e-9
