"""Chords of drawings in an image."""

import numpy as np

from vexture.drawing.drawing import Drawing
from vexture.renderers.flatten import find_chords

TRIANGLE = Drawing.polygon([(0, 0), (1, 0), (0, 1)])


def test_chords_of_a_triangle_are_those_that_are_not_level() -> None:
    chords = find_chords(TRIANGLE, (2, 2), np.array([[0.5, 0, 0], [0, -0.5, 1], [0, 0, 1]]), 1e-3)
    np.testing.assert_allclose(chords.lines, [(0.0, 2.0, 0.0, 1.0), (0.0, 2.0, 0.0, 0.0)])
    assert chords.owners.tolist() == [-1, 1]
