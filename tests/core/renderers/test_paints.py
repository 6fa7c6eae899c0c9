"""Paints of planar maps: exact in a face, and of leaves of which only the mean is known."""

from typing import Any

import numpy as np
import pytest
from hand import need_gpu
from packed_views import ENTRIES
from test_colours import made, map_of, painted

import degenerate
import planar
from vexture.renderers.colour import render_cpu_colours
from vexture.renderers.gpu import render_gpu_colours
from vexture.renderers.view import fit, window
from vexture.tree.planar.build import build_map


def test_a_view_in_a_face_is_its_paint_to_the_last_step() -> None:
    need_gpu()
    drawing, texture = made("flag")
    inside = window(0.55, 0.52, 0.01, 0.01).matrix((9, 9))
    point = np.array([[0.555, 0.525]])
    truth = planar.colours_at(drawing, point)[0][0]
    for render in (render_cpu_colours, render_gpu_colours):
        for entry in ENTRIES.values():
            np.testing.assert_allclose(render(texture, *entry(((9, 9), inside))) - truth, 0.0, atol=1.5 / 65535)


@pytest.mark.parametrize("entry", ENTRIES)
@pytest.mark.parametrize("render", [render_cpu_colours, render_gpu_colours])
def test_a_leaf_of_which_only_the_mean_is_known_has_it(render: Any, entry: str) -> None:
    if render is render_gpu_colours:
        need_gpu()
    crowd = painted((degenerate.star(61, 30), (1.0, 0.5, 0.25), 0.8))
    assert build_map(crowd, max_depth=2).unresolved > 0
    view = ENTRIES[entry](((4, 4), fit((4, 4))))
    coarse, fine = (render(map_of(crowd, max_depth=depth), *view) for depth in (2, 14))
    np.testing.assert_allclose(coarse, fine, atol=1 / 255)  # the mean has eight bits
