"""A synthetic flood of the Clinch River and Coal Creek over real heights, computed by a simple model, as NetCDF."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scenery.files import hours, write_flood, write_ground
from scenery.grid import Array

from . import ground
from .terrain import CELL, Terrain, terrain
from .water import simulated

NOTE = (
    "Synthetic flood: invented discharges over real heights (SRTM, NASA and USGS, public domain) with invented "
    "channels; not a flood that was, nor one that is expected."
)
HOURS, WARM = 24, 3
START = "2026-03-14 00:00:00"
RIVER = (160.0, 2900.0, 11.0, 3.2)  # cubic metres per second before and at the height; hours to it, and of its rise
CREEKS = (0.08, 6.0, 7.0, 2.2)  # the same of each square kilometre
FALLS = 2.2  # how many times slower the water falls than it rises
ROUGH = (0.033, 0.07)  # Manning's numbers of channels, and of the land beside them
FADE = 20.0  # metres from the bank in which one goes over into the other


def discharge(hour: float, wave: tuple[float, float, float, float]) -> float:
    """What comes down: a wave over a steady flow."""
    base, most, at, rise = wave
    long = rise if hour < at else FALLS * rise
    return base + (most - base) * float(np.exp(-(((hour - at) / long) ** 2)))


def depths(land: Terrain) -> NDArray[np.float32]:
    """Metres of water in each hour: 0 where it is dry."""
    lateral = land.lateral
    river = np.zeros(lateral.shape)
    river[land.source] = 1.0

    def supply(hour: float) -> Array:
        return np.asarray(discharge(hour, RIVER) * river + discharge(hour, CREEKS) * lateral)

    share = np.clip(land.bank / FADE, 0.0, 1.0)
    roughness = ROUGH[0] + (ROUGH[1] - ROUGH[0]) * share
    start = np.where(land.bank < 0, 0.3, 0.0)
    found = simulated(land.height, start, roughness, land.exits, land.grid.cell, supply, (WARM, HOURS))
    return np.where(found >= 0.02, np.round(found, 3), 0).astype(np.float32)


def make_flood(folder: Path, cell: float = CELL) -> tuple[Path, Path]:
    """Write `flood.nc`, `ground.jpg` and `ground.tif`; return the first two."""
    land = terrain(cell)
    flood, picture = folder / "flood.nc", folder / "ground.jpg"
    facts = {"title": "Flood of the Clinch River below Norris Dam, Tennessee (synthetic)", "comment": NOTE}
    hour = np.arange(HOURS, dtype=np.float64)
    data = {
        "depth": (depths(land), ("time", "y", "x"), {"long_name": "water depth, synthetic"}),
        "bed_level": (
            land.height,
            ("y", "x"),
            {"long_name": "heights of SRTM, with channels that were carved", "standard_name": "altitude"},
        ),
    }
    write_flood(flood, land.grid, facts, hours(START, len(hour)), data)
    write_ground(ground.ground(land), land.grid, ground.NOTE, picture)
    return flood, picture
