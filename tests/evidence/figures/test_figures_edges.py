"""An edge in several renderers, over their errors."""

import numpy as np
import pytest
from fitting import assert_legible

from vexture_evidence.figures.edges import edges
from vexture_evidence.measures.renderings import at_edge

pytestmark = pytest.mark.slow  # test_report_is_whole draws these figures too


def shown(axes):
    """The picture that a panel shows."""
    return np.asarray(axes.images[0].get_array())


@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_edges_stand_over_their_errors(shape):
    rendered = at_edge(shape)
    figure = edges(rendered)
    assert_legible(figure)
    columns = len(rendered.images) + 1
    for number, image in enumerate(rendered.images.values()):
        np.testing.assert_array_equal(shown(figure.axes[number]), image)
        off = 255 * np.abs(np.float64(image) - rendered.truth)
        np.testing.assert_array_equal(shown(figure.axes[columns + number]), off)
