"""Draw a picture of the ground for a user who has none: sand at the shore, land above, lit from the north-west."""

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.extent import Extent
from vexture_geo.flood.grids import coverage_over, noise, shore_distance, size_for
from vexture_geo.flood.open_water import cells_of
from vexture_geo.flood.relief import Relief, beyond_of, first_wet, widest

if TYPE_CHECKING:
    from PIL import Image

DRAWN: Final = 1024
"""Pixels on the longer side."""

FAR: Final = 192
"""Samples on the longer side of the grid of distances to the shore, which vary slowly."""

WET_SAND, SAND, GRASS, WOOD, ROCK = (
    np.array(colour, float)
    for colour in ((178, 156, 120), (226, 209, 170), (163, 172, 116), (110, 134, 86), (160, 150, 134))
)
SEA_SHALLOW, SEA_DEEP = np.array([141, 141, 116], float), np.array([48, 66, 76], float)

BEACH: Final = 0.008
"""Width of the sand, as a fraction of the frame's longer side."""

FLOOR: Final = 9.0
"""Beach widths over which the sea floor changes from its shallow colour to its deep one."""

LIGHT: Final = np.array([-0.5, 0.5, 0.7]) / np.sqrt(0.99)
"""Direction of the sun: east, north, up."""

STEEPEST: Final = 3.0
"""Largest exaggeration of slopes. Flat land is lit as if it rose to a twentieth of the longer side."""


def drawn_ground(extent: Extent, relief: Relief) -> "Image.Image":
    """Draw the frame, `DRAWN` pixels on the longer side."""
    from PIL import Image

    frame = extent.frame
    size, longest = size_for(frame, DRAWN), max(frame.metres)
    rough = noise(size, 8)
    height = _enlarge(relief.heights, size)
    top = max(float(relief.heights.max()), 1e-6)
    first, most = first_wet(extent), widest(extent)
    if first is None or most is None:
        distance, wet = np.full(size[::-1], 0.05 * longest), np.zeros(size[::-1])
    else:
        beyond = beyond_of(extent, relief)  # drawn like its bottom, without a beach
        wet = np.maximum(coverage_over(first.drawing, frame.box, size), cells_of(beyond, size))
        coarse = size_for(frame, FAR)
        cell = (frame.metres[0] / coarse[0], frame.metres[1] / coarse[1])
        shore = shore_distance(
            (coverage_over(first.drawing, frame.box, coarse) >= 0.5) | cells_of(beyond, coarse), cell
        )
        distance = _enlarge(shore, size)  # metres, positive on land
    away = np.maximum(distance, 0.0) / (BEACH * longest)
    land = _blend(WET_SAND, SAND, away, 0.02, 0.12)
    land = _blend(land, GRASS, away + 0.5 * rough, 0.8, 1.6)
    land = _blend(land, WOOD, height / top + 0.3 * rough, 0.3, 0.6)
    land = _blend(land, ROCK, height / top + 0.15 * rough, 0.9, 1.1)
    floor = _blend(SEA_SHALLOW, SEA_DEEP, -distance / (BEACH * longest) + 0.5 * rough, 0.0, FLOOR)
    shown = land + (floor - land) * wet[..., None]
    lit = _light(height, longest / max(size), 0.05 * longest / top)
    bright = 1.0 + (lit - 1.0) * (1.0 - 0.8 * wet) + 0.05 * rough
    return Image.fromarray(np.clip(np.rint(shown * bright[..., None]), 0, 255).astype(np.uint8))


def _enlarge(grid: NDArray[np.float64], size: tuple[int, int]) -> NDArray[np.float64]:
    from PIL import Image

    return np.asarray(Image.fromarray(grid.astype(np.float32)).resize(size, Image.Resampling.BICUBIC), np.float64)


def _blend(
    below: NDArray[np.float64], above: NDArray[np.float64], value: NDArray[np.float64], start: float, end: float
) -> NDArray[np.float64]:
    """Blend smoothly from one colour to another as a value goes from start to end."""
    share = np.clip((value - start) / (end - start), 0.0, 1.0)
    share = share * share * (3.0 - 2.0 * share)
    return np.asarray(below + (above - below) * share[..., None])


def _light(height: NDArray[np.float64], pixel: float, exaggeration: float) -> NDArray[np.float64]:
    """Brightness of each pixel by its slope, 1 on level ground."""
    south, east = np.gradient(height * min(exaggeration, STEEPEST), pixel)
    length = np.sqrt(east**2 + south**2 + 1.0)
    cosine = (-east * LIGHT[0] + south * LIGHT[1] + LIGHT[2]) / length
    return np.asarray(np.clip(cosine / LIGHT[2], 0.6, 1.25))
