"""Blend modes in planar maps."""

import numpy as np
import pytest
from test_compose import program_at

from gradient_drawings import (
    UPWARDS,
    blend_drawing,
)
from planar import gradient_colours
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.group import Blend
from vexture.tree.planar.programs import Keep, Mix

JUMPING = {Blend.COLOR_DODGE, Blend.COLOR_BURN, Blend.HUE, Blend.SATURATION, Blend.COLOR, Blend.LUMINOSITY}
"""Modes that jump where a component of a colour is 0 or 1, or where the colour is grey."""


@pytest.mark.parametrize("blend", Blend)
def test_programs_have_all_blend_modes(blend: Blend) -> None:
    conversion = run(blend_drawing(blend), Parameters("faces"))
    assert not conversion.notes
    up, keep, _, mix = program_at(conversion.tree, (0.4, 0.45))
    assert (keep, mix) == (Keep(), Mix(52428, blend))
    whole = UPWARDS.paint.gradient
    if blend in JUMPING:  # a band of it, between two stops, with its own places from 0 to 1
        assert [stop.offset for stop in up.stops] == [0.0, 1.0]
        seen = {(stop.color, stop.opacity) for stop in whole.stops}
        assert {(stop.color, stop.opacity) for stop in up.stops} < seen
        here = np.array([[0.4, 0.45]])
        np.testing.assert_allclose(gradient_colours(up, here), gradient_colours(whole, here), atol=1e-9)
    else:
        assert up == whole
