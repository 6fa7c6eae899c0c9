"""Programs of planar maps: the paints of faces in which gradients are seen."""

from itertools import pairwise

import pytest

from gradient_drawings import SQUARE, linear, painted_path
from vexture.drawing.drawing import Drawing
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Gradient, Paint, Stop
from vexture.tree.planar.build import build_map
from vexture.tree.planar.programs import Solid, ending_of, number_of_ending

ENDINGS = [*Blend, *(mask for mask in Mask if mask)]


@pytest.mark.parametrize("ending", ENDINGS)
def test_the_ending_of_a_group_is_found_by_its_number(ending: Blend | Mask) -> None:
    found = ending_of(number_of_ending(ending))
    assert found == ending
    assert type(found) is type(ending)


def test_endings_have_different_numbers() -> None:
    assert all(a != b for a, b in pairwise(sorted(map(number_of_ending, ENDINGS))))


def test_a_translucent_gradient_is_painted_on_the_solid_below() -> None:
    fading = linear((0, 0), (1, 0), (Stop(0.0, (0.0, 0.0, 1.0), 0.25), Stop(1.0, (0.0, 1.0, 0.0), 0.75)))
    planar = build_map(Drawing((painted_path(SQUARE, Paint((1.0, 0.0, 0.0))), painted_path(SQUARE, fading))))
    (program,) = planar.programs.values()
    assert program[0] == Solid((65535, 0, 0, 65535))
    assert isinstance(program[1], Gradient)
    assert [stop.opacity for stop in program[1].stops] == [0.25, 0.75]
