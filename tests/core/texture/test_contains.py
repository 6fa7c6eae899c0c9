"""Points inside a shape, by the windings of its texture."""

import numpy as np
import pytest
from test_outlines import converted
from test_texture_encode import chain, texture_of

import degenerate
from vexture.base.errors import ParameterError
from vexture.drawing.drawing import Drawing
from vexture.texture.encode import encode as encode_packed
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.tree.build import build_tree

POINTS = 2_000
CLEAR = 1e-4  # unit-square units: chords of the brute force, rounding to leaves of half the square
T_JUNCTIONS = (155, 157, 277, 300, 322, 331, 339, 356, 365)
SLOW_SEEDS = (pytest.param(seed, marks=pytest.mark.slow) for seed in range(10, 40))
SEEDS = [*range(10), *T_JUNCTIONS, *SLOW_SEEDS]  # at junctions pieces end on others
SQUARE = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])


@pytest.mark.parametrize("seed", SEEDS)
def test_points_inside(seed: int) -> None:
    drawing = degenerate.drawing(seed)
    if drawing.paths:
        points = degenerate.points_near(drawing, np.random.default_rng(seed), POINTS)
        windings, distance = degenerate.path_windings(drawing, points)
        clear = distance > CLEAR
        truth = degenerate.silhouette(drawing, windings)
        np.testing.assert_array_equal(converted(drawing).contains(points)[clear], truth[clear])


def test_heights_are_compared_exactly() -> None:
    """The square's sides lie on lattices of all depths: the lower and left ones are inside, the others are not."""
    texture = converted(SQUARE)
    below, above = np.nextafter([0.25, 0.75], 0.0), np.nextafter([0.25, 0.75], 1.0)
    for axis, other in ((0, 0.4), (0, 0.6), (1, 0.4), (1, 0.6)):
        values = [below[0], 0.25, above[0], below[1], 0.75, above[1]]
        points = np.full((6, 2), other)
        points[:, axis] = values
        assert texture.contains(points).tolist() == [False, True, True, True, False, False]


def test_points_beyond_the_square_and_no_points() -> None:
    full = encode_packed([build_tree(Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]))], [Root("x")], name="x")
    edge = [(0, 0), (1, 0.5), (0.5, 1), (-1e-300, 0.5), (np.nan, 0.5), (0.5, np.inf), (1e300, -1e300), (0.5, 0.5)]
    assert full.contains(edge).tolist() == [True, False, False, False, False, False, False, True]
    assert full.contains(np.zeros((0, 2))).shape == (0,)
    for wrong in (np.zeros(2), np.zeros((3, 3)), 0.5):
        with pytest.raises(ParameterError, match=r"`points` has the shape .*; it must be \(n, 2\)"):
            full.contains(wrong)


def test_unchecked_texels_lead_nowhere() -> None:
    """Random texels given by hand: an answer, not a crash."""
    random = np.random.default_rng(5)
    texels = random.integers(0, 2**32, (1, 64, 4), np.uint32)
    texels[:, ::2, :2] %= 70
    texture = Texture(texels, (Root("x"), Root("y", 10**6)))
    for root in (0, 1):
        assert texture.contains(random.random((1000, 2)), root).shape == (1000,)


def test_points_that_are_none_or_no_numbers() -> None:
    texture = texture_of([chain(1)])
    found = texture.contains(np.zeros((0, 2)), root=0)
    assert (found.shape, found.dtype) == ((0,), bool)
    for points in ("x", [("a", "b")], [(1, 2), (3,)]):
        with pytest.raises(ParameterError, match="`points` is no array of numbers"):
            texture.contains(points)
