"""A tree while it grows: step by step, and within its time."""

from dataclasses import astuple, replace

import numpy as np
import pytest

import vexture
from vexture import Drawing, LimitError
from vexture.tree.bounds import Bounds
from vexture.tree.build import SLICE, grow, grow_on
from vexture.tree.cubics import outlines_of
from vexture.tree.growth import QUADS, WAITING, growth_from, longer, tree_of
from vexture.tree.tree import MOST_QUADS


def scribble(sides: int) -> Drawing:
    """A polygon whose sides cross one another all over the unit square."""
    return Drawing.polygon(map(tuple, np.random.default_rng(1).random((sides, 2)).tolist()))


def test_a_tree_that_grows_in_small_steps_is_the_same() -> None:
    drawing = scribble(60)
    outlines, bounds = outlines_of(drawing), Bounds(4, 0.0, 1e-5, 1, 16, MOST_QUADS)
    tree, calls = growth_from(grow(*outlines, bounds, 1, 0)[0]), 1
    while tree.counts[WAITING]:
        tree = growth_from(grow_on(tree, outlines.rules, bounds, 1, 0))
        calls += 1
    assert calls >= tree.counts[QUADS] > 100  # one cell in each: Python can look at the clock after any
    whole = growth_from(grow(*outlines, bounds, 10**9, 0)[0])
    assert not whole.counts[WAITING]
    for one, other in zip(astuple(tree_of(tree)), astuple(tree_of(whole)), strict=True):
        np.testing.assert_array_equal(one, other)


def test_an_outline_that_leaves_the_square_is_not_divided() -> None:
    outlines, bounds = outlines_of(scribble(60)), Bounds(4, 0.0, 1e-5, 1, 16, MOST_QUADS)
    outlines.cubics[7, 3, 0] = outlines.cubics[8, 0, 0] = 1.25
    tree, outside = grow(*outlines, bounds, 10**9, 0)
    assert outside == 0.25
    assert growth_from(tree).counts[QUADS] == 1


def test_arrays_grow_to_the_room_that_is_needed() -> None:
    for rows in (np.arange(6.0).reshape(3, 2), np.arange(24, dtype=np.int32).reshape(3, 4, 2)):
        assert longer(rows, 3) is rows
        more = longer(rows, 4)
        assert more.shape == (7, *rows.shape[1:])
        np.testing.assert_array_equal(more[:3], rows)


def test_a_tree_that_takes_too_long_is_stopped_while_it_grows() -> None:
    drawing = replace(scribble(1500), name="scribble")
    started, _ = grow(*outlines_of(drawing), Bounds(4, 0.0, 1e-5, 1, 16, MOST_QUADS), SLICE, 0)
    assert growth_from(started).counts[WAITING]  # or it would be done before the second look at the clock
    with pytest.raises(LimitError, match=r"^scribble: converting takes longer than 0\.02 s; simplify .*`max_seconds`$"):
        vexture.convert(drawing, max_seconds=0.02)
