"""A synthetic flood at Santa Cruz: a storm surge of a day over the terrain of this folder, as NetCDF."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scenery.files import hours, write_flood, write_ground
from scenery.grid import Array
from scenery.sills import thresholds

from . import ground
from .terrain import GRID, terrain

NOTE = "Synthetic: an invented surge over an invented terrain on the coastline of GSHHG; no model, no measurement."
HOURS = 24
START = "2026-01-05 00:00:00"


def water_levels() -> Array:
    """Metres above the mean level of the sea, hour by hour: the tide, and a surge that comes and goes."""
    hour = np.arange(HOURS)
    tide = 0.7 * np.cos(2 * np.pi * (hour - 3) / 12.42)
    return np.asarray(0.1 + tide + 2.1 * np.exp(-(((hour - 14.5) / 3.8) ** 2)))


def depths(bed: Array) -> NDArray[np.float32]:
    """Metres of water in each hour: 0 where it is dry."""
    rows, columns = bed.shape
    sill = thresholds(bed, ((rows - 1, column) for column in range(columns)))  # the southern border is sea
    wet = [np.where(level > sill, level - bed, 0) for level in water_levels()]
    return np.round(wet, 3).astype(np.float32)


def make_flood(folder: Path) -> tuple[Path, Path]:
    """Write `flood.nc`, `ground.jpg` and `ground.tif`; return the first two."""
    land = terrain()
    bed = GRID.coarser(land.height)
    flood, picture = folder / "flood.nc", folder / "ground.jpg"
    facts = {"title": "Flood at Santa Cruz, California (synthetic)", "comment": NOTE}
    data = {
        "depth": (depths(bed), ("time", "y", "x"), {"long_name": "water depth, synthetic"}),
        "bed_level": (bed, ("y", "x"), {"long_name": "bed level, synthetic", "standard_name": "altitude"}),
        "water_level": (water_levels(), ("time",), {"long_name": "level of the sea, synthetic"}),
    }
    write_flood(flood, GRID, facts, hours(START, HOURS), data)
    write_ground(ground.ground(land), GRID, ground.NOTE, picture)
    return flood, picture
