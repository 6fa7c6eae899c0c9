"""Pictures of renderings show the pixels that were rendered, and can be read."""

import numpy as np
import pytest
from fitting import assert_legible

from vexture.base.errors import DeviceError
from vexture.renderers.device import context
from vexture_evidence.figures.plane import plane
from vexture_evidence.figures.solutions import solutions
from vexture_evidence.measures.plane import receding
from vexture_evidence.measures.solutions import SOLUTIONS, by_cpu, solve

pytestmark = pytest.mark.slow  # test_report_is_whole draws these figures too


def shown(axes):
    """The picture that a panel shows."""
    return np.asarray(axes.images[0].get_array())


def test_the_plane_is_shown_whole_and_far():
    found = receding((120, 48), 6)
    figure = plane(found)
    assert_legible(figure)
    for row, image in enumerate([*found.rendered.images.values(), found.rendered.truth]):
        np.testing.assert_array_equal(shown(figure.axes[3 * row]), image)
        np.testing.assert_array_equal(shown(figure.axes[3 * row + 1]), image[:12, 45:75])


@pytest.mark.parametrize("gpu", [False, True])
def test_solutions_are_marked_on_their_curves(gpu):
    if gpu:
        try:
            context()
        except DeviceError as error:
            pytest.skip(str(error))
    figure = solutions(side=24, gpu=gpu)
    assert_legible(figure)
    each = 2 if gpu else 1
    assert len(figure.axes) == 9 * each
    for case, first in zip(SOLUTIONS, figure.axes[::each], strict=True):
        np.testing.assert_array_equal(shown(first), 0.25 * by_cpu(case, 24))
        dots = next(line for line in first.lines if line.get_marker() == "o")
        np.testing.assert_array_equal(dots.get_ydata(), solve(case).heights)
        assert set(dots.get_xdata()) == {case.x}
        curve = first.lines[2].get_xydata()
        for x, y in dots.get_xydata():
            assert np.hypot(*(curve - (x, y)).T).min() < 0.02
