"""Places of a filter's pixels: cover of rectangles, crops, moves and tiles."""

import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture.svg.filter_frame import (
    PixelFrame,
    crop,
    fill_border,
    intersect_rectangles,
    sample_columns,
    sample_rows,
    shift,
    tile,
)

FRAME = PixelFrame(-3.0, 2.0, 0.5, 0.25, 12, 9)


def random_pixels(frame: PixelFrame, seed: int = 1) -> np.ndarray:
    pixels = np.random.default_rng(seed).random((frame.rows, frame.columns, 4))
    pixels[..., :3] *= pixels[..., 3:]
    return pixels


def test_pixels_lie_from_the_corner_rightwards_and_downwards() -> None:
    assert FRAME.xs[:2].tolist() == [-2.75, -2.25]
    assert FRAME.ys[:2].tolist() == [2.125, 2.375]
    assert (len(FRAME.ys), len(FRAME.xs)) == (12, 9)
    assert FRAME.bounds == (-3.0, 2.0, 1.5, 5.0)


@pytest.mark.parametrize("numbers", [(0, 0, 0, 1), (0, np.nan, 1, 1), (0, 0, 1, -1), (0, 1e13, 1, 1), (0, 0, 1, 1e-10)])
def test_pixels_have_a_size(numbers: tuple[float, float, float, float]) -> None:
    with pytest.raises(SourceError, match=r"2 x 2 pixels of .* at .*; use pixels of 1e-09 to 1e.12, nearer than 1e.12"):
        PixelFrame(*numbers, 2, 2)


def test_covers_have_the_area_of_the_rectangle() -> None:
    rows, columns = FRAME.cover((-2.9, 2.1, 0.7, 4.33))
    assert rows.sum() * 0.25 == pytest.approx(2.23)
    assert columns.sum() * 0.5 == pytest.approx(3.6)
    assert columns.round(9).tolist() == [0.8, *[1.0] * 6, 0.4, 0.0]
    assert [part.sum() for part in FRAME.cover((9.0, 9.0, 10.0, 10.0))] == [0.0, 0.0]
    assert FRAME.cover((0.5, 3.0, 0.5, 4.0))[1].sum() == 0.0


def test_an_empty_intersection_has_no_extent() -> None:
    assert intersect_rectangles((0, 0, 2, 2), (5, 5, 7, 7)) == (5, 5, 5, 5)


def test_a_crop_is_undone_at_shared_sides_only() -> None:
    rectangle = (-2.9, 2.1, 0.7, 4.33)
    pixels = random_pixels(FRAME)
    cropped = crop(pixels, FRAME, rectangle)
    rows, columns = FRAME.cover(rectangle)
    np.testing.assert_allclose(cropped, pixels * rows[:, None, None] * columns[None, :, None])
    inside = (rows[:, None] * columns > 0.0)[..., None]
    np.testing.assert_allclose(fill_border(cropped, FRAME, rectangle, rectangle), pixels * inside)
    upper = fill_border(cropped, FRAME, rectangle, (-2.9, 2.1, 1.5, 5.0))  # shares the left and the upper side
    assert upper[0, 0, 3] == pytest.approx(pixels[0, 0, 3])
    assert upper[0, 7, 3] == pytest.approx(pixels[0, 7, 3] * columns[7])
    assert fill_border(cropped, FRAME, rectangle, (0.0, 0.0, 1.0, 1.0)) is cropped


def test_a_move_by_whole_pixels_is_exact() -> None:
    pixels = random_pixels(FRAME)
    moved = shift(pixels, FRAME, 1.0, -0.75)
    np.testing.assert_array_equal(moved[:-3, 2:], pixels[3:, :-2])
    assert not moved[-3:].any()
    assert not moved[:, :2].any()
    assert not shift(pixels, FRAME, 1e300, 0.0).any()


def test_a_move_by_part_of_a_pixel_keeps_the_sum() -> None:
    pixels = np.zeros((12, 9, 4))
    pixels[4:7, 3:5] = random_pixels(FRAME)[4:7, 3:5]
    moved = shift(pixels, FRAME, 0.2, 0.1)
    np.testing.assert_allclose(moved.sum(axis=(0, 1)), pixels.sum(axis=(0, 1)))
    weights = (pixels[..., 3].sum(axis=0) * FRAME.xs).sum(), (moved[..., 3].sum(axis=0) * FRAME.xs).sum()
    assert (weights[1] - weights[0]) / pixels[..., 3].sum() == pytest.approx(0.2)


def test_tiles_of_whole_pixels_repeat() -> None:
    pixels = random_pixels(FRAME)
    tiled = tile(pixels, FRAME, (-2.5, 2.5, -1.0, 3.5))  # columns 1 to 3, rows 2 to 5
    for row in range(12):
        for column in range(9):
            expected = pixels[2 + (row - 2) % 4, 1 + (column - 1) % 3]
            np.testing.assert_array_equal(tiled[row, column], expected)


def test_tiles_of_parts_of_pixels_have_their_period() -> None:
    frame = PixelFrame(0.0, 0.0, 1.0, 1.0, 40, 40)
    xs = frame.xs
    pixels = np.repeat(0.5 + 0.5 * np.sin(2.0 * np.pi * xs / 12.5)[None, :, None], 40, axis=0).repeat(4, axis=2)
    tiled = tile(pixels, frame, (0.0, 0.0, 12.5, 7.0))
    np.testing.assert_allclose(tiled, pixels, atol=0.04)  # linear between pixels


def test_a_tile_without_extent_shows_nothing() -> None:
    assert not tile(random_pixels(FRAME), FRAME, (0.0, 3.0, 0.0, 4.0)).any()


def test_a_tile_beyond_the_pixels_or_thinner_than_one_is_harmless() -> None:
    pixels = random_pixels(FRAME)
    for rectangle in [(50.0, 50.0, 60.0, 60.0), (0.1, 3.0, 0.1001, 3.0001), (-1e9, -1e9, 1e9, 1e9)]:
        assert np.isfinite(tile(pixels, FRAME, rectangle)).all()


def test_values_between_pixels_are_linear_and_end_as_the_mode_says() -> None:
    values = np.array([1.0, 2.0, 4.0])
    places = np.array([-9.0, -0.5, 0.25, 1.5, 2.5, 9.0])
    edges = (-0.5, 2.5)
    assert sample_rows(values, places, edges, "duplicate").tolist() == [1.0, 1.0, 1.25, 3.0, 4.0, 4.0]
    assert sample_rows(values, places, edges, "none").tolist() == [0.0, 0.5, 1.25, 3.0, 2.0, 0.0]
    assert sample_rows(values, places, edges, "wrap").tolist() == [1.0, 2.5, 1.25, 3.0, 2.5, 1.0]
    table = np.arange(6.0).reshape(2, 3)
    assert sample_columns(table, np.array([0.5]), edges, "none").tolist() == [[0.5], [3.5]]
