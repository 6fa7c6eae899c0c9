"""A shape in few pixels, and an exaggerated cut-off."""

import numpy as np
import pytest
from fitting import assert_legible
from matplotlib.colors import to_rgb

from vexture_evidence.figures.resolutions import FROM_LEAF, INSIDE, OUTSIDE, STORED, exaggerated_cut_off, resolutions
from vexture_evidence.measures.renderings import MIP, at_sizes, cut_off_at

pytestmark = pytest.mark.slow  # test_report_is_whole draws these figures too


def shown(axes):
    """The picture that a panel shows."""
    return np.asarray(axes.images[0].get_array())


@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_few_pixels_in_columns_of_sizes_and_rows_of_methods(shape):
    rendered = at_sizes(shape, (1, 2, 16))
    figure = resolutions(rendered)
    assert_legible(figure)
    axes = np.array(figure.axes).reshape(6, 3)
    for column, view in zip(axes.T, rendered, strict=True):
        centre, mip, origin, sampled, packed, truth = map(shown, column)
        for image, expected in zip((centre, mip, sampled, packed), view.images.values(), strict=True):
            np.testing.assert_array_equal(image, expected)
        np.testing.assert_array_equal(truth, view.truth)
        np.testing.assert_array_equal((origin == to_rgb(STORED)).all(axis=2), view.from_mip)
        np.testing.assert_array_equal((origin == to_rgb(FROM_LEAF)).all(axis=2), ~view.from_mip)
        assert column[1].get_xlabel() == f"error {view.errors[MIP].mae:.3g}"


@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_the_cut_off_tells_mip_values_from_leaves(shape):
    drawn = cut_off_at(shape, (20, 80))
    figure = exaggerated_cut_off(drawn)
    assert_legible(figure)
    for axes, picture in zip(figure.axes, drawn, strict=True):
        image = shown(axes)
        grey = (image[..., 0] == image[..., 1]) & (image[..., 1] == image[..., 2])
        np.testing.assert_array_equal(grey, picture.from_mip)
        for colour, inside in ((INSIDE, 1), (OUTSIDE, 0)):
            where = (image == to_rgb(colour)).all(axis=2)
            np.testing.assert_array_equal(where, ~grey & (picture.image == inside))
