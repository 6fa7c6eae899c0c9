"""Where waves meet a shore of open water: not in rivers, harbours and flooded streets, nor in acute corners."""

import base64
from io import BytesIO
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.flood.grids import coverage_over, shore_distance, size_for
from vexture.geo.extent import Frame

__all__ = ["open_water", "openness_at", "openness_png"]

SAMPLES: Final = 256
"""Samples on the longer side."""

RADIUS: Final = 250.0
"""Metres. Water is open as far as a disc of this radius fits into it: twice that is the fetch of the smallest surf."""

LEAST_CELLS: Final = 2.0
"""And in cells, where these are larger."""

FADE: Final = (0.004, 0.02)
"""Distance from open water at which waves begin to fade, and at which they have ended; shares of the longer side."""


def open_water(drawing: Drawing, frame: Frame) -> NDArray[np.float64]:
    """Openness of the water at rest, 1 in open water and 0 far from it, on a grid over the frame.

    The northernmost row comes first. Water is open where a disc fits into it (a morphological opening); it goes on
    beyond the frame as at its border.
    """
    size = size_for(frame, SAMPLES)
    longest = max(frame.metres)
    cell = (frame.metres[0] / size[0], frame.metres[1] / size[1])
    wet = coverage_over(drawing, frame.box, size) >= 0.5
    radius = max(RADIUS, LEAST_CELLS * max(cell))
    margin = int(np.ceil(2.0 * radius / min(cell)))
    around = np.pad(wet, margin, mode="edge")
    core = shore_distance(around, cell) <= -radius
    if not core.any():
        return np.zeros(wet.shape)
    away = (shore_distance(core, cell) - radius)[margin:-margin, margin:-margin] / longest
    share = np.clip((FADE[1] - away) / (FADE[1] - FADE[0]), 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share))


def openness_at(openness: NDArray[np.float64], frame: Frame, places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Openness at places of the unit square, (..., 2); beyond the frame as at its border."""
    x0, y0, x1, y1 = frame.box
    rows, columns = openness.shape
    column = np.clip((places[..., 0] - x0) / (x1 - x0) * columns, 0, columns - 1).astype(int)
    row = np.clip((y1 - places[..., 1]) / (y1 - y0) * rows, 0, rows - 1).astype(int)
    return np.asarray(openness[row, column])


def openness_png(openness: NDArray[np.float64]) -> str:
    """Data URL of an 8-bit gray PNG."""
    from PIL import Image

    out = BytesIO()
    Image.fromarray(np.rint(255.0 * openness).astype(np.uint8)).save(out, format="PNG", optimize=True)
    return f"data:image/png;base64,{base64.b64encode(out.getvalue()).decode()}"
