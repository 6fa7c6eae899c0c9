"""Random drawings in colours against the exact renderer: up to 30 layers, groups, masks, all blend modes."""

import numpy as np
import pytest

from planar import layered_drawing
from vexture.renderers.exact import render_exact_colours
from vexture.renderers.view import fit
from vexture.texture.encode import encode
from vexture.texture.texture import Root
from vexture.tree.planar.build import build_map

SIZES = (16, 20, 64, 100)
MOST = 2 / 255


def check(seed: int) -> None:
    """Compare all pixels, also those on cells of which only the mean is known: at these sizes they are far smaller."""
    drawing = layered_drawing(seed)
    planar = build_map(drawing)
    assert planar is not None
    texture = encode([planar], [Root("layered")], name="layered")
    for side in SIZES:
        view = (side, side), fit((side, side))
        gap = np.abs(texture.render(*view) - render_exact_colours(drawing, *view)).max()
        assert gap < MOST, (seed, side, 255 * gap)


@pytest.mark.parametrize("seed", [*range(5), 666])  # the last dodges a component that is 0 but for rounding
def test_random_drawings_are_exact(seed: int) -> None:
    check(seed)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 5000, 500))
def test_five_thousand_random_drawings_are_exact(first: int) -> None:
    for seed in range(first, first + 500):
        check(seed)
