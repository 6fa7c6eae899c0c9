"""What cannot be read is found."""

import pytest
from fitting import assert_legible, written

from vexture_evidence.figures.style import panels


@pytest.fixture
def figure():
    return panels(1, 2, titles=("left", "right"))[0]


def test_a_figure_of_the_one_style_is_legible(figure):
    assert_legible(figure)
    assert {"left", "right"} <= {text.get_text() for text, _ in written(figure)}


def test_text_of_axes_that_are_off_or_unseen_is_not_written(figure):
    figure.axes[0].set_axis_off()
    figure.axes[1].set_visible(False)
    figure.axes[1].text(0.5, 0.5, "tiny", fontsize=2)
    assert {text.get_text() for text, _ in written(figure)} == {"left"}
    assert_legible(figure)


def test_small_text_is_found(figure):
    figure.axes[0].text(0.5, 0.5, "tiny", fontsize=7)
    with pytest.raises(AssertionError, match="'tiny' has 7"):
        assert_legible(figure)


def test_text_that_is_cut_off_is_found(figure):
    figure.text(0.99, 0.5, "beyond")
    with pytest.raises(AssertionError, match="'beyond' is cut off"):
        assert_legible(figure)


def test_texts_in_one_place_are_found(figure):
    for word in ("one", "other"):
        figure.axes[0].text(0.5, 0.5, word)
    with pytest.raises(AssertionError, match="overlaps"):
        assert_legible(figure)
