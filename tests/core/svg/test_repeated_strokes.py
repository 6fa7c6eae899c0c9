"""Strokes of outlines that are shown at many places."""

import numpy as np

from vexture.svg import strokes
from vexture.svg.read import svg_drawing

MARKER = '<path id="m" d="M0 3C1.7 3 3 1.7 3 0Q1 -2 -3 -3z" stroke="#07b" stroke-opacity=".5"/>'


def read(places):
    uses = "".join(f'<use href="#m" x="{x}" y="50"/>' for x in places)
    return svg_drawing(f'<svg viewBox="0 0 1000 100"><defs>{MARKER}</defs>{uses}</svg>'.encode(), "scatter.svg")


def test_a_stroke_that_many_uses_show_is_made_once():
    strokes.cached_contours.cache_clear()
    drawing = read(range(10, 1000, 10))
    assert len(drawing.paths) == 2 * 99
    assert strokes.cached_contours.cache_info().misses == 1


def test_a_kept_stroke_is_what_is_made_anew():
    strokes.cached_contours.cache_clear()
    (_, first), (_, second) = read([500]).paths, read([500]).paths
    assert strokes.cached_contours.cache_info().hits == 1
    assert first.contours[0].tobytes() == second.contours[0].tobytes()
    assert not np.shares_memory(first.contours[0], second.contours[0])
