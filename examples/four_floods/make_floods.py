"""Four synthetic floods: an open coast, a river valley, a polder with ponds, the streets of a town."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

import netCDF4
import numpy as np
from numpy.typing import NDArray

Grid = NDArray[np.float64]

NOTE = "Synthetic: invented ground and an invented flood, in no real place."
START = datetime(2026, 1, 10, 6)
SOUTH_WEST = 150_000.0, 430_000.0
SYSTEM = "EPSG:28992"
ROUGHNESS = 0.035
"""Manning's, of gravel and grass: the speed is that of a uniform flow."""


@dataclass(frozen=True)
class Scene:
    """Ground and levels of water, in metres, of a grid of square cells; the southernmost row first.

    `fall` is how steep the water's surface is where it flows, metres in a metre.
    """

    name: str
    title: str
    cell: float
    bed: Grid
    levels: list[Grid]
    fall: float = 0.0


def grid(width: float, height: float, cell: float) -> tuple[Grid, Grid]:
    """Middles of cells, metres east and north of the south-west."""
    columns, rows = round(width / cell), round(height / cell)
    x, y = np.meshgrid((np.arange(columns) + 0.5) * cell, (np.arange(rows) + 0.5) * cell)
    return x, y


def step(value: Grid, start: float, end: float) -> Grid:
    """From 0 to 1, smoothly, while a value goes from start to end."""
    share = np.clip((value - start) / (end - start), 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share))


def surge(hours: float, highest: float, at: float, long: float) -> float:
    """Rise of the water, which is highest at a time."""
    return float(highest * np.exp(-(((hours - at) / long) ** 2)))


def coast() -> Scene:
    """The sea in the south, a beach, dunes with a gap, low land behind them."""
    x, y = grid(4000.0, 3000.0, 12.5)
    shore = 1000.0 + 120.0 * np.sin(x / 520.0) + 40.0 * np.sin(x / 170.0 + 1.0)
    inland = y - shore
    bed = np.where(inland < 0.0, inland / 45.0, inland / 28.0)
    bed = np.where(inland > 60.0, 2.2 + (inland - 60.0) / 900.0, bed)
    gap = 1.0 - 0.9 * np.exp(-(((x - 2500.0) / 160.0) ** 2))
    bed = bed + 5.5 * gap * np.exp(-(((inland - 150.0) / 60.0) ** 2)) * (1.0 + 0.25 * np.sin(x / 61.0))
    bed = bed - 1.6 * np.exp(-(((inland - 620.0) / 230.0) ** 2)) * (inland > 60.0)
    bed = bed + 18.0 * step(inland, 1100.0, 2000.0)
    levels = [np.full(x.shape, surge(hour, 2.9, 6.0, 2.6)) for hour in range(13)]
    return Scene("coast", "Surge at an open coast", 12.5, bed, levels)


def river() -> Scene:
    """A meander of six kilometres in a valley that falls from the west to the east."""
    x, y = grid(6000.0, 3000.0, 12.5)
    along = np.linspace(-200.0, 6200.0, 1200)
    middle = 1500.0 + 480.0 * np.sin(along / 620.0) + 130.0 * np.sin(along / 233.0 + 0.7)
    away = np.full(x.shape, np.inf)
    place = np.zeros(x.shape)
    for east, north in zip(along, middle, strict=True):
        far = np.hypot(x - east, y - north)
        place = np.where(far < away, east, place)
        away = np.minimum(away, far)
    valley = 14.0 - 0.0009 * x
    bed = valley + 0.0025 * away + 30.0 * step(np.abs(y - 1500.0), 820.0, 1500.0)
    bed = bed + 0.9 * np.exp(-(((away - 60.0) / 22.0) ** 2))  # natural levees
    bed = bed - 4.2 * (1.0 - step(away, 18.0, 45.0))
    levels = []
    for hour in range(13):
        wave = surge(hour - 0.0004 * 6000.0, 2.6, 4.5, 2.4)
        levels.append(valley - 1.7 + wave)
    return Scene("river", "Flood in a river valley", 12.5, bed, levels, fall=0.0009)


def polder() -> Scene:
    """Ponds and ditches at several levels behind a dike, which breaks."""
    x, y = grid(3000.0, 2000.0, 8.0)
    bed = np.full(x.shape, -2.1) + 0.15 * np.sin(x / 310.0) * np.sin(y / 270.0)
    bed = bed + 0.5 * step(x, 1500.0, 2900.0)
    ditches = np.minimum(np.abs((x + 60.0) % 240.0 - 120.0), np.abs((y + 40.0) % 330.0 - 165.0))
    bed = bed - 0.9 * (1.0 - step(ditches, 3.0, 9.0))
    south = 330.0 + 60.0 * np.sin(x / 700.0)
    lake = np.hypot((x - 900.0) / 260.0, (y - 1250.0) / 170.0)
    high = np.hypot((x - 2250.0) / 190.0, (y - 1480.0) / 120.0)
    for ring, crest in ((lake, -0.9), (high, 1.0)):
        bed = np.maximum(bed, crest - 14.0 * np.abs(ring - 1.08))
        bed = np.where(ring < 1.0, crest - 2.4 + 1.2 * ring, bed)
    dike = np.abs(y - south)
    breach = np.exp(-(((x - 1500.0) / 45.0) ** 2))
    bed = np.maximum(bed, 3.2 - 5.0 * breach - 0.14 * dike)
    bed = np.where(y < south - 30.0, np.minimum(bed, -3.5 + 0.012 * np.abs(y - 120.0)), bed)
    outside, levels = y < south, []
    for hour in range(13):
        inside = -2.75 + 2.3 * float(step(np.array([hour]), 2.0, 9.0)[0])
        level = np.where(outside, 0.9, inside)
        level = np.where(lake < 1.05, np.maximum(-1.3, inside), level)
        level = np.where(high < 1.05, 0.55, level)
        levels.append(np.where((dike < 25.0) & (breach < 0.3), np.minimum(level, inside), level))
    return Scene("polder", "A dike breaks beside a polder", 8.0, bed, levels)


def streets() -> Scene:
    """Blocks of buildings on a slope, with a square; the water comes down the streets."""
    x, y = grid(800.0, 600.0, 2.0)
    ground = 6.0 - 0.004 * x - 0.002 * y + 0.05 * np.sin(x / 47.0) * np.sin(y / 39.0)
    turned, across = x + 0.12 * y, y - 0.12 * x
    block = (turned % 92.0 > 13.0) & ((across + 300.0) % 68.0 > 11.0)
    square = (np.abs(x - 420.0) < 55.0) & (np.abs(y - 300.0) < 42.0)
    yard = (np.abs(turned % 92.0 - 52.0) < 17.0) & (np.abs((across + 300.0) % 68.0 - 39.0) < 9.0)
    house = 6.5 + 3.0 * np.sin(np.floor(turned / 92.0) * 2.1 + np.floor(across / 68.0) * 3.7)
    bed = ground + np.where(block & ~square & ~yard, house, 0.0)
    canal = np.abs(across - 70.0)
    bed = np.where(canal < 16.0, ground - 2.2, bed)
    levels = []
    for hour in range(13):
        levels.append(6.0 - 0.004 * x - 0.002 * y - 0.9 + surge(hour, 1.75, 5.0, 2.2))
    return Scene("streets", "Water in the streets of a town", 2.0, bed, levels, fall=float(np.hypot(0.004, 0.002)))


SCENES: tuple[Callable[[], Scene], ...] = (coast, river, polder, streets)


def write(scene: Scene, folder: Path) -> Path:
    """NetCDF with depths, hour after hour, and the bed."""
    import pyproj

    path = folder / f"{scene.name}.nc"
    rows, columns = scene.bed.shape
    with netCDF4.Dataset(path, "w") as file:
        file.setncatts({"title": scene.title, "comment": NOTE, "source": "a formula", "institution": "vexture"})
        for name, count in (("time", len(scene.levels)), ("y", rows), ("x", columns)):
            file.createDimension(name, count)
        for name, first, count in (("x", SOUTH_WEST[0], columns), ("y", SOUTH_WEST[1], rows)):
            axis = file.createVariable(name, "f8", (name,))
            axis.setncatts({"units": "m", "standard_name": f"projection_{name}_coordinate"})
            axis[:] = first + (np.arange(count) + 0.5) * scene.cell
        when = file.createVariable("time", "f8", ("time",))
        when.units = f"hours since {START:%Y-%m-%d %H:%M:%S}"
        when[:] = np.arange(len(scene.levels))
        file.createVariable("crs", "i4").crs_wkt = pyproj.CRS.from_user_input(SYSTEM).to_wkt()
        bed = file.createVariable("bed_level", "f4", ("y", "x"), compression="zlib")
        bed.setncatts({"units": "m", "standard_name": "altitude", "grid_mapping": "crs"})
        bed[:] = scene.bed
        depths = np.maximum(np.array(scene.levels) - scene.bed, 0.0)
        depth = file.createVariable("depth", "f4", ("time", "y", "x"), compression="zlib")
        depth.setncatts({"units": "m", "long_name": "water depth", "grid_mapping": "crs"})
        depth[:] = depths
        if scene.fall > 0.0:
            speed = file.createVariable("speed", "f4", ("time", "y", "x"), compression="zlib")
            speed.setncatts({"units": "m s-1", "standard_name": "sea_water_speed", "grid_mapping": "crs"})
            speed[:] = depths ** (2.0 / 3.0) * np.sqrt(scene.fall) / ROUGHNESS
    return path


def hours_of(scene: Scene) -> str:
    """First and last time."""
    last = START + timedelta(hours=len(scene.levels) - 1)
    return f"{START:%H:%M} to {last:%H:%M}"
