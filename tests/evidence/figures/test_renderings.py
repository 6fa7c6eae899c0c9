"""Pictures of renderings show the pixels that were rendered, and can be read."""

import numpy as np
import pytest
from fitting import assert_legible
from matplotlib.colors import to_rgb

from vexture.base.errors import DeviceError
from vexture.renderers.device import context
from vexture_evidence.figures.edges import edges
from vexture_evidence.figures.plane import plane
from vexture_evidence.figures.resolutions import FROM_LEAF, INSIDE, OUTSIDE, STORED, exaggerated_cut_off, resolutions
from vexture_evidence.figures.solutions import solutions
from vexture_evidence.figures.tolerances import tolerances
from vexture_evidence.measures.plane import receding
from vexture_evidence.measures.renderings import MIP, at_edge, at_sizes, cut_off_at, with_tolerances
from vexture_evidence.measures.shape import ConvertedDrawing, example
from vexture_evidence.measures.solutions import SOLUTIONS, by_cpu, solve

pytestmark = pytest.mark.slow  # test_report_is_whole draws these figures too

NOTHING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 2"/>'


@pytest.fixture(scope="module", params=["duck", "crossings", "hairline", "nothing"])
def shape(request, tmp_path_factory):
    if request.param != "nothing":
        return ConvertedDrawing(example(request.param))
    path = tmp_path_factory.mktemp("drawings") / "nothing.svg"
    path.write_text(NOTHING)
    return ConvertedDrawing(path)


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
