"""The way of every source into the normal form."""

import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture.bezier.convert import ellipse_cubics, line_cubics, straight
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.drawing.paint import Paint


def polygon(*corners: tuple[float, float]) -> np.ndarray:
    start = np.array(corners, dtype=np.float64)
    return line_cubics(start, np.roll(start, -1, axis=0))


def test_the_box_is_centred_and_turned_upright() -> None:
    drawing = Drawing.from_source([Path((polygon((10, 20), (14, 20), (10, 22)),))], (10, 20, 4, 2), "wide")
    assert drawing.paths[0].contours[0][:, 0].tolist() == [[0, 0.75], [1, 0.75], [0, 0.25]]
    assert drawing.name == "wide"
    np.testing.assert_allclose(drawing.to_source @ (0, 0.75, 1), [10, 20])
    np.testing.assert_allclose(drawing.to_source @ (1, 0.25, 1), [14, 22])


def test_rule_and_paint_are_kept() -> None:
    paint = Paint((0.1, 0.2, 0.3), 0.4)
    path = Path((polygon((0, 0), (1, 0), (1, 1)),), FillRule.EVENODD, paint)
    (kept,) = Drawing.from_source([path], (0, 0, 1, 1)).paths
    assert (kept.fill_rule, kept.paint) == (FillRule.EVENODD, paint)


def test_what_is_outside_the_box_is_clipped() -> None:
    circle, far = ellipse_cubics((0, 1), (1, 1), 1e-3), ellipse_cubics((9, 9), (1, 1), 1e-3)
    drawing = Drawing.from_source([Path((circle, far)), Path((far,))], (0, 0, 4, 2))
    ((contour,),) = (path.contours for path in drawing.paths)
    assert contour[:, ::3].min() == 0.0
    assert contour[:, 0, 0].max() == 0.25


def test_contours_are_tidy() -> None:
    """Steps without length go, gaps of rounding close, lines are exact, what encloses nothing is dropped."""
    noisy = polygon((0, 0), (3, 0), (3 + 1e-12, 1e-12), (3, 3), (3, 3))
    there_and_back = polygon((0, 0), (2, 2))
    drawing = Drawing.from_source([Path((noisy, there_and_back)), Path((there_and_back,))], (0, 0, 7, 7))
    ((contour,),) = (path.contours for path in drawing.paths)
    assert len(contour) == 3
    assert straight(contour).all()
    assert (contour == line_cubics(contour[:, 0], contour[:, 3])).all()
    assert (contour[:, 3] == np.roll(contour[:, 0], -1, axis=0)).all()


def test_contours_of_many_paths_do_not_mix() -> None:
    squares = [polygon((k, 0), (k + 1, 0), (k + 1, 1), (k, 1)) for k in range(10)]
    empty = polygon((0, 0), (1, 1))
    paths = [Path((squares[k], empty, squares[k + 1])) for k in range(0, 10, 2)]
    drawing = Drawing.from_source(paths, (0, 0, 10, 10))
    lefts = [[round(contour[..., 0].min() * 10) for contour in path.contours] for path in drawing.paths]
    assert lefts == [[0, 1], [2, 3], [4, 5], [6, 7], [8, 9]]


@pytest.mark.parametrize("box", [(0, 0, 0, 5), (0, 0, 5, -1), (0, 0, np.nan, 1), (0, 0, np.inf, 1)])
def test_a_box_without_area_is_refused(box: tuple[float, float, float, float]) -> None:
    with pytest.raises(SourceError, match=r"the drawing.s box is .*; both must be above 0"):
        Drawing.from_source([], box)


def test_coordinates_far_away_are_refused() -> None:
    with pytest.raises(SourceError, match=r"1e\+10 times the size of the drawing away; the limit is 1e\+09"):
        Drawing.from_source([Path((polygon((0, 0), (1e10, 0), (0, 1)),))], (0, 0, 1, 1))


def test_nothing_is_a_drawing() -> None:
    assert Drawing.from_source([], (0, 0, 1, 1)).paths == ()


def test_contours_that_close_one_another_only_are_open():
    there, back = (
        line_cubics(*np.array([[start], [end]], float)) for start, end in (((0, 0), (1, 0)), ((1, 0), (0, 0)))
    )
    Path((np.concatenate([there, back]), np.concatenate([back, there])))
    with pytest.raises(SourceError, match="a contour is open"):
        Path((there, back))
