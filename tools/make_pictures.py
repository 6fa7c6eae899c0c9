"""Make the README's picture with vexture itself: `python tools/make_pictures.py` writes docs/pictures/first.png.

On the left the texture, its two images enlarged pixel by pixel; then the drawing as the shader's mirror draws it from
that texture, whole and in two steps of magnification, each a detail of the one before.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

import vexture

__all__ = ["picture"]

ROOT = Path(__file__).resolve().parents[1]
SHAPE = ROOT / "examples" / "shapes" / "duck.svg"
TARGET = ROOT / "docs" / "pictures" / "first.png"

SIDE = 360  # pixels, of each of the three views
GAP = 24
TEXEL = 9  # pixels, of the enlarged textures
INK = np.array([224.0, 150.0, 0.0])
PAPER = np.array([255.0, 255.0, 255.0])
FRAME = (40, 40, 40)
CENTER = (228 / 256, 1 - 90 / 256)  # unit-square units: where the duck's bill opens
SPANS = (1.0, 1 / 8, 1 / 64)  # unit-square units, of the views

Pixels = NDArray[np.uint8]


def corner(span: float) -> tuple[float, float]:
    """Lower left corner of a view."""
    return tuple(min(max(middle - span / 2, 0.0), 1.0 - span) for middle in CENTER)  # type: ignore[return-value]


def view(texture: vexture.ThesisTexture, span: float) -> Image.Image:
    """Draw a square part of the unit square."""
    (x, y), pixel = corner(span), span / SIDE
    to_unit = [[pixel, 0.0, x], [0.0, -pixel, y + span]]
    coverage = vexture.render(texture, size=(SIDE, SIDE), to_unit=to_unit, renderer="cpu")[..., None]
    return Image.fromarray(np.rint(INK * coverage + PAPER * (1.0 - coverage)).astype(np.uint8))


def enlarged(rows: NDArray[np.uint16]) -> Image.Image:
    """Show a list of the texture, folded into columns as high as the views."""
    height = SIDE // TEXEL
    columns = [rows[start : start + height] for start in range(0, len(rows), height)]
    gap = 1
    width = sum(column.shape[1] + gap for column in columns) - gap
    sheet = np.full((height, width, 3), 255, np.uint8)
    at = 0
    for column in columns:
        sheet[: len(column), at : at + column.shape[1]] = column >> 8
        at += column.shape[1] + gap
    return Image.fromarray(sheet).resize((width * TEXEL, height * TEXEL), Image.Resampling.NEAREST)


def picture(texture: vexture.ThesisTexture) -> Image.Image:
    """Put the texture and its views side by side, with a frame around what the next view magnifies."""
    views = [view(texture, span) for span in SPANS]
    for image, span, inner in zip(views, SPANS, SPANS[1:], strict=False):
        (x, y), (inner_x, inner_y) = corner(span), corner(inner)
        left, top = (inner_x - x) / span * SIDE, (1 - (inner_y + inner - y) / span) * SIDE
        ImageDraw.Draw(image).rectangle(
            (left, top, left + inner / span * SIDE, top + inner / span * SIDE), outline=FRAME
        )
    for image in views[1:]:
        ImageDraw.Draw(image).rectangle((0, 0, SIDE - 1, SIDE - 1), outline=FRAME)
    parts = [enlarged(texture.quads), enlarged(texture.curves), *views]
    whole = Image.new("RGB", (sum(part.width + GAP for part in parts) - GAP, SIDE), "white")
    at = 0
    for part in parts:
        whole.paste(part, (at, 0))
        at += part.width + GAP
    return whole


if __name__ == "__main__":
    TARGET.parent.mkdir(parents=True, exist_ok=True)
    picture(vexture.convert(SHAPE)).save(TARGET, optimize=True)
