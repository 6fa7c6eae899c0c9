"""A texture of one texel, decoded."""

import numpy as np

from vexture.texture.decode import decode
from vexture.texture.root import Root
from vexture.texture.texture import Texture


def test_a_full_cell_is_decoded() -> None:
    texels = np.array([[[0, 0, 0, 0xFF]]], np.uint32)
    np.testing.assert_allclose(decode(Texture(texels, (Root("a quarter"),))).coverage, [(1.0, 0.0, 0.0, 0.0)])
