import numpy as np
import pytest

from vexture.base.errors import LimitError
from vexture.base.tolerance import UNSEEN
from vexture.renderers.exact import render_exact
from vexture_evidence.measures.renderings import LOOSE, PACKED, at_edge, at_sizes, cut_off_at, with_tolerances
from vexture_evidence.measures.shape import ConvertedDrawing, example

pytestmark = pytest.mark.slow  # test_report_is_whole shows these measures too


class Refused(ConvertedDrawing):
    """A drawing that is too large for the thesis's encoding, without the minutes that making such a one takes."""

    def way(self, way, bits=None):
        if way == "sampled":
            raise LimitError("too large")
        return super().way(way, bits)


@pytest.fixture(scope="module")
def duck():
    return ConvertedDrawing(example("duck"))


@pytest.fixture(scope="module")
def nothing(tmp_path_factory):
    path = tmp_path_factory.mktemp("drawings") / "nothing.svg"
    path.write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 4"/>')
    return ConvertedDrawing(path)


def test_few_pixels_are_right_only_where_coverage_is_computed(duck):
    for view in at_sizes(duck, (1, 4, 16)):
        errors = {name: error.mae for name, error in view.errors.items()}
        np.testing.assert_array_equal(view.truth, render_exact(duck.drawing, view.truth.shape))
        assert errors.pop(PACKED) < 0.1
        assert min(errors.values()) > 1
    assert errors["MIP values, 16 samples"] < errors["with MIP values"]
    assert set(np.unique(view.images["centre of the pixel"])) == {0, 1}
    stored = view.images["with MIP values"][view.from_mip]
    assert len(stored)
    assert set(np.unique(view.images["with MIP values"][~view.from_mip])) == {0, 1}


@pytest.mark.parametrize("name", ["duck", "holes", "hairline", "ocean"])
def test_an_edge_is_in_the_picture(name):
    view = at_edge(ConvertedDrawing(example(name)), 16)
    assert ((view.truth > 0.01) & (view.truth < 0.99)).any()
    assert view.errors[PACKED].mae < 0.2 < view.errors["16 samples"].mae < view.errors["centre of the pixel"].mae


def test_a_tolerance_is_kept_and_shows(duck):
    fitted, whole, close, (x, y, side) = with_tolerances(duck, 96)
    right, loose, packed = fitted
    assert right.deviation <= right.tolerance < loose.deviation <= loose.tolerance == LOOSE * right.tolerance
    assert packed.deviation <= UNSEEN
    assert right.curves > loose.curves
    assert right.nbytes > loose.nbytes
    errors = [close.errors[fit.name].mae for fit in fitted]
    assert errors[1] > 2 * errors[0] > 2 * errors[2]
    assert side == 1 / 8
    place = slice(round((1 - y - side) * 96), round((1 - y) * 96)), slice(round(x * 96), round((x + side) * 96))
    off = sum(np.abs(image - whole.truth) for image in whole.images.values())
    others = [off[row : row + 12, column : column + 12].sum() for row in range(85) for column in range(85)]
    assert off[place].sum() == pytest.approx(max(others), rel=1e-5)
    np.testing.assert_allclose(close.truth.mean(), whole.truth[place].mean(), atol=1e-4)


def test_what_the_encoding_cannot_hold_is_left_out():
    shape = Refused(example("simple-small"))
    (view,) = at_sizes(shape, (4,))
    assert list(view.images) == list(at_edge(shape, 4).images) == [PACKED]
    assert view.from_mip is None
    assert [fit.name for fit in with_tolerances(shape, 16)[0]] == ["sampled, ten times too loose", PACKED]
    with pytest.raises(LimitError, match="too large"):
        cut_off_at(shape, (4,))


@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_an_empty_drawing_is_drawn_without_errors(nothing):
    views = [*at_sizes(nothing, (1, 4)), at_edge(nothing, 4), *with_tolerances(nothing, 16)[1:3]]
    assert [error.max for view in views for error in view.errors.values()] == [0] * 17
    assert not any(drawn.image.any() for drawn in cut_off_at(nothing, (4, 40)))
