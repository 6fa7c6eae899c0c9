"""The fidelity benchmark measures what it says."""

import doctest
from argparse import Namespace

import numpy as np
import pytest

import fidelity
import report
from vexture.conversion.pipeline import run_encoding
from vexture.drawing.drawing import Drawing
from vexture.renderers.view import fit

SQUARE = Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)])
NEEDLE = Drawing.polygon([(0.1, 0.5), (0.9, 0.501), (0.9, 0.502)])


def test_examples_in_the_docstrings():
    found = doctest.testmod(report)
    assert found.attempted
    assert not found.failed


def test_cut_pixels_are_those_with_small_quads():
    cells = tuple(np.array(values) for values in ([0.5, 0.3, 0.71], [0.5, 0.9, 0.09], [0.25, 0.1, 0.01]))
    view = fidelity.SquareView(4, fit((4, 4)))
    assert np.argwhere(fidelity.cut_pixels(cells, view)).tolist() == [[0, 1], [3, 2]]


def test_area_error_is_in_255ths():
    tree = run_encoding(SQUARE, "thesis").tree
    assert fidelity.area_error(SQUARE, tree) < 0.01
    assert fidelity.area_error(NEEDLE, tree) == pytest.approx(255 * (0.36 - 0.8 * 0.001 / 2), abs=0.01)


@pytest.mark.parametrize(
    ("mean", "border", "within"), [(5.9, 1.4, True), (6.1, 1.4, False), (5.9, 1.6, False), (5.9, np.nan, True)]
)
def test_limits(mean, border, within):
    good = {"mae": 1.0, "border": 1.0}
    assert fidelity.meets_limits({"cpu": good, "gpu": {"mae": mean, "border": border}}, ["cpu", "gpu"]) == within


def test_a_drawing_is_within_the_limits_and_a_wrong_picture_is_not():
    conversion = run_encoding(SQUARE, "thesis")
    views = fidelity.shifted_views("square", 40, Namespace(shifts=2, seed=3))
    right = fidelity.size_facts(SQUARE, conversion.tree, conversion.texture, views, ["cpu"])
    wrong = fidelity.size_facts(SQUARE, conversion.tree, run_encoding(NEEDLE, "thesis").texture, views, ["cpu"])
    assert right["met"]
    assert not wrong["met"]
    assert right["apart"]["max"] == 0.0


def test_shifts_are_parts_of_a_pixel_and_come_from_the_seed_and_the_name():
    one, same, other = (
        [view.to_unit for view in fidelity.shifted_views(name, 10, Namespace(shifts=3, seed=1))]
        for name in ("duck", "duck", "cake")
    )
    np.testing.assert_array_equal(one, same)
    assert (np.array(one) != other).any()
    moved = (np.array(one)[:, :2, 2] - (0.0, 1.0)) * (10.0, -10.0)
    assert (moved >= 0.0).all()
    assert (moved < 1.0).all()
    assert len(np.unique(moved)) == 6
