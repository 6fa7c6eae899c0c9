"""How many layers of a drawing become one sheet: about as many as fit, found by few tries."""

from collections import namedtuple

import pytest

from vexture.drawing.drawing import Drawing
from vexture.tree.planar.sheets import Sheet, _greedy

Grown = namedtuple("Grown", "texels")


def sheets(count, share, texels):
    """Numbers of items of the sheets, and how many were tried, where so many items need `texels` of their number."""
    tries = []

    def tried(first, last):
        size = last - first
        tries.append(size)
        fits = size == 1 or texels(size) <= share * size
        return Sheet(Drawing((), name=str(size)), Grown(texels(size))) if fits else None

    return [int(sheet.drawing.name) for sheet in _greedy(count, share, tried)], len(tries)


@pytest.mark.parametrize("largest", [1, 5, 8, 57, 100, 900])
def test_sheets_hold_all_items_and_nearly_as_many_as_fit(largest):
    found, _ = sheets(1000, largest, lambda size: size * size)
    assert sum(found) == 1000
    assert max(found) <= largest
    assert min(found[:-1]) >= 0.79 * largest


def test_the_search_begins_at_the_sheet_below():
    found, tries = sheets(5000, 50, lambda size: size * size)
    assert tries <= 3 * len(found), "each sheet was searched for from one item on"


def test_items_that_do_not_fit_are_sheets_by_themselves():
    assert sheets(7, 1, lambda size: 9 * size)[0] == [1] * 7
