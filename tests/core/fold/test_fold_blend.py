"""How far a texel has come at a time."""

import numpy as np
import pytest

from vexture.fold.blend import progress
from vexture.fold.layout import FOLD_KIND_SHIFT, FOLD_SMOOTH_START, FOLD_TICKS


def test_a_smooth_start_of_one_second() -> None:
    one_second = np.array([0, 0, FOLD_SMOOTH_START << FOLD_KIND_SHIFT, FOLD_TICKS], np.uint32)
    shares = [float(progress(time, 0.0, one_second)) for time in (-1, 0.5, 3)]
    assert shares == pytest.approx([0.0, 0.25, 1.0], abs=1e-12)
