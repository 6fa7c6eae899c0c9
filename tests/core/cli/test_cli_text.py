"""The command `text`: the paint of its letters."""

from vexture.cli.text import paint_of
from vexture.drawing.paint import BLACK, Paint


def test_a_paint_is_the_colour_without_its_opacity():
    assert paint_of((0.25, 0.0, 0.5, 0.5)) == Paint((0.5, 0.0, 1.0), 0.5)
    assert paint_of((0.0, 0.0, 0.0, 0.0)).opacity == 0.0
    assert paint_of(None) == BLACK
