"""Shores of open water, where waves arrive: not rivers, harbours, flooded streets or acute corners."""

import base64
from io import BytesIO
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Frame
from vexture_geo.flood.grids import coverage_over, distance_to, size_for

SAMPLES: Final = 256
"""Most samples on the longer side."""

RADIUS: Final = 250.0
"""Metres. Water is open where a disc of this radius fits into it: twice that is the fetch of the smallest surf."""

WIDE: Final = 1000.0
"""Metres. Only water into which a disc of this radius fits somewhere is open: no pond and no wide river."""

LEAST_CELLS: Final = 2.0
"""Least size of these radii in cells, for coarse grids."""

MOST_CELLS: Final = 32.0
"""Largest size of these radii in cells, which limits the resolution."""

FADE: Final = (0.004, 0.02)
"""Distances from open water at which waves begin to fade and have ended, as fractions of the longer side."""


CALM: Final = (0.016, 0.03)
"""Distances from the end of the source in the sea at which waves have ended and begin to fade, likewise."""


def open_water(
    drawing: Drawing, frame: Frame, most: Drawing | None = None, beyond: NDArray[np.bool_] | None = None
) -> NDArray[np.float64]:
    """Openness of the water at rest, 1 in open water and 0 far from it, on a grid over the frame.

    The northernmost row comes first. Water is open where a disc fits into it (a morphological opening), if a larger one
    fits somewhere; beyond the frame it continues as at its border. With `most`, the water at its largest extent, waves
    do not cross land that stays dry, so that water behind a dike is calm. The sea continues `beyond` the source
    (`vexture_geo.flood.relief.beyond_of`).
    """
    longest = max(frame.metres)
    size = size_for(frame, min(SAMPLES, int(np.ceil(longest * MOST_CELLS / RADIUS))))
    cell = (frame.metres[0] / size[0], frame.metres[1] / size[1])
    wet = (coverage_over(drawing, frame.box, size) >= 0.5) | cells_of(beyond, size)
    radius, margin, core = _middles(_within(wet, cell), cell, RADIUS)
    core = _grow_seeds(np.pad(_wide(wet, cell), margin, mode="edge") & core, core)
    if not core.any():
        return np.zeros(wet.shape)
    away = (distance_to(core, cell) - radius)[margin:-margin, margin:-margin] / longest
    if most is not None:
        away = np.where(_before_land(away, wet | (coverage_over(most, frame.box, size) >= 0.5)), away, np.inf)
    share = np.clip((FADE[1] - away) / (FADE[1] - FADE[0]), 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share))


def _middles(wet: NDArray[np.bool_], cell: tuple[float, float], radius: float) -> tuple[float, int, NDArray[np.bool_]]:
    """Find middles of discs in the water; return their radius, the margin around the grid, and the middles."""
    radius = max(radius, LEAST_CELLS * max(cell))
    margin = int(np.ceil(2.0 * radius / min(cell)))
    return radius, margin, distance_to(~np.pad(wet, margin, mode="edge"), cell) >= radius


def _within(wet: NDArray[np.bool_], cell: tuple[float, float]) -> NDArray[np.bool_]:
    """Remove water that is narrow within the frame: a street along its border does not continue as a sea.

    Half of the wide water may lie beyond the border.
    """
    radius = max(RADIUS / 2.0, LEAST_CELLS / 2.0 * max(cell))
    middles = distance_to(~np.pad(wet, 1), cell) >= radius
    return np.asarray(wet & (distance_to(middles, cell) <= radius + max(cell))[1:-1, 1:-1])


def _wide(wet: NDArray[np.bool_], cell: tuple[float, float]) -> NDArray[np.bool_]:
    """Mark water into which the widest disc fits."""
    every = max(1, int(WIDE / (MOST_CELLS * max(cell))))
    coarse = (every * cell[0], every * cell[1])
    radius, margin, middles = _middles(wet[::every, ::every], coarse, WIDE)
    inside = (distance_to(middles, coarse) <= radius)[margin:-margin, margin:-margin]
    return np.asarray(inside.repeat(every, axis=0).repeat(every, axis=1)[: wet.shape[0], : wet.shape[1]])


def calm_waves(openness: NDArray[np.float64], frame: Frame, beyond: NDArray[np.bool_] | None) -> NDArray[np.float64]:
    """Fade waves where the source ends in the sea, because its end is no shore."""
    if beyond is None:
        return openness
    rows, columns = openness.shape
    cell = (frame.metres[0] / columns, frame.metres[1] / rows)
    away = distance_to(cells_of(beyond, (columns, rows)), cell) / max(frame.metres)
    share = np.clip((away - CALM[0]) / (CALM[1] - CALM[0]), 0.0, 1.0)
    return np.asarray(openness * share * share * (3.0 - 2.0 * share))


def cells_of(samples: NDArray[np.bool_] | None, size: tuple[int, int]) -> NDArray[np.bool_]:
    """Convert samples from corner to corner to cells, each with the value of the sample nearest to its middle."""
    if samples is None:
        return np.zeros(size[::-1], bool)
    at = (
        np.rint((np.arange(n) + 0.5) / n * (m - 1)).astype(int) for n, m in zip(size[::-1], samples.shape, strict=True)
    )
    return np.asarray(samples[np.ix_(*at)])


def _before_land(away: NDArray[np.float64], wet: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Find water that waves reach from open water, and the first cell of the land behind, between which the shore runs.

    On their way around land, waves get no farther than the distance at which they fade without it.
    """
    reached = (away <= 0.0) & wet
    for _ in range(int(np.ceil(FADE[1] * max(wet.shape)))):
        reached = _around(reached) & wet
    return _around(reached)


def _around(cells: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark cells and their eight neighbours."""
    rows, columns = cells.shape
    padded = np.pad(cells, 1)
    return np.asarray(np.any([padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)], axis=0))


def _grow_seeds(seeds: NDArray[np.bool_], inside: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark cells that seeds reach without leaving `inside` (morphological reconstruction, Vincent 1993)."""
    while True:
        grown = seeds.copy()
        for way in (grown, grown[::-1], grown.T, grown.T[::-1]):
            way[1:] |= way[:-1]
            grown &= inside
        if (grown == seeds).all():
            return seeds
        seeds = grown


def openness_at(openness: NDArray[np.float64], frame: Frame, places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Openness at places of the unit square, (..., 2); beyond the frame it is that at its border."""
    x0, y0, x1, y1 = frame.box
    rows, columns = openness.shape
    column = np.clip((places[..., 0] - x0) / (x1 - x0) * columns, 0, columns - 1).astype(int)
    row = np.clip((y1 - places[..., 1]) / (y1 - y0) * rows, 0, rows - 1).astype(int)
    return np.asarray(openness[row, column])


def openness_png(openness: NDArray[np.float64]) -> str:
    """Encode openness as the data URL of an 8-bit gray PNG."""
    from PIL import Image

    out = BytesIO()
    Image.fromarray(np.rint(255.0 * openness).astype(np.uint8)).save(out, format="PNG", optimize=True)
    return f"data:image/png;base64,{base64.b64encode(out.getvalue()).decode()}"
