"""Raster images as drawings of one picture, pixel by pixel."""

import os
from dataclasses import replace
from typing import Final

import numpy as np

from vexture.base.layout import MOST_ROWS, ROW_BITS
from vexture.base.notes import Notes
from vexture.base.pixels import decode_picture, premultiply
from vexture.bezier.convert import line_cubics
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Picture, Sampling
from vexture.drawing.picture_size import halve, halvings_needed
from vexture.tracing.squares import cells_of

MOST_TEXELS: Final = (MOST_ROWS << ROW_BITS) // 2
"""Most texels of a picture with all its levels: half of what a texture holds."""


def picture_drawing(source: str | os.PathLike[str] | bytes, name: str) -> Drawing:
    """Read a raster image as a rectangle with its pixels; pixel art has sharp ones.

    The drawing contains the notes, and `to_source` maps it to pixels of the file, y down.
    """
    notes = Notes()
    decoded = decode_picture(source)
    for remark in decoded.remarks:
        notes.simplification(remark)
    rows, columns = decoded.pixels.shape[:2]
    cells = cells_of(decoded.pixels)
    pixels = premultiply(decoded.pixels if cells is None else cells)
    times = halvings_needed(pixels.shape[1], pixels.shape[0], MOST_TEXELS)
    if times:
        pixels = halve(pixels, times)
        size = f"{pixels.shape[1]:,} x {pixels.shape[0]:,} of its {columns:,} x {rows:,} pixels"
        notes.simplification(f"{size} (a picture takes at most {MOST_TEXELS:,} texels, and 16,384 pixels a side)")
    across, down = (cells.shape[1] / columns, cells.shape[0] / rows) if cells is not None else (0.5**times, 0.5**times)
    sampling = Sampling.LINEAR if cells is None else Sampling.PIXELS
    paint = Paint.from_picture(Picture(((across, 0.0, 0.0), (0.0, down, 0.0)), pixels, sampling))
    corners = np.array([(0.0, 0.0), (columns, 0.0), (columns, rows), (0.0, rows)])
    path = Path((line_cubics(corners, np.roll(corners, -1, axis=0)),), paint=paint)
    drawing = Drawing.from_source([path], (0.0, 0.0, columns, rows), name)
    return replace(drawing, notes=notes.in_order)
