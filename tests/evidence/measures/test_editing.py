"""A texture is exported, changed and converted again: what was there is unchanged, what was added is there."""

import numpy as np
import pytest

import vexture
from vexture.conversion.images import coverage
from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact
from vexture_evidence.measures.editing import edit_texture

SQUARE = Drawing.polygon([(0.1, 0.1), (0.5, 0.1), (0.5, 0.5), (0.1, 0.5)])


@pytest.fixture(scope="module")
def edited():
    return edit_texture(SQUARE, vexture.convert(SQUARE), '<rect x="0.6" y="-0.9" width="0.2" height="0.2"/>', 1)


def test_the_round_trip_alone_changes_nothing(edited):
    assert edited.unchanged.max < 1.0
    before, after = (render_exact(drawing, (10, 10)) for drawing in (SQUARE, edited.exported))
    np.testing.assert_allclose(after, before, atol=1e-3)


def test_the_change_is_in_the_drawing_and_in_its_texture(edited):
    picture = render_exact(edited.drawing, (10, 10))
    assert picture.mean() == pytest.approx(0.16 + 0.04, abs=1e-4)
    assert picture[1:3, 6:8] == pytest.approx(np.ones((2, 2)), abs=1e-4)  # y of the file is down
    np.testing.assert_allclose(coverage(edited.texture, (10, 10), renderer="cpu"), picture, atol=1e-2)
    assert edited.seconds > 0.0
