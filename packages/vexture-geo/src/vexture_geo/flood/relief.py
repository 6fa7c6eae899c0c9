"""Heights of the ground over the frame: from the user's file, from the source's bed, or invented.

Heights are metres above the *still water*: the level of the first step's water, which is the median height of the
ground along its shore. The shore is therefore at 0 whatever the datum of the heights, both for a beach and for the bank
of a river ten metres above the sea. Where the water follows sloping ground, wet places can be above 0, and the page
drapes the water over the ground. The page also decides how much it exaggerates heights.
"""

import base64
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import about
from vexture.base.errors import SourceError, reason_of
from vexture_geo.base.extent import Extent, Frame, Step
from vexture_geo.base.gdal import open_raster
from vexture_geo.base.lengths import metres_in
from vexture_geo.flood.grids import coverage_over, fill_unknown, noise, pixels_to, sample_grid, shore_distance, size_for

SAMPLES: Final = 257
"""Samples on the longer side."""

FINEST_UNIT: Final = 1e-3
"""Metres. The smallest unit of heights on the page; high ground needs a larger one."""

HIGHEST: Final = 32_000
"""Number of the highest place in units, within signed 16 bits."""

LAND_RISE, LAND_REACH = 0.03, 0.2
SEA_FALL, SEA_REACH = 0.02, 0.25
"""Invented ground: its rise or fall, and the distance from the shore this takes; fractions of the longer side."""

BEACH: Final = 0.03
"""Invented ground: distance from the shore within which it is nearly level, as a fraction of the longer side."""

PLAIN_RISE: Final = 0.001
"""Rise of invented ground that later steps flood, as a fraction of the longer side."""

ENDS: Final = 2
"""Samples beyond the source's end within which its water ends."""

ROUGHNESS: Final = 0.5
"""Invented ground: amplitude of the noise, as a fraction of its height."""


@dataclass(frozen=True, slots=True, eq=False)
class Relief:
    """Heights of the ground.

    `heights` are metres above the still water, the northernmost row first, on a regular grid from corner to corner of
    the frame. `known` is the fraction of them that is measured or under water, unless all are invented. `still` is the
    level of the still water in metres above the zero of the heights' source.
    """

    heights: NDArray[np.float64]
    invented: bool
    known: float = 1.0
    still: float = 0.0

    def as_json(self) -> dict[str, Any]:
        """Encode heights for the page: 16-bit numbers in a data URL, with their unit in metres."""
        unit = max(FINEST_UNIT, float(np.abs(self.heights).max()) / HIGHEST)
        numbers = np.rint(self.heights / unit).astype("<i2")
        address = f"data:application/octet-stream;base64,{base64.b64encode(numbers.tobytes()).decode()}"
        rows, columns = numbers.shape
        return {
            "columns": columns, "rows": rows, "unit": unit, "heights": address, "invented": self.invented,
            "still": self.still,
        }  # fmt: skip


def first_wet(extent: Extent) -> Step | None:
    """First step with water."""
    return next((step for step in extent.steps if step.drawing.paths), None)


def widest(extent: Extent) -> Step | None:
    """Step with the largest area under water."""
    wet = [step for step in extent.steps if step.drawing.paths]
    return max(wet, key=lambda step: coverage_over(step.drawing, extent.frame.box, (32, 32)).sum()) if wet else None


def relief_of(extent: Extent, path: Path | None = None, crs: str | None = None) -> Relief:
    """Heights from a raster file, or else from the bed, or else invented from the distance to the shore.

    `crs` is the reference system of the file, if it names none.
    """
    size = size_for(extent.frame, SAMPLES)
    first = first_wet(extent)
    made_up = _invent_heights(extent, size)
    if path is not None:
        measured = _heights_of(path, extent.frame, size, crs)
    elif extent.bed is not None and np.isfinite(extent.bed).any():
        measured = sample_grid(extent.bed, size)
    else:
        return Relief(made_up, True)
    known = np.isfinite(measured)
    heights = fill_unknown(measured)
    if first is None:
        still = float(heights.min())
        return Relief(heights - still, False, float(known.mean()), still)
    wet = wet_samples(first, extent.frame, size)
    still = _shore_level(heights, wet, known)
    heights -= still
    heights[wet & ~known] = np.minimum(heights, made_up)[wet & ~known]
    if path is None:
        for step in (first, widest(extent)):
            heights = _dig_rivers(heights, still, extent, step)
    return Relief(heights, False, float((known | wet).mean()), still)


def beyond_of(extent: Extent, relief: Relief) -> NDArray[np.bool_] | None:
    """Samples beyond the source's bed where the ground continues below the still water; None if there are none.

    A model of the sea ends within it, with neither a shore nor land behind.
    """
    if extent.bed is None:
        return None
    rows, columns = relief.heights.shape
    low = relief.heights < 0.0
    beyond = ~np.isfinite(sample_grid(extent.bed, (columns, rows))) & low
    for _ in range(ENDS):
        padded = np.pad(beyond, 1)
        beyond |= low & (padded[:-2, 1:-1] | padded[2:, 1:-1] | padded[1:-1, :-2] | padded[1:-1, 2:])
    return beyond if beyond.any() else None


def wet_samples(step: Step, frame: Frame, size: tuple[int, int]) -> NDArray[np.bool_]:
    """Samples under water; each stands for the cell around it."""
    x0, y0, x1, y1 = frame.box
    half_x, half_y = (x1 - x0) / (size[0] - 1) / 2, (y1 - y0) / (size[1] - 1) / 2
    return coverage_over(step.drawing, (x0 - half_x, y0 - half_y, x1 + half_x, y1 + half_y), size) >= 0.5


def _dig_rivers(heights: NDArray[np.float64], still: float, extent: Extent, step: Step | None) -> NDArray[np.float64]:
    """Lower heights at wet cells to the beds of narrow rivers, which their banks would hide."""
    if step is None or step.depth is None or extent.bed is None:
        return heights
    size = (heights.shape[1], heights.shape[0])
    bottom = sample_grid(np.where(step.depth > 0.0, extent.bed, np.nan), size) - still
    return np.where(wet_samples(step, extent.frame, size), np.fmin(heights, bottom), heights)


def _shore_level(heights: NDArray[np.float64], wet: NDArray[np.bool_], known: NDArray[np.bool_]) -> float:
    """Median height halfway between wet samples and dry neighbours, or else the height of the highest wet sample."""
    middles = []
    for grid, water, sure in ((heights, wet, known), (heights.T, wet.T, known.T)):
        crossed = (water[:-1] != water[1:]) & sure[:-1] & sure[1:]
        middles.append(((grid[:-1] + grid[1:]) / 2)[crossed])
    along = np.concatenate(middles)
    if len(along):
        return float(np.median(along))
    return float(heights[wet].max()) if wet.any() else float(heights.min())


def _invent_heights(extent: Extent, size: tuple[int, int]) -> NDArray[np.float64]:
    """Invent land that rises and a sea floor that falls with distance from the shore; known depths are kept."""
    frame = extent.frame
    longest = max(frame.metres)
    cell = (frame.metres[0] / (size[0] - 1), frame.metres[1] / (size[1] - 1))
    first, most = first_wet(extent), widest(extent)
    rough = noise(size)
    if first is None or most is None:
        return LAND_RISE * longest * (0.2 + 0.1 * rough)
    wet = wet_samples(first, frame, size)
    to_first = shore_distance(wet, cell)
    to_most = shore_distance(wet | wet_samples(most, frame, size), cell)
    rise, fall = (
        _beach_profile(np.maximum(far, 0.0) / longest, reach)
        for far, reach in ((to_most, LAND_REACH), (-to_first, SEA_REACH))
    )
    plain = np.clip(to_first / (to_first + np.abs(to_most) + 1e-9 * longest), 0.0, 1.0)
    land = LAND_RISE * longest * rise * (1.0 + ROUGHNESS * rough) + PLAIN_RISE * longest * plain
    sea = -SEA_FALL * longest * fall * (1.0 + ROUGHNESS * rough)
    if first.depth is not None and np.isfinite(first.depth).any():
        depth = sample_grid(first.depth, size)
        sea = np.where(np.isfinite(depth), -depth, sea)
    return np.where(wet, sea, land)


def _beach_profile(distance: NDArray[np.float64], reach: float) -> NDArray[np.float64]:
    """Profile from 0 to 1 with the distance, level at the shore like a beach."""
    return np.asarray((1.0 - np.exp(-distance / reach)) * distance / (distance + BEACH))


def _heights_of(path: Path, frame: Frame, size: tuple[int, int], crs: str | None) -> NDArray[np.float64]:
    """Heights of a raster at the samples, NaN beyond it."""
    import rasterio
    from rasterio.enums import Resampling
    from rasterio.errors import CRSError, RasterioError, RasterioIOError
    from rasterio.warp import reproject

    west, south, east, north = frame.bounds
    half_x, half_y = (east - west) / (size[0] - 1) / 2, (north - south) / (size[1] - 1) / 2
    target = pixels_to((west - half_x, south - half_y, east + half_x, north + half_y), size)
    heights = np.full(size[::-1], np.nan, np.float32)
    try:
        with (
            warnings.catch_warnings(action="ignore"),
            about(f"`relief` {path}"),
            open_raster(path, others=True) as raster,
        ):
            if not raster.count:
                choices = ", ".join(one.rpartition(":")[2] for one in raster.subdatasets[:8])
                raise SourceError(f"holds several grids ({choices}); give one that holds one")
            system = raster.crs or crs
            if system is None:
                raise SourceError("says no reference system; write it into the file as GeoTIFF")
            unit = (raster.units[0] or "").strip()
            metres = metres_in(unit)
            if metres is None:
                raise SourceError(
                    f"its values are in {unit!r}, no unit of length that is known; write heights in metres"
                )
            scale, offset = metres * raster.scales[0], metres * raster.offsets[0]
            reproject(
                rasterio.band(raster, 1),
                heights,
                src_crs=system,
                dst_transform=target,
                dst_crs=frame.crs,
                dst_nodata=np.nan,
                init_dest_nodata=True,
                resampling=Resampling.bilinear,
            )
    except RasterioIOError:
        reason = "is no raster that can be read" if path.is_file() else "there is no such file"
        raise SourceError(f"`relief` {path}: {reason}; give heights in metres as one GeoTIFF") from None
    except (CRSError, RasterioError) as error:
        raise SourceError(f"`relief` {path}: {reason_of(error, 200)}; give another file") from None
    if not np.isfinite(heights).any():
        raise SourceError(f"`relief` {path}: has no height within the frame; give one that covers it")
    found: NDArray[np.float64] = heights.astype(np.float64) * scale + offset
    return found
