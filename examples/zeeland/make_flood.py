"""A synthetic flood at Zierikzee: a surge of a day, dikes too low in places, polders that fill slowly."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scenery.files import hours, write_flood, write_ground
from scenery.grid import Array
from scenery.sills import thresholds

from . import ground
from .terrain import CELL, CREST, RAMP, SILL, Terrain, terrain

NOTE = "Synthetic: an invented surge over an invented terrain on the coastline of GSHHG; no model, no measurement."
HOURS = 24
START = "2026-01-31 16:00:00"
EVERY = 12  # parts of an hour, in which the level behind the dikes is computed
FILLS = 0.34  # share of the difference to the sea by which that rises in an hour
BLEND = 350.0  # metres from a breach in which the level goes over into that of the sea
DEEP = -3.0  # metres: what is below is sea at any time
GROUNDED = 0.9  # share of the crest's height from which a cell is on a dike or behind it


def sea_levels(hour: Array) -> Array:
    """Metres above the mean level of the sea: the tide, and a surge that comes and goes."""
    tide = 1.3 * np.cos(2 * np.pi * (hour - 1) / 12.42)
    return np.asarray(0.1 + tide + 2.7 * np.exp(-(((hour - 13) / 4.5) ** 2)))


def polder_levels() -> Array:
    """Metres of the water behind the dikes, hour by hour: it comes over the sills, and goes down to them."""
    level, found = -3.0, []
    for tick in range(EVERY * HOURS):
        if tick % EVERY == 0:
            found.append(level)
        outside = max(float(sea_levels(np.array(tick / EVERY))), SILL)
        if outside > SILL or level > SILL:
            level += FILLS / EVERY * (outside - level)
    return np.array(found)


def depths(land: Terrain, bed: Array) -> NDArray[np.float32]:
    """Metres of water in each hour: 0 where it is dry."""
    breach, shore = land.grid.coarser(land.breach), land.grid.coarser(land.shore)
    at_breach = breach < RAMP
    closed = np.where(at_breach & (shore > 0), np.maximum(bed, CREST), bed)
    sill = thresholds(closed, np.argwhere((shore < 0) & (bed < DEEP)))
    behind = sill > GROUNDED * CREST
    inside = thresholds(np.where(behind, bed, np.inf), np.argwhere(behind & (breach < BLEND) & (bed < SILL - 1)))
    near = np.exp(-np.maximum(breach, 0) / BLEND)
    wet, highest = [], -np.inf
    for sea, polder in zip(sea_levels(np.arange(HOURS)), polder_levels(), strict=True):
        highest = max(highest, polder)
        level = np.where(highest > inside, np.maximum(polder, inside), -np.inf)  # what has come over a sill stays
        if sea > SILL:
            level = np.where(np.isfinite(level) | (behind & at_breach), level_near(polder, sea, near, level), level)
        level = np.where(behind, level, np.where(sea > sill, sea, -np.inf))
        wet.append(np.maximum(level - bed, 0))
    return np.round(wet, 3).astype(np.float32)


def level_near(polder: float, sea: float, near: Array, level: Array) -> Array:
    """The level behind a dike, which by a breach goes over into that of the sea."""
    return np.asarray(np.maximum(level, polder + (sea - polder) * near))


def make_flood(folder: Path, cell: float = CELL) -> tuple[Path, Path]:
    """Write `flood.nc`, `ground.jpg` and `ground.tif`; return the first two."""
    land = terrain(cell)
    bed = land.grid.coarser(land.height)
    flood, picture = folder / "flood.nc", folder / "ground.jpg"
    facts = {"title": "Flood at Zierikzee, Zeeland (synthetic)", "comment": NOTE}
    level = sea_levels(np.arange(HOURS))
    data = {
        "depth": (depths(land, bed), ("time", "y", "x"), {"long_name": "water depth, synthetic"}),
        "bed_level": (bed, ("y", "x"), {"long_name": "bed level, synthetic", "standard_name": "altitude"}),
        "water_level": (level, ("time",), {"long_name": "level of the sea, synthetic"}),
    }
    write_flood(flood, land.grid, facts, hours(START, HOURS), data)
    write_ground(ground.ground(land), land.grid, ground.NOTE, picture)
    return flood, picture
