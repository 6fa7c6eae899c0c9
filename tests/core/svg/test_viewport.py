"""The viewport of a drawing, and what it lets through."""

from pathlib import Path

import numpy as np
import pytest
from lxml import etree

from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg
from vexture.svg.viewport import own_size, parse_fit, view_box, view_transform


def drawing_of(folder: Path, body: str, root: str = 'viewBox="0 0 100 100"') -> Drawing:
    file = folder / "drawing.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>')
    return read_svg(file)


def test_the_whole_viewport_fills_the_square(tmp_path: Path) -> None:
    drawing = drawing_of(tmp_path, '<rect width="200" height="100"/>', 'viewBox="0 0 200 100"')
    corners = drawing.paths[0].contours[0][:, 0]
    assert corners.tolist() == [[0, 0.75], [1, 0.75], [1, 0.25], [0, 0.25]]


@pytest.mark.parametrize(
    "root",
    [
        'viewBox="-5 7 30 20"',
        'viewBox="-5 7 30 20" width="300"',
        'viewBox="-5 7 30 20" width="90" height="90" preserveAspectRatio="xMinYMax"',
        'viewBox="-5 7 30 20" width="90" height="50" preserveAspectRatio="none"',
        'width="40" height="60"',
    ],
)
def test_to_source_gives_user_units(tmp_path: Path, root: str) -> None:
    drawing = drawing_of(tmp_path, '<path d="M3 9h8v4z"/>', root)
    start = drawing.paths[0].contours[0][:, 0]
    user = start @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]
    np.testing.assert_allclose(user, [[3, 9], [11, 9], [11, 13]], atol=1e-12)


def test_size_of_a_unitless_side_follows_the_view_box(tmp_path: Path) -> None:
    drawing = drawing_of(tmp_path, '<rect width="20" height="10"/>', 'viewBox="0 0 20 10" height="30mm"')
    assert np.ptp(drawing.paths[0].contours[0][:, 0], axis=0).tolist() == [1, 0.5]


BOX = (-5.0, 7.0, 30.0, 20.0)


@pytest.mark.parametrize(
    ("aspect", "expected"),
    [
        ("xMidYMid", (2.0, 2.0, 10.0, -14.0)),
        ("xMinYMid meet", (2.0, 2.0, 10.0, -14.0)),
        ("xMinYMid slice", (3.0, 3.0, 15.0, -31.0)),
        ("xMidYMax slice", (3.0, 3.0, 15.0, -41.0)),
        ("none", (3.0, 2.0, 15.0, -14.0)),
    ],
)
def test_a_view_box_is_fitted_into_its_viewport(aspect: str, expected: tuple[float, ...]) -> None:
    """Into 90 x 40, which is three times as wide and twice as high."""
    fit = parse_fit(aspect)
    assert fit is not None
    matrix = view_transform(BOX, fit, 90.0, 40.0)
    left = {"xMidYMid": 15.0}.get(aspect, 0.0)
    assert (matrix.xx, matrix.yy, matrix.dx - left, matrix.dy) == pytest.approx(expected)


def test_what_is_no_box_and_no_fit() -> None:
    assert view_box(" -5,7 30\n20 ") == BOX
    assert [view_box(text) for text in ("", "0 0 8", "0 0 8 -4", "0 0 8 4px", "0 0 8 4 2")] == [None] * 5
    assert [parse_fit(text) for text in ("", "xMid", "xMidYMid stretch", "yMidxMid")] == [None] * 4
    assert parse_fit("defer XMINYMAX") == (0.0, 1.0, "meet")


@pytest.mark.parametrize(
    ("attributes", "size"),
    [
        ('width="30" height="40"', (30, 40)),
        ('width="1in" height="50%"', (96, 150)),
        ('viewBox="0 0 40 20"', (40, 20)),
        ('viewBox="0 0 40 20" width="10"', (10, 5)),
        ('viewBox="0 0 40 20" height="100%" width="5em"', (80, 40)),
        ("", (300, 150)),
        ('viewBox="0 0 0 20"', (300, 150)),
    ],
)
def test_the_size_of_a_drawing_as_an_image(attributes: str, size: tuple[float, float]) -> None:
    assert own_size(etree.fromstring(f"<svg {attributes}/>")) == pytest.approx(size)
