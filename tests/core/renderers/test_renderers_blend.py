"""Blend modes of the exact renderer, by hand and by Skia."""

import numpy as np
import pytest
import skia
from test_exact_colours import colour_of, full

from vexture.drawing.group import Blend, Group
from vexture.drawing.paint import Paint

PIXEL = (1, 1)


@pytest.mark.parametrize(
    ("blend", "below", "over", "expected"),
    [
        (Blend.NORMAL, 0.25, 0.75, 0.75),
        (Blend.MULTIPLY, 0.5, 0.75, 0.375),
        (Blend.SCREEN, 0.5, 0.75, 0.875),
        (Blend.OVERLAY, 0.25, 0.75, 0.375),
        (Blend.OVERLAY, 0.75, 0.25, 0.625),
        (Blend.DARKEN, 0.25, 0.75, 0.25),
        (Blend.LIGHTEN, 0.25, 0.75, 0.75),
        (Blend.COLOR_DODGE, 0.25, 0.5, 0.5),
        (Blend.COLOR_DODGE, 0.75, 0.5, 1.0),
        (Blend.COLOR_DODGE, 0.0, 1.0, 0.0),
        (Blend.COLOR_DODGE, 0.25, 1.0, 1.0),
        (Blend.COLOR_BURN, 0.75, 0.5, 0.5),
        (Blend.COLOR_BURN, 0.25, 0.5, 0.0),
        (Blend.COLOR_BURN, 1.0, 0.0, 1.0),
        (Blend.COLOR_BURN, 0.5, 0.0, 0.0),
        (Blend.HARD_LIGHT, 0.75, 0.25, 0.375),
        (Blend.HARD_LIGHT, 0.25, 0.75, 0.625),
        (Blend.SOFT_LIGHT, 0.5, 0.25, 0.375),
        (Blend.SOFT_LIGHT, 0.25, 0.75, 0.375),
        (Blend.SOFT_LIGHT, 0.0625, 1.0, 0.20703125),
        (Blend.DIFFERENCE, 0.25, 0.75, 0.5),
        (Blend.EXCLUSION, 0.25, 0.75, 0.625),
        (Blend.PLUS_LIGHTER, 0.25, 0.5, 0.75),
        (Blend.PLUS_LIGHTER, 0.75, 0.5, 1.0),
        (Blend.HUE, 0.25, 0.75, 0.25),
        (Blend.SATURATION, 0.25, 0.75, 0.25),
        (Blend.COLOR, 0.25, 0.75, 0.25),
        (Blend.LUMINOSITY, 0.25, 0.75, 0.75),
    ],
)
def test_blend_modes_of_greys_by_hand(blend, below, over, expected):
    colour = colour_of(full(Paint((below,) * 3)), full(Paint((over,) * 3), 0), groups=(Group(blend=blend),))
    assert colour == pytest.approx([expected, expected, expected, 1.0], abs=1e-7)


SKIA = {blend: "k" + blend.name.title().replace("_", "") for blend in Blend}
SKIA |= {Blend.NORMAL: "kSrcOver", Blend.PLUS_LIGHTER: "kPlus"}


@pytest.mark.slow
@pytest.mark.parametrize("blend", Blend)
def test_blend_modes_are_those_of_skia(blend):
    """Of random colours of 8 bits, 0 and 255 often among them; Skia computes in float32."""
    rng = np.random.default_rng(blend)
    pixel = np.zeros((*PIXEL, 4), np.float32)
    info = skia.ImageInfo.Make(*PIXEL, skia.ColorType.kRGBA_F32_ColorType, skia.AlphaType.kPremul_AlphaType)
    surface = skia.Surface.MakeRasterDirect(info, pixel, pixel.strides[0])
    canvas = surface.getCanvas()
    for _ in range(200):
        below, over = np.clip(rng.integers(-80, 335, (2, 4)), 0, 255) / 255
        canvas.clear(skia.Color4f(0.0, 0.0, 0.0, 0.0))
        canvas.drawPaint(skia.Paint(Color4f=skia.Color4f(*below)))
        paint = skia.Paint(Color4f=skia.Color4f(*over[:3], over[3]))
        paint.setBlendMode(getattr(skia.BlendMode, SKIA[blend]))
        canvas.drawPaint(paint)
        groups = (Group(blend=blend),)
        paths = full(Paint(tuple(below[:3]), below[3])), full(Paint(tuple(over[:3]), over[3]), 0)
        assert colour_of(*paths, groups=groups) == pytest.approx(pixel[0, 0].tolist(), abs=1e-5)
