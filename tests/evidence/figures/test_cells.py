"""Pictures of subdivisions show the leaves of the tree: all of them, shaded as they are, with their curves."""

import numpy as np
import pytest
from fitting import assert_legible
from matplotlib.collections import PolyCollection

import vexture
from vexture.drawing.drawing import Drawing
from vexture_evidence.figures.cells import curve_lines, subdivision
from vexture_evidence.measures.leaves import leaves
from vexture_evidence.measures.shape import example

ENCODINGS = ("packed", "thesis")


def cells_of(figure):
    return next(artist for artist in figure.axes[0].collections if isinstance(artist, PolyCollection))


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("shades", ["coverage", "depth"])
def test_every_leaf_is_a_square_of_its_shade(encoding, shades):
    texture = vexture.convert(example("duck"), encoding=encoding)
    found = leaves(texture)
    assert found.side.min() >= 1 / 256, "the drawing is no longer a simple one"
    figure = subdivision(texture, shades=shades)
    cells = cells_of(figure)
    boxes = np.array([path.get_extents().bounds for path in cells.get_paths()])
    np.testing.assert_allclose(boxes, np.stack([found.x, found.y, found.side, found.side], axis=1))
    assert np.array_equal(cells.get_array(), found.coverage if shades == "coverage" else found.depth)
    assert_legible(figure)


def test_a_corner_and_a_curve_are_drawn_where_they_are():
    square = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.9, 0.9), (0.1, 0.9)])
    lines = curve_lines(leaves(vexture.convert(square, encoding="thesis")))
    points = lines[~np.isnan(lines[:, 0])]
    distance = abs(np.abs(points - 0.5).max(axis=1) - 0.4)
    assert distance.max() < 1e-4
    for corner in ((0.1, 0.1), (0.9, 0.9)):
        assert np.abs(points - corner).max(axis=1).min() < 1e-4


def test_small_cells_are_shown_by_their_mean_and_without_borders():
    comb = [(k / 1500, 0.4 if k % 2 else 0.6) for k in range(1501)]
    drawing = Drawing.polygon([*comb, (1.0, 0.0), (0.0, 0.0)])
    texture = vexture.convert(drawing, capacity=4, tolerance=0)
    found = leaves(texture)
    assert found.side.min() < 1 / 256, "the drawing has no small cells"
    figure = subdivision(texture)
    image = figure.axes[0].images[0].get_array()
    small = found.side < 1 / 256
    area = (~image.mask).sum() / image.size if np.ma.is_masked(image) else np.isfinite(image).mean()
    assert area == pytest.approx((found.side[small] ** 2).sum())
    assert image.sum() / image.size == pytest.approx(found.coverage[small] @ found.side[small] ** 2)
    widths = np.array(cells_of(figure).get_linewidths())
    assert set(widths[found.side[~small] < 1 / 128]) <= {0.0}
    assert widths.max() > 0.0


def test_a_part_is_seen_with_its_own_borders():
    texture = vexture.convert(example("duck"))
    found = leaves(texture)
    bounds = (0.75, 0.5, 0.8125, 0.5625)
    figure = subdivision(texture, bounds=bounds)
    assert figure.axes[0].get_xlim() == (0.75, 0.8125)
    inside = (found.x < 0.8125) & (found.x + found.side > 0.75) & (found.y < 0.5625) & (found.y + found.side > 0.5)
    assert len(cells_of(figure).get_paths()) == inside.sum()
    assert_legible(figure)


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("shades", ["coverage", "depth"])
def test_an_empty_drawing_has_four_cells(encoding, shades):
    figure = subdivision(vexture.convert(Drawing(()), encoding=encoding), shades=shades)
    assert figure.axes[0].get_title(loc="left") == "4 cells, 0 curves"
    assert_legible(figure)
