"""Other renderers' pictures of an SVG file and of a drawing, premultiplied RGBA in 0..1.

Only for files that we wrote ourselves: both libraries crash on hostile ones.
"""

import io
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import resvg
import skia
from PIL import Image

from same_fonts import FONTS
from vexture.drawing.drawing import Drawing

SIDE, FINER = 100, 4
"""Pixels across a picture, and those of it as it is drawn across one of them."""

VISIBLE = 40 / 255


@cache
def options() -> resvg.usvg.Options:
    """Options of resvg with the fonts."""
    made = resvg.usvg.Options.default()
    made.load_fonts_dir(str(FONTS))
    return made


def render_file(text: str) -> np.ndarray:
    """What resvg draws, (height, width, 4), at the file's own size."""
    tree = resvg.usvg.Tree.from_str(text, options())
    png = bytes(resvg.render(tree, (1, 0, 0, 0, 1, 0)))
    return premultiply(np.array(Image.open(io.BytesIO(png)).convert("RGBA")))


def render_drawing(drawing: Drawing, height: int, width: int) -> np.ndarray:
    """What Skia draws from the contours and groups of a drawing that fills a rectangle, (height, width, 4)."""
    peers = pytest.importorskip("vexture_evidence.measures.peers", reason="it needs vexture-evidence")
    size = max(height, width)
    pixels = np.zeros((size, size, 4), np.uint8)
    with skia.Surface(pixels) as canvas:
        peers.paint_with_skia(canvas, drawing, np.array([[size, 0, 0], [0, -size, size], [0, 0, 1]]))
    top, left = (size - height) // 2, (size - width) // 2
    return premultiply(pixels)[top : top + height, left : left + width]


def premultiply(pixels: np.ndarray) -> np.ndarray:
    scaled = pixels / 255.0
    scaled[..., :3] *= scaled[..., 3:]
    return scaled


def difference(path: Path, drawing: Drawing, text: str | None = None) -> tuple[float, float]:
    """Mean over the touched pixels and largest over all of the difference between file and drawing."""
    theirs = render_file(text or path.read_text())
    ours = render_drawing(drawing, *theirs.shape[:2])
    gap = np.abs(theirs - ours).max(axis=2)
    touched = (theirs[..., 3] > 0) | (ours[..., 3] > 0)
    return (float(gap[touched].mean()) if touched.any() else 0.0), float(gap.max())


def different_part(path: Path, drawing: Drawing, text: str | None = None) -> float:
    """Part of the pixels of a square file, drawn larger and reduced, that differ by more than `VISIBLE` on white."""
    larger = (text or path.read_text()).replace("<svg ", f'<svg width="{SIDE * FINER}" height="{SIDE * FINER}" ', 1)
    theirs = render_file(larger)
    pictures = [theirs, render_drawing(drawing, *theirs.shape[:2])]
    on_white = [picture[..., :3] + 1.0 - picture[..., 3:] for picture in pictures]
    coarse = [picture.reshape(SIDE, FINER, SIDE, FINER, 3).mean(axis=(1, 3)) for picture in on_white]
    return float((np.abs(coarse[0] - coarse[1]).max(axis=2) > VISIBLE).mean())
