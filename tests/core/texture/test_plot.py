"""The cells that a figure of a texture shows."""

import numpy as np

from vexture.texture.plot import cells_of


def test_the_first_cell_is_at_the_bottom_left() -> None:
    cells = cells_of(np.array([[0, 0, 0, 0xFF]], np.uint32), 0)
    np.testing.assert_allclose(cells[0], (0.0, 0.0, 0.5, 1.0, 1.0))
