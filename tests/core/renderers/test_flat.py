"""Flat views of colours."""

import numpy as np
import pytest
from packed_views import ENTRIES
from test_colours import DRAWINGS, NEAR, SHADED, made

from vexture.renderers.colour import render_cpu_colours
from vexture.renderers.view import fit


@pytest.mark.parametrize("name", DRAWINGS | SHADED)
def test_a_flat_view_is_any_view(name: str) -> None:
    _drawing, texture = made(name)
    for side in (20, 64):
        view = (side, side), fit((side, side))
        flat, any_view = (render_cpu_colours(texture, *entry(view)) for entry in ENTRIES.values())
        assert np.abs(flat - any_view).max() < NEAR
