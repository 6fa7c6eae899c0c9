"""SVGs with pictures, one issue each, and what is needed to make and read them."""

import base64
import io
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import vexture
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 100 100">{}</svg>'


def file_of(pixels: NDArray[np.uint8] | Image.Image, kind: str = "PNG", **options: Any) -> bytes:
    picture = pixels if isinstance(pixels, Image.Image) else Image.fromarray(pixels)
    file = io.BytesIO()
    picture.save(file, kind, **options)
    return file.getvalue()


def link_of(content: bytes, media_type: str = "image/png") -> str:
    return f"data:{media_type};base64,{base64.b64encode(content).decode()}"


def blocks() -> NDArray[np.uint8]:
    """3 x 2 pixels: six colours, two of them translucent."""
    colours = [(220, 30, 40, 255), (30, 140, 70, 255), (20, 60, 200, 255)]
    return np.array([colours, [(250, 200, 20, 255), (20, 20, 20, 128), (200, 40, 220, 64)]], np.uint8)


def slope(columns: int, rows: int) -> NDArray[np.uint8]:
    """Colours that change evenly, which every interpolation draws alike away from the borders."""
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    return np.stack([40 + 4 * x, 30 + 5 * y, 200 - 2 * x - 2 * y], axis=2).astype(np.uint8)


def read(text: str, folder: Path | None = None, **options: Any) -> Drawing:
    source: Path | bytes = text.encode()
    if folder is not None:
        source = folder / "drawing.svg"
        source.write_text(text)
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return vexture.read(source, **options)


IMAGE = 'href="{}" image-rendering="optimizeSpeed"'
BLOCKS = f"<image {IMAGE.format(link_of(file_of(blocks())))} "
WALL = '<path fill="#fe8" d="M0 0h100v100h-100z"/>'

PLACED = {
    "fitted": BLOCKS + 'x="10" y="10" width="80" height="80"/>',
    "sliced": BLOCKS + 'x="10" y="10" width="40" height="80" preserveAspectRatio="xMaxYMid slice"/>',
    "stretched": BLOCKS + 'x="10" y="10" width="50" height="80" preserveAspectRatio="none"/>',
    "at the end": BLOCKS + 'x="10" y="10" width="80" height="30" preserveAspectRatio="xMaxYMax meet"/>',
    "one side": BLOCKS + 'x="10" y="10" width="60"/>',
    "at its own size, enlarged": '<g transform="scale(25)">' + BLOCKS + "/></g>",
    "lengths": BLOCKS + 'x="10%" y="5mm" width="1in" style="font-size: 10px" height="4em"/>',
    "turned": BLOCKS + 'width="60" height="40" transform="translate(30 10) rotate(20)"/>',
    "slanted": BLOCKS + 'width="60" height="40" transform="translate(10 10) skewX(30)"/>',
    "mirrored": BLOCKS + 'width="60" height="40" transform="translate(80 10) scale(-1 1)"/>',
    "translucent": WALL + BLOCKS + 'x="10" y="10" width="60" height="40" opacity="0.5"/>',
    "in a translucent group": WALL
    + '<g opacity="0.5"><rect x="30" y="30" width="60" height="60"/>'
    + BLOCKS
    + 'x="10" y="10" width="60" height="40"/></g>',
    "clipped": '<clipPath id="c"><circle cx="40" cy="40" r="25"/></clipPath>'
    + BLOCKS
    + 'x="5" y="10" width="80" height="80" clip-path="url(#c)"/>',
    "masked": '<mask id="m"><circle cx="40" cy="40" r="25" fill="#888"/></mask>'
    + BLOCKS
    + 'x="5" y="10" width="80" height="80" mask="url(#m)"/>',
    "a mask": '<mask id="m">'
    + BLOCKS
    + 'x="10" y="10" width="60" height="40"/></mask><rect width="100" height="100" fill="teal" mask="url(#m)"/>',
    "a pattern": '<pattern id="p" width="30" height="20" patternUnits="userSpaceOnUse">'
    + BLOCKS
    + 'width="30" height="20"/></pattern><circle cx="50" cy="50" r="45" fill="url(#p)"/>',
    "a marker": '<marker id="k" markerWidth="30" markerHeight="20" markerUnits="userSpaceOnUse">'
    + BLOCKS
    + 'width="30" height="20"/></marker><path d="M20 20L60 60" marker-start="url(#k)" marker-end="url(#k)"/>',
    "used twice": f'<defs><symbol id="s" viewBox="0 0 60 40">{BLOCKS}width="60" height="40"/></symbol></defs>'
    '<use href="#s" width="45" height="30"/><use href="#s" x="50" y="50" width="30" height="20"/>',
    "multiplied": WALL + BLOCKS + 'x="10" y="10" width="60" height="40" style="mix-blend-mode: multiply"/>',
    "cut by a viewport": f'<svg x="20" y="20" width="50" height="30">{BLOCKS}width="60" height="40"/></svg>',
    "cut, whatever its overflow": BLOCKS + 'x="30" y="10" width="40" height="80" preserveAspectRatio="xMidYMid slice" '
    'style="overflow: visible"/>',
}
