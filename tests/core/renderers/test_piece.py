"""Pieces beside and in pixels."""

import numpy as np
import pytest
from hand import need_gpu
from packed_views import View, texture_of, turned_view
from test_renderers_cpu import circles, difference, errors

import degenerate
from vexture.drawing.drawing import Drawing
from vexture.drawing.drawing import Path as Outline


@pytest.mark.parametrize("view", [turned_view(250, 0), turned_view(150, 30), turned_view(150, 45, 8)])
def test_a_piece_on_a_leafs_left_edge_counts_once(view: View) -> None:
    box = Drawing.polygon([(0.25, 0.11), (0.75, 0.11), (0.75, 0.9163), (0.25, 0.9163)])
    assert errors(box, view)[1] < 0.5


@pytest.mark.parametrize(("pixels", "narrow"), [(60, 8), (130, 32)])
def test_what_lies_beside_a_long_pixel_does_not_count(pixels: float, narrow: float) -> None:
    assert errors(circles(64), turned_view(pixels, 45, narrow))[0] < 1.5


def test_a_piece_that_turns_on_the_side_of_the_box_leaves_there() -> None:
    """There its speed is nothing, and a rounding error decides whether it has come to the side."""
    need_gpu()
    round_corner = np.array([[(0.0, 0.125), (0.0, 0.0561), (0.0561, 0.0), (0.12506, 0.0)]])
    sides = degenerate.polygon([(0.12506, 0.0), (0.9, 0.0), (0.9, 0.9), (0.0, 0.9), (0.0, 0.125)])
    texture = texture_of(Drawing((Outline((np.concatenate([round_corner, sides[1:]]),)),)))
    for shift in np.linspace(0.0, 4e-9, 41):
        view = np.array([[0.0625, 0.0, -0.04458777259142641], [0.0, -0.0625, 1.0201982216418346 + shift]])
        assert difference(texture, ((18, 18), view)) < 0.05
