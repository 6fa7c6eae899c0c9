"""The coverage that textures store is compared with the exact one."""

import numpy as np
import pytest

from both_encodings import decode
from vexture.drawing.drawing import Drawing
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, convert_by, example
from vexture_evidence.measures.stored_coverage import stored_values

QUARTER = Drawing.polygon([(0.1, 0.1), (0.4, 0.1), (0.4, 0.35), (0.1, 0.35)])


@pytest.fixture(scope="module")
def shield():
    return ConvertedDrawing(example("simple-small"))


def test_stored_values_are_compared_with_the_area():
    conversion = convert_by(QUARTER, WAYS["direct"])
    values = stored_values(QUARTER, conversion.tree)
    assert values.quad_off.max() < 1e-4
    packed = stored_values(QUARTER, decode(convert_by(QUARTER, WAYS["packed"]).texture))
    assert 0.0 < packed.quad_off[0] <= 0.51 / 255
    wrong = conversion.tree
    wrong.coverage[0] += 0.1
    assert stored_values(QUARTER, wrong).quad_off[0] == pytest.approx(0.1, abs=1e-4)


def test_sixteen_samples_know_areas_in_sixteenths(shield):
    conversion = shield.way("sampled")
    values = stored_values(shield.drawing, conversion.tree, conversion.texture)
    with_curve = np.unique(values.found.owner)
    assert np.allclose(16 * values.found.coverage[with_curve], np.rint(16 * values.found.coverage[with_curve]))
