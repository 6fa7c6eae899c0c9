"""The effect of a tolerance that is too large."""

import numpy as np
import pytest
from fitting import assert_legible

from vexture_evidence.figures.tolerances import tolerances
from vexture_evidence.measures.renderings import with_tolerances

pytestmark = pytest.mark.slow  # test_report_is_whole draws these figures too


def shown(axes):
    """The picture that a panel shows."""
    return np.asarray(axes.images[0].get_array())


@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_tolerances_are_seen_against_the_outline(shape):
    _, whole, close, (x, y, side) = with_tolerances(shape, 64)
    figure = tolerances(shape.drawing, whole, close, (x, y, side))
    assert_legible(figure)
    below = figure.axes[3:]
    for axes, image in zip(below, close.images.values(), strict=True):
        np.testing.assert_allclose(axes.viewLim.bounds, (x, y, side, side))
        np.testing.assert_array_equal(shown(axes), 0.75 * image)
        (line,) = axes.lines
        drawn = line.get_xydata()
        gaps = np.flatnonzero(np.isnan(drawn[:, 0]))
        cubics = [curve for path in shape.drawing.paths for contour in path.contours for curve in contour]
        seen = [
            curve[[0, 3]]
            for curve in cubics
            if (curve.min(axis=0) <= (x + side, y + side)).all() and (curve.max(axis=0) >= (x, y)).all()
        ]
        ends = [drawn[[start, stop - 1]] for start, stop in zip([0, *gaps[:-1] + 1], gaps, strict=False)]
        assert len(ends) == len(seen)
        assert all(np.allclose(end, expected) for end, expected in zip(ends, seen, strict=True))
