import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vexture.renderers.view import fit, window
from vexture_evidence.measures.metrics import TOUCH, border_ratio, cell_border_pixels, errors, ink_sd


def test_errors_are_over_touched_pixels_only():
    truth, image = np.zeros((4, 5)), np.zeros((4, 5))
    truth[1, 1], image[1, 1] = 1.0, 1.0  # right
    truth[2, 2] = 30 / 255  # missed
    image[3, 3] = 60 / 255  # spilt
    assert errors(image, truth) == pytest.approx((30, math.sqrt((30**2 + 60**2) / 3), 60))
    assert errors(truth, truth) == (0, 0, 0)
    assert errors(0 * truth, 0 * truth) == (0, 0, 0)
    assert errors(np.float32([0.5]), np.float32([0.5])) == (0, 0, 0)


def test_rounding_errors_of_the_truth_touch_no_pixel():
    truth, border = np.array([[1e-10, 0.5, 0.5, 1.0 - 1e-7]]), np.array([[False, True, False, False]])
    image = np.array([[0.0, 0.6, 0.7, 1.0]])
    assert errors(image, truth).mae == pytest.approx(0.1 * 255)
    assert border_ratio(image, truth, border) == pytest.approx(0.5)


def test_ink_sd_sees_flicker_but_not_a_constant_bias():
    truths = [np.full((2, 2), level) for level in (0.2, 0.4, 0.5, 1.0)]
    assert ink_sd([0.9 * truth for truth in truths], truths) == pytest.approx(0, abs=1e-12)
    factors = (0.9, 1.1, 0.9, 1.1)
    assert ink_sd([f * truth for f, truth in zip(factors, truths, strict=True)], truths) == pytest.approx(10)
    with pytest.raises(ValueError, match="zip"):
        ink_sd(truths[:3], truths)


def quadtree(rng, depth):
    """Leaf cells of a random quad-tree: x, y, side."""
    cells, leaves = [(0.0, 0.0, 1.0)], []
    for _ in range(depth):
        split = [cell for cell in cells if rng.random() < 0.7]
        leaves += [cell for cell in cells if cell not in split]
        cells = [(x + dx * s / 2, y + dy * s / 2, s / 2) for x, y, s in split for dx in (0, 1) for dy in (0, 1)]
    return np.array(leaves + cells).T


@given(st.integers(0, 2**32), st.floats(0, 360))
@settings(deadline=None)
def test_border_pixels_by_brute_force(seed, angle):
    """No border passes through a pixel if one cell holds every point of a fine grid in it, or none a corner."""
    rng = np.random.default_rng(seed)
    x, y, side = quadtree(rng, 5)
    view = window(*rng.uniform(-0.2, 0.5, 2), *rng.uniform(0.2, 1, 2), angle).matrix((9, 7))
    marked = cell_border_pixels(x, y, side, view, (9, 7))
    offsets = np.linspace(TOUCH, 1 - TOUCH, 12)
    for row, column in np.ndindex(marked.shape):
        right, down = np.meshgrid(column + offsets, row + offsets)
        u, v, _ = np.einsum("ij,jyx->iyx", view, np.stack([right, down, np.ones(right.shape)]))
        x_in = (x[:, None, None] <= u) & (u < (x + side)[:, None, None])
        held = x_in & (y[:, None, None] <= v) & (v < (y + side)[:, None, None])
        within_one = held.all(axis=(1, 2)).any()
        outside = not held[:, :: len(offsets) - 1, :: len(offsets) - 1].any()
        assert marked[row, column] == (not within_one and not outside)


def test_borders_between_pixels_touch_none():
    """Cells of 4 x 4 whole pixels: every border runs between pixels."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(4) / 4, np.arange(4) / 4))
    side = np.full(16, 0.25)
    assert not cell_border_pixels(x, y, side, fit((16, 16)), (16, 16)).any()
    half = window(0.5 / 16, 0.0, 1.0, 1.0).matrix((16, 16))
    np.testing.assert_array_equal(np.flatnonzero(cell_border_pixels(x, y, side, half, (16, 16))[0]), [3, 7, 11, 15])


def test_border_ratio():
    truth, border = np.array([[0.0, 0.5, 0.5, 0.5, 1.0]]), np.array([[True, True, False, False, True]])
    image = truth + np.array([[0.7, 0.3, 0.1, 0.2, -0.9]])  # full and empty pixels do not count
    assert border_ratio(image, truth, border) == pytest.approx(2)
    assert math.isnan(border_ratio(truth, truth, border))
    assert math.isnan(border_ratio(image, truth, np.zeros_like(border)))
