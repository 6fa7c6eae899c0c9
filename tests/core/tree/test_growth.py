"""A tree while it grows: step by step, and within its time."""

from dataclasses import astuple, replace

import numpy as np
import pytest

import vexture
from vexture import Drawing, LimitError
from vexture.tree.bounds import Bounds
from vexture.tree.build import SLICE, grow, grow_on
from vexture.tree.cubics import gather
from vexture.tree.growth import QUADS, WAITING, Growth, tree_of, with_needed_room
from vexture.tree.tree import MOST_QUADS


def scribble(sides: int) -> Drawing:
    """A polygon whose sides cross one another all over the unit square."""
    return Drawing.polygon(map(tuple, np.random.default_rng(1).random((sides, 2)).tolist()))


def test_a_tree_that_grows_in_small_steps_is_the_same() -> None:
    drawing = scribble(60)
    outlines, bounds = gather(drawing), Bounds(4, 0.0, 1e-5, 1, 16, MOST_QUADS)
    tree, calls = Growth(*grow(*outlines, bounds, 1, 0)[0]), 1
    while tree.counts[WAITING]:
        tree = with_needed_room(tree)
        grow_on(tree, outlines[2], bounds, 1, 0)
        calls += 1
    assert calls >= tree.counts[QUADS] > 100  # one cell in each: Python can look at the clock after any
    whole = Growth(*grow(*outlines, bounds, 10**9, 0)[0])
    while whole.counts[WAITING]:
        whole = with_needed_room(whole)
        grow_on(whole, outlines[2], bounds, 10**9, 0)
    for one, other in zip(astuple(tree_of(tree)), astuple(tree_of(whole)), strict=True):
        np.testing.assert_array_equal(one, other)


def test_a_tree_that_takes_too_long_is_stopped_while_it_grows() -> None:
    drawing = replace(scribble(500), name="scribble")
    started, _ = grow(*gather(drawing), Bounds(4, 0.0, 1e-5, 1, 16, MOST_QUADS), SLICE, 0)
    assert Growth(*started).counts[WAITING]  # or it would be done before the second look at the clock
    with pytest.raises(LimitError, match=r"^scribble: converting takes longer than 0\.02 s; simplify .*`max_seconds`$"):
        vexture.convert(drawing, max_seconds=0.02)
