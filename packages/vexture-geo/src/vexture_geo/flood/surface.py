"""Surface of the water at one time, with a level at each place, for sloping rivers and ponds at several heights."""

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.extent import DepthClasses, Frame, Step
from vexture_geo.flood.grids import coarser, mean_of, sample_grid
from vexture_geo.flood.relief import Relief, wet_samples

FINEST_UNIT: Final = 0.005
"""Metres. Smallest unit of levels on the page: finer ones would be invisible and would compress badly."""

BESIDE: Final = 1 << 15
"""Offset in a picture of levels for places beside water; 0 means that no water is near."""

BEYOND: Final = 3
"""Samples around the water that share its level, so that the surface runs into the ground and ends at the shore."""

SMOOTH: Final = 4
"""Passes that smooth levels whose ground and depth come from different sources, which makes them rough."""


@dataclass(frozen=True, slots=True, eq=False)
class WaterSurface:
    """Levels of the water in metres above the still water; NaN where no water is near.

    The northernmost row comes first, on the grid of the heights of the ground. `wet` marks water, because the levels
    continue a little beside it.
    """

    levels: NDArray[np.float64]
    wet: NDArray[np.bool_]

    def encode_png(self) -> tuple[bytes, dict[str, float]]:
        """Encode the levels as a 16-bit gray PNG; return it and the facts to read it.

        1 is `lowest`, and each further step adds `unit`. Beside the water the same numbers are raised by `BESIDE`; 0
        means that no water is near.
        """
        from PIL import Image

        known = self.levels[np.isfinite(self.levels)]
        lowest, range_of = (float(known.min()), float(np.ptp(known))) if known.size else (0.0, 0.0)
        unit = max(FINEST_UNIT, range_of / (BESIDE - 2))
        numbers = np.rint((self.levels - lowest) / unit) + np.where(self.wet, 1.0, 1.0 + BESIDE)
        numbers = np.nan_to_num(numbers, nan=0.0)
        out = BytesIO()
        Image.fromarray(numbers.astype(np.uint16)).save(out, format="PNG", optimize=True)
        return out.getvalue(), {"lowest": lowest, "unit": unit}


def surface_of(step: Step, frame: Frame, relief: Relief, bed: NDArray[np.float32] | None, hmin: float) -> WaterSurface:
    """Make the surface of the water of a step.

    It is the sum of bed and depth where the source has both, or else of heights and depth. Where depths are not known,
    the water is as high as the ground along its shore, and interpolated in between.
    """
    rows, columns = relief.heights.shape
    size = columns, rows
    wet = wet_samples(step, frame, size)
    known = step.depth if step.classes is None else _about(step.classes)
    depth = None if known is None else np.where(known >= hmin, known, np.nan)
    if depth is not None and bed is not None and step.classes is None and not relief.invented:
        levels = sample_grid(coarser(bed + depth, size), size) - relief.still
    elif depth is not None and not relief.invented:
        levels = relief.heights + sample_grid(coarser(depth, size), size)
        levels = _smooth(np.where(wet, levels, np.nan), SMOOTH)
    else:
        levels = _from_shores(relief.heights, wet)
    levels = np.where(wet | np.isfinite(levels), _fill_wet(levels, wet), np.nan)
    return WaterSurface(_widen(levels, BEYOND), wet)


def _about(classes: DepthClasses) -> NDArray[np.float32]:
    """Depths in the middle of classes, to draw a surface without showing numbers; NaN where it is dry."""
    amid = [low if np.isinf(high) else (low + high) / 2.0 for low, high in classes.ranges]
    return np.array([np.nan, *amid], np.float32)[classes.ranks]


def highest_of(surfaces: Sequence[WaterSurface]) -> NDArray[np.float64] | None:
    """Highest level at each sample, NaN where it is always dry; None if there is no water at all."""
    if not any(np.isfinite(surface.levels).any() for surface in surfaces):
        return None
    highest = surfaces[0].levels
    for surface in surfaces[1:]:
        highest = np.fmax(highest, surface.levels)
    return highest


def _around(levels: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mean of each sample and its eight neighbours, without NaN."""
    rows, columns = levels.shape
    padded = np.pad(levels, 1, constant_values=np.nan)
    shifted = [padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    return mean_of(np.stack(shifted), 0)


def _widen(levels: NDArray[np.float64], samples: int) -> NDArray[np.float64]:
    for _ in range(samples):
        levels = np.where(np.isfinite(levels), levels, _around(levels))
    return levels


def _smooth(levels: NDArray[np.float64], passes: int) -> NDArray[np.float64]:
    for _ in range(passes):
        levels = np.where(np.isfinite(levels), _around(levels), np.nan)
    return levels


def _fill_wet(levels: NDArray[np.float64], wet: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Fill wet samples without a level from levels around them."""
    return _fill_gaps(levels) if (wet & ~np.isfinite(levels)).any() else levels


def _fill_gaps(levels: NDArray[np.float64]) -> NDArray[np.float64]:
    """Fill gaps in levels with means of levels around them, over larger and larger blocks (a push-pull pyramid)."""
    rows, columns = levels.shape
    if np.isfinite(levels).all() or rows * columns == 1:
        return levels
    even = np.pad(levels, [(0, rows % 2), (0, columns % 2)], constant_values=np.nan)
    blocks = even.reshape(even.shape[0] // 2, 2, even.shape[1] // 2, 2)
    coarse = _fill_gaps(mean_of(blocks, (1, 3)))
    return np.where(
        np.isfinite(levels), levels, _around(np.kron(coarse, np.ones((2, 2))).astype(np.float64))[:rows, :columns]
    )


def _from_shores(heights: NDArray[np.float64], wet: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Heights of the ground along the border of the water, halfway to its dry neighbours; NaN elsewhere."""
    total, count = np.zeros(heights.shape), np.zeros(heights.shape)
    for axis in (0, 1):
        ground, water = np.moveaxis(heights, axis, 0), np.moveaxis(wet, axis, 0)
        sums, counts = np.moveaxis(total, axis, 0), np.moveaxis(count, axis, 0)
        crossed = water[:-1] != water[1:]
        middle = np.where(crossed, (ground[:-1] + ground[1:]) / 2.0, 0.0)
        for part in (slice(None, -1), slice(1, None)):
            sums[part] += middle
            counts[part] += crossed
    with np.errstate(invalid="ignore", divide="ignore"):
        found = np.where(wet & (count > 0.0), total / count, np.nan)
    return found if np.isfinite(found).any() else np.where(wet, 0.0, np.nan)
