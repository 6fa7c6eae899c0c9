"""Decoder of the thesis's textures: points on edges, and trees that are those which were encoded."""

import numpy as np
import pytest

from vexture.bezier.area import edge_index
from vexture.conversion.pipeline import run_encoding
from vexture.drawing.drawing import Drawing
from vexture.thesis.decode import decode, edge_point


def test_points_of_indices_are_on_edges_and_have_those_indices():
    """Clockwise from the upper left corner, by Table 4.1."""
    index = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    np.testing.assert_array_equal(edge_point(index), [(0, 1), (1, 1), (1, 0), (0, 0), (0, 1)])
    index = np.linspace(0.0, 1.0, 64, endpoint=False)
    points = edge_point(index)
    assert ((points == 0.0) | (points == 1.0)).any(axis=1).all()
    np.testing.assert_allclose([edge_index(*point) % 1.0 for point in points.tolist()], index, atol=1e-12)


@pytest.mark.parametrize("corner", [0.5, 0.375, 0.3])
def test_a_decoded_tree_is_the_one_that_was_encoded(corner):
    drawing = Drawing.polygon([(0, 0), (corner, 0), (corner, corner), (0, 0.75)])
    made = run_encoding(drawing, "thesis")
    found = decode(made.texture)
    np.testing.assert_array_equal(found.kind, made.tree.kind)
    np.testing.assert_array_equal(found.ref, made.tree.ref)
    np.testing.assert_allclose(found.curves, made.tree.curves, atol=2.0**-13)
    np.testing.assert_allclose(found.coverage, made.tree.coverage, atol=1e-3)
    area = corner * (0.75 + corner) / 2.0
    assert found.coverage[0].mean() == pytest.approx(area, abs=1e-4)
