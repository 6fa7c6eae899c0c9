"""The common style of figures: colours that are told apart, and panels of the unit square."""

import numpy as np
import pytest

from vexture_evidence.figures.style import COLOURS, coverage_map, panels, show, unit_axes


def test_methods_have_colours_of_their_own():
    assert len(set(COLOURS.values())) == len(COLOURS)
    rgb = {name: np.array([int(code[k : k + 2], 16) for k in (1, 3, 5)]) for name, code in COLOURS.items()}
    others = [(one, other) for one in rgb for other in rgb if one < other]
    assert min(np.abs(rgb[one] - rgb[other]).max() for one, other in others) > 40


def test_coverage_is_dark_where_it_is_full():
    brightness = [sum(coverage_map()(value)[:3]) for value in np.linspace(0.0, 1.0, 9)]
    assert brightness == sorted(brightness, reverse=True)
    assert brightness[0] == 3.0


def test_panels_have_their_size_and_titles_row_by_row():
    figure, axes = panels(2, 3, side=2.0, height=1.5, titles=list("abcd"))
    assert axes.shape == (2, 3)
    assert [panel.get_title(loc="left") for panel in axes.flat] == ["a", "b", "c", "d", "", ""]
    assert figure.get_size_inches().tolist() == [6.0, 3.0]
    assert figure._repr_png_().startswith(b"\x89PNG")


@pytest.mark.parametrize("value", [0.2, 0.9])
def test_pictures_of_one_value_have_its_shade(value):
    """Shades are those of coverage, and not of the picture's own least and largest values."""
    _, ((panel,),) = panels(1, 1)
    image = show(panel, np.full((2, 4), value))
    assert image.get_clim() == (0.0, 1.0)
    assert [label.get_text() for label in panel.get_xticklabels()] == ["0", "4 px"]
    assert panel.get_xlim() == (-0.5, 3.5)


def test_axes_are_a_part_of_the_square_with_its_middle_marked():
    _, ((panel,),) = panels(1, 1)
    unit_axes(panel, bounds=(0.25, 0.5, 0.75, 1.0))
    assert (panel.get_xlim(), panel.get_ylim()) == ((0.25, 0.75), (0.5, 1.0))
    assert panel.get_xticks().tolist() == [0.25, 0.5, 0.75]
    assert panel.get_aspect() == 1.0
