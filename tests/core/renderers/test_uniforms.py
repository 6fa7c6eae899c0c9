"""The arguments of a renderer, and the uniforms that follow from them."""

import numpy as np
import pytest
from test_renderers_cpu import source

from vexture.base.errors import ParameterError
from vexture.renderers.cpu import render_cpu


def test_without_a_base_and_with_one_it_is_the_same() -> None:
    texture = source("duck")[1]
    near = render_cpu(texture, (80, 80))
    np.testing.assert_allclose(render_cpu(texture, (80, 80), base=(0, 0)), near, atol=1e-6)
    np.testing.assert_allclose(render_cpu(texture, (80, 80), base=(123456789, 1 << 31)), near, atol=1e-6)


def test_a_root_that_does_not_exist_is_named() -> None:
    texture = source("duck")[1]
    with pytest.raises(ParameterError, match="`root` is 1; the texture has 1"):
        render_cpu(texture, (2, 2), root=1)
