"""Sampled filters beside those of Chromium, at one pixel a unit."""

import io
from typing import Any

import numpy as np
import pytest
from PIL import Image

from vexture.svg.filter_frame import PixelFrame
from vexture.svg.filter_noise import turbulence
from vexture.svg.filter_operations import (
    Convolution,
    Displacement,
    DistantLight,
    GaussianBlur,
    Lighting,
    LightSource,
    Morphology,
    PointLight,
    PorterDuff,
    RasterStep,
    Shift,
    SolidColor,
    SpotLight,
    Stack,
    Turbulence,
)
from vexture.svg.filter_raster import evaluate

SIDE = 64
FRAME = PixelFrame(0.0, 0.0, 1.0, 1.0, SIDE, SIDE)
SHAPES = (
    '<rect x="10" y="14" width="26" height="30" fill="#e06020"/>'
    '<circle cx="40" cy="36" r="16.3" fill="#2050d0" fill-opacity=".7"/>'
)
LIGHTS: list[tuple[str, LightSource]] = [
    ('<feDistantLight azimuth="235" elevation="40"/>', DistantLight(235.0, 40.0)),
    ('<fePointLight x="20" y="10" z="15"/>', PointLight((20.0, 10.0, 15.0))),
    (
        '<feSpotLight x="10" y="5" z="20" pointsAtX="40" pointsAtY="40" pointsAtZ="0" specularExponent="4" '
        'limitingConeAngle="25"/>',
        SpotLight((10.0, 5.0, 20.0), (40.0, 40.0, 0.0), 4.0, 25.0),
    ),
]
WARM = (1.0, 0xE0 / 255, 0xA0 / 255)
MATRIX = (1.0, 2.0, -1.0, 0.0, 3.0, -2.0)
BLURRED = RasterStep(GaussianBlur((2.0, 2.0)), ("SourceAlpha",), "b")
BLUR = '<feGaussianBlur in="SourceAlpha" stdDeviation="2" result="b"/>'

CASES: dict[str, tuple[str, list[RasterStep], float, float]] = {  # and the largest and mean difference, of 255
    "blur": (
        '<feGaussianBlur stdDeviation="3 1.5"/>',
        [RasterStep(GaussianBlur((3.0, 1.5)), ("SourceGraphic",))],
        *(9.0, 0.9),
    ),
    "dilation": (
        '<feMorphology operator="dilate" radius="3 1"/>',
        [RasterStep(Morphology((3.0, 1.0), True), ("SourceGraphic",))],
        *(5.0, 0.4),
    ),
    "erosion": (
        '<feMorphology radius="2"/>',
        [RasterStep(Morphology((2.0, 2.0)), ("SourceGraphic",))],
        *(5.0, 0.4),
    ),
    "convolution": (
        '<feConvolveMatrix order="3 2" kernelMatrix="1 2 -1 0 3 -2" targetX="2" targetY="0" divisor="2"/>',
        [RasterStep(Convolution((3, 2), MATRIX, 2.0, 0.0, (2, 0)), ("SourceGraphic",))],
        *(12.0, 0.5),
    ),
    "displacement": (  # by whole pixels: Chromium interpolates nothing
        '<feFlood flood-color="#8000ff" result="m"/>'
        '<feDisplacementMap in="SourceGraphic" in2="m" scale="12" xChannelSelector="B" yChannelSelector="G"/>',
        [
            RasterStep(SolidColor((0x80 / 255, 0.0, 1.0, 1.0)), (), "m"),
            RasterStep(Displacement(12.0, (2, 1)), ("SourceGraphic", "m")),
        ],
        *(5.0, 0.4),
    ),
    "shadow": (
        f'{BLUR}<feOffset dx="4" dy="4" result="o"/><feFlood flood-color="#802000" flood-opacity=".8"/>'
        '<feComposite in2="o" operator="in"/><feMerge><feMergeNode/><feMergeNode in="SourceGraphic"/></feMerge>',
        [
            BLURRED,
            RasterStep(Shift(4.0, 4.0), ("b",), "o"),
            RasterStep(SolidColor((0x80 / 255, 0x20 / 255, 0.0, 0.8))),
            RasterStep(PorterDuff("in"), ("", "o")),
            RasterStep(Stack(), ("", "SourceGraphic")),
        ],
        *(10.0, 0.5),
    ),
    "lighter": (
        '<feFlood flood-color="lime" flood-opacity=".5" x="5" y="5" width="30" height="40" result="a"/>'
        '<feComposite in="SourceGraphic" in2="a" operator="lighter"/>',
        [
            RasterStep(SolidColor((0.0, 1.0, 0.0, 0.5)), (), "a", (5.0, 5.0, 35.0, 45.0)),
            RasterStep(PorterDuff("lighter"), ("SourceGraphic", "a")),
        ],
        *(5.0, 0.4),
    ),
}
for text, light in LIGHTS:  # in sRGB: Chromium rounds linear light to 8 bits, which is coarse in the dark
    name = type(light).__name__
    CASES[f"{name}, matt"] = (
        '<feDiffuseLighting in="SourceAlpha" surfaceScale="3" diffuseConstant="1.2" lighting-color="#ffe0a0" '
        f'color-interpolation-filters="sRGB">{text}</feDiffuseLighting>',
        [RasterStep(Lighting(light, WARM, 3.0, 1.2), ("SourceAlpha",), is_linear=False)],
        *(2.0, 0.5),
    )
    CASES[f"{name}, shiny"] = (
        '<feSpecularLighting in="SourceAlpha" surfaceScale="3" specularConstant=".9" specularExponent="12" '
        f'lighting-color="#ffe0a0" color-interpolation-filters="sRGB">{text}</feSpecularLighting>',
        [RasterStep(Lighting(light, WARM, 3.0, 0.9, 12.0), ("SourceAlpha",), is_linear=False)],
        *(2.0, 0.5),
    )


@pytest.fixture(scope="module")
def pictures(chromium: Any) -> list[np.ndarray]:
    """The shapes without a filter, with each filter of `CASES`, and three kinds of noise, from one page."""
    bodies = [f"<g>{SHAPES}</g>"]
    bodies += [filtered(text, SHAPES) for text, *_ in CASES.values()]
    bodies += [filtered(noise_text(noise), SHAPES) for noise in NOISES]
    page = chromium.new_page(viewport={"width": SIDE, "height": SIDE * len(bodies)})
    svgs = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIDE}" height="{SIDE}">{body.replace("NAME", f"f{k}")}</svg>'
        for k, body in enumerate(bodies)
    ]
    page.set_content(f"<style>body{{margin:0}}svg{{display:block}}</style>{''.join(svgs)}")
    whole = np.array(Image.open(io.BytesIO(page.screenshot(omit_background=True))).convert("RGBA")) / 255.0
    page.close()
    whole[..., :3] *= whole[..., 3:]
    return np.split(whole, len(bodies))


def filtered(text: str, body: str) -> str:
    return (
        f'<filter id="NAME" x="0" y="0" width="{SIDE}" height="{SIDE}" filterUnits="userSpaceOnUse">{text}</filter>'
        f'<g filter="url(#NAME)">{body}</g>'
    )


NOISES = [
    Turbulence((0.05, 0.05), 2),
    Turbulence((0.05, 0.02), 1, 3.0, is_fractal=True),
    Turbulence((0.031, 0.047), 3, 1.0, is_stitched=True),
]


def noise_text(noise: Turbulence) -> str:
    return (
        f'<feTurbulence baseFrequency="{noise.frequency[0]} {noise.frequency[1]}" numOctaves="{noise.octaves}" '
        f'seed="{noise.seed}" type="{"fractalNoise" if noise.is_fractal else "turbulence"}" '
        f'stitchTiles="{"stitch" if noise.is_stitched else "noStitch"}" color-interpolation-filters="sRGB"/>'
    )


@pytest.mark.parametrize("name", CASES)
def test_filters_look_as_in_chromium(name: str, pictures: list[np.ndarray]) -> None:
    _, steps, most, mean = CASES[name]
    expected = pictures[1 + list(CASES).index(name)]
    gap = 255.0 * np.abs(evaluate(steps, {"SourceGraphic": pictures[0]}, FRAME) - expected)
    assert gap.max() <= most
    assert gap.mean() <= mean


@pytest.mark.parametrize("noise", NOISES)
def test_noise_looks_as_in_chromium(noise: Turbulence, pictures: list[np.ndarray]) -> None:
    expected = pictures[1 + len(CASES) + NOISES.index(noise)]
    frame = PixelFrame(0.5, 0.5, 1.0, 1.0, SIDE, SIDE)  # it takes places half a unit further
    found = turbulence(noise, frame, (0.0, 0.0, float(SIDE), float(SIDE)))
    assert 255.0 * np.abs(found - expected).max() <= 2.0
