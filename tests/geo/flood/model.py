"""A model that writes its run step by step, as it is told: `python model.py run_map.nc`, and a command in each line.

It keeps the file open, and so locked, until it is told to close it. After each command it says so.
"""

import sys

import netCDF4
import numpy as np

WEST, SOUTH, EAST, NORTH = 500000.0, 4000000.0, 504000.0, 4002000.0
COLUMNS, ROWS = 40, 20


def open_run(path, first_hour):
    """Create a file without steps."""
    import pyproj

    file = netCDF4.Dataset(path, "w")
    for name, count in (("time", None), ("y", ROWS), ("x", COLUMNS)):
        file.createDimension(name, count)
    x, y = file.createVariable("x", "f8", ("x",)), file.createVariable("y", "f8", ("y",))
    x[:] = WEST + (np.arange(COLUMNS) + 0.5) * (EAST - WEST) / COLUMNS
    y[:] = SOUTH + (np.arange(ROWS) + 0.5) * (NORTH - SOUTH) / ROWS
    file.createVariable("time", "f8", ("time",)).units = f"hours since 2026-02-14 {first_hour:02}:00:00"
    file.createVariable("crs", "i4").crs_wkt = pyproj.CRS.from_user_input("EPSG:32610").to_wkt()
    depth = file.createVariable("depth", "f4", ("time", "y", "x"))
    depth.setncatts({"units": "m", "standard_name": "sea_floor_depth_below_sea_surface", "grid_mapping": "crs"})
    bed = file.createVariable("bed_level", "f4", ("y", "x"))
    bed.setncatts({"units": "m", "grid_mapping": "crs", "standard_name": "altitude"})
    bed[:] = np.tile(np.linspace(-2.0, 2.0, COLUMNS), (ROWS, 1))
    file.sync()
    return file


def depths(edge):
    """Depths that fall to nothing at a share of the width."""
    middles = (np.arange(COLUMNS) + 0.5) / COLUMNS
    return np.tile(np.maximum(2.0 * (1.0 - middles / edge), 0.0), (ROWS, 1))


def run(path, lines):
    """Run the commands of these lines at once."""
    list(run_commands(path, lines))


def run_commands(path, lines):
    """Run commands, and yield each afterwards.

    They are `open HOUR`, `time`, `depth EDGE` (of the last time), `step EDGE` (both) and `close`.
    """
    file = None
    for line in lines:
        command, *given = line.split()
        if command == "open":
            file = open_run(path, int(given[0]))
        elif command == "close":
            file.close()
        if command in ("time", "step"):
            file["time"][len(file["time"])] = len(file["time"])
        if command in ("depth", "step"):
            file["depth"][len(file["time"]) - 1] = depths(float(given[0]))
        if command != "close":
            file.sync()
        yield line


if __name__ == "__main__":
    for done in run_commands(sys.argv[1], sys.stdin):
        print(done, end="", flush=True)
