"""What the artists of the comparing figures hold, and that they can be read."""

import numpy as np
import pytest
from fitting import assert_legible

from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact
from vexture_evidence.figures.comparisons import CORNER, FLOOR, SHOWN, equal_bytes, error_over_bytes
from vexture_evidence.measures.metrics import Errors
from vexture_evidence.measures.rivals import (
    MeasuredRival,
    Rival,
    distance_rival,
    measure_rival,
    raster_rival,
    scene_of,
    texture_rival,
)
from vexture_evidence.measures.shape import ConvertedDrawing, example

pytestmark = pytest.mark.slow  # test_report_is_whole draws these figures too

EMPTY = Drawing((), name="empty")


@pytest.fixture(scope="module")
def duck():
    return ConvertedDrawing(example("duck"))


@pytest.fixture(scope="module")
def measured(duck):
    scene = scene_of(duck.drawing)
    rivals = [raster_rival(duck.drawing, side) for side in (16, 64)]
    rivals += [distance_rival(duck.drawing, side, spread) for spread in (4.0, 1.0) for side in (16, 32)]
    rivals += [texture_rival(duck.way(way).texture, way) for way in ("packed", "direct", "sampled")]
    return [measure_rival(rival, scene) for rival in rivals]


def test_lines_hold_bytes_and_errors(measured):
    figure = error_over_bytes(measured)
    assert_legible(figure)
    lines = {line.get_label(): line for line in figure.axes[1].get_lines()}
    assert set(lines) == {found.rival.label for found in measured}
    rasters = [found for found in measured if found.rival.label == "raster"]
    assert lines["raster"].get_xdata().tolist() == [found.rival.file_bytes for found in rasters]
    assert lines["raster"].get_ydata().tolist() == [found.outline.mae for found in rasters]
    below = {line.get_label(): line for line in figure.axes[5].get_lines()}
    packed = measured[-3]
    assert below["packed"].get_xydata().tolist() == [[packed.rival.gpu_bytes, packed.small.mae]]
    assert {text.get_text() for text in figure.legends[0].get_texts()} == set(lines)


def test_ways_without_a_file_are_left_out_above_and_no_error_is_at_the_floor():
    nothing = Errors(0.0, 0.0, 0.0)
    bands = MeasuredRival(Rival("bands", "bands", None, 100, lambda size, view: np.zeros(size[::-1])), *[nothing] * 3)
    figure = error_over_bytes([bands])
    assert not figure.axes[0].get_lines()
    assert figure.axes[3].get_lines()[0].get_xydata().tolist() == [[100, FLOOR]]


def test_pictures_are_those_of_the_ways_and_of_the_truth(duck):
    rivals = [raster_rival(duck.drawing, 27), texture_rival(duck.way("packed").texture, "packed")]
    figure = equal_bytes(duck.drawing, rivals)
    assert_legible(figure)
    shown = [axes.images[0].get_array() for axes in figure.axes]
    np.testing.assert_array_equal(shown[2], render_exact(duck.drawing, (SHOWN, SHOWN)))
    np.testing.assert_array_equal(shown[0], rivals[0].draw((SHOWN, SHOWN), None))
    assert np.abs(shown[4] - shown[5]).max() < 0.05 < np.abs(shown[3] - shown[5]).max()
    frame = figure.axes[2].patches[0]
    assert frame.get_width() == SHOWN / CORNER
    part = shown[2][round(frame.get_y() + 0.5) :, round(frame.get_x() + 0.5) :][: SHOWN // CORNER, : SHOWN // CORNER]
    assert part.mean() == pytest.approx(shown[5].mean(), abs=0.03)  # the frame is around what is shown closer
    assert 0.0 < shown[5].mean() < 1.0


def test_long_numbers_do_not_run_into_one_another(duck):
    """As in a map, whose files are large."""

    def draw(size, view):
        return np.zeros(size[::-1], np.float32)

    names = ["raster", "raster", "distance, spread 4", "distance, spread 1", "packed"]
    assert_legible(
        equal_bytes(duck.drawing, [Rival("raster", name, 12_345_678, 12_345_678, draw, 1024) for name in names])
    )


def test_an_empty_drawing_has_pictures_too():
    assert_legible(equal_bytes(EMPTY, [raster_rival(EMPTY, 16)]))
    assert_legible(error_over_bytes([measure_rival(raster_rival(EMPTY, side), scene_of(EMPTY)) for side in (16, 32)]))
