"""Pictures in an SVG as Chromium draws them, beside the exact renderer."""

import io
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from svg_pictures import PLACED, SVG, file_of, link_of, read

from vexture.renderers.exact import render_exact_colours

NOISE = np.random.default_rng(3).integers(0, 256, (12, 12, 4)).astype(np.uint8)
SMOOTH = {
    "opaque": f'<image href="{link_of(file_of(NOISE[..., :3]))}" width="100" height="100"/>',
    "translucent": f'<image href="{link_of(file_of(NOISE))}" width="100" height="100"/>',
    "turned": f'<image href="{link_of(file_of(NOISE))}" width="70" height="70" transform="rotate(15 60 20)"/>',
}
"""Colours between centres of pixels."""


def drawn_by(page: Any, text: str) -> NDArray[np.float64]:
    """What a page shows of an SVG of 100 x 100 pixels, premultiplied."""
    page.set_content(f"<style>body {{ margin: 0 }} svg {{ display: block }}</style>{text}")
    picture = Image.open(
        io.BytesIO(page.screenshot(omit_background=True, clip={"x": 0, "y": 0, "width": 100, "height": 100}))
    )
    pixels = np.asarray(picture.convert("RGBA")) / 255
    return np.concatenate([pixels[..., :3] * pixels[..., 3:], pixels[..., 3:]], axis=2)


@pytest.mark.slow
def test_pictures_are_those_of_chromium(chromium: Any) -> None:
    page = chromium.new_page()
    cases = {case: (body.replace("optimizeSpeed", "pixelated"), 0.015, 0.3) for case, body in PLACED.items()}
    cases |= {case: (body, 0.025, 0.07) for case, body in SMOOTH.items()}
    found = {}
    for case, (body, most_mean, most) in cases.items():
        theirs, ours = drawn_by(page, SVG.format(body)), render_exact_colours(read(SVG.format(body)), 100)
        difference = np.abs(theirs - ours).max(axis=2)[(theirs[..., 3] > 0) | (ours[..., 3] > 0)]
        mean, large = float(difference.mean()), float(np.quantile(difference, 0.99))
        if mean > most_mean or large > most:
            found[case] = (mean, large)
    page.close()
    assert found == {}
