"""Views of parts of a drawing: along its outline, and at its sharpest corner."""

import numpy as np

from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact
from vexture_evidence.measures.closeups import closeup, outline_places, sharpest_corner
from vexture_evidence.measures.rivals import (
    measure_rival,
    raster_rival,
    scene_of,
)


def test_a_closeup_magnifies_about_its_place():
    view = closeup((100, 100), np.array([0.3, 0.6]), 4.0)
    np.testing.assert_allclose(view @ (50, 50, 1), (0.3, 0.6, 1.0))
    np.testing.assert_allclose(view @ (0, 100, 1), (0.3 - 0.125, 0.6 - 0.125, 1.0))


def test_places_are_on_the_border_and_not_where_paths_overlap():
    left, right = (Drawing.polygon([(x, 0.25), (x + 0.4, 0.25), (x + 0.4, 0.75), (x, 0.75)]).paths for x in (0.2, 0.4))
    both = Drawing(left + right)
    places = outline_places(both, 12)
    assert len(places) == 12
    for x, y in places:
        on_side = min(abs(x - 0.2), abs(x - 0.8)) < 1e-9 and 0.25 <= y <= 0.75
        on_top = min(abs(y - 0.25), abs(y - 0.75)) < 1e-9 and 0.2 <= x <= 0.8
        assert on_side or on_top


def test_the_sharpest_corner_is_one_that_is_seen():
    spike = Drawing.polygon([(0.1, 0.4), (0.9, 0.5), (0.1, 0.6)])
    np.testing.assert_allclose(sharpest_corner(spike), (0.9, 0.5))
    hidden = Drawing(spike.paths + Drawing.polygon([(0.7, 0.3), (1, 0.3), (1, 0.7), (0.7, 0.7)]).paths)
    assert render_exact(hidden, (1, 1), closeup((1, 1), sharpest_corner(hidden), 1e3))[0, 0] < 1.0


def test_an_empty_drawing_has_no_places():
    empty = Drawing(())
    assert outline_places(empty, 3).shape == (0, 2)
    assert sharpest_corner(empty).tolist() == [0.5, 0.5]
    found = measure_rival(raster_rival(empty, 8), scene_of(empty))
    assert [shown.mae for shown in found[1:]] == [0.0, 0.0, 0.0]
