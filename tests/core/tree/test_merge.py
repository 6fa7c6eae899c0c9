"""Merging stops where a cell will be divided, and what it has written until then is what it would have written."""

import numpy as np

from vexture.bezier.convert import line_cubics
from vexture.bezier.monotone import MOST_PARTS
from vexture.tree.merge import merge_chains


def merged(points, most):
    curves = line_cubics(points[:-1], points[1:])
    room = len(curves) + MOST_PARTS
    out = np.empty((room, 4, 2))
    count, _ = merge_chains(curves, np.zeros(len(curves), np.int64), 1.0, most, out, np.empty(room, np.int64))
    return out[:count]


def test_merging_stops_when_the_cell_will_be_divided():
    steps = np.arange(31.0)
    zigzag = np.column_stack((1000.0 * steps, 5000.0 + 2000.0 * (steps % 2.0)))
    whole, start = merged(zigzag, 30), merged(zigzag, 10)
    assert len(whole) == 30
    assert len(start) == 11
    np.testing.assert_array_equal(start, whole[:11])


def test_horizontal_pieces_do_not_stop_merging():
    steps = np.arange(31.0)
    stairs = np.column_stack((1000.0 * ((steps + 1.0) // 2.0), 1000.0 * (steps // 2.0)))
    assert len(merged(stairs, 15)) == 30
