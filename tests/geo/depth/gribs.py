"""Small files of GRIB: of edition 2 by GDAL, of edition 1 byte by byte."""

import struct
import warnings
from datetime import UTC, datetime

import numpy as np
import rasterio
from rasterio.io import MemoryFile

DEPTH, LEVEL, SOUNDING, ICE, TEMPERATURE = (10, 4, 14), (10, 3, 1), (10, 4, 7), (10, 2, 1), (0, 0, 0)
"""Discipline, category and number of parameters (code table 4.2)."""

FIELD = np.repeat([[0.0, 0.5, 1.0, 2.0]], 3, axis=0)

GEOGRAPHIC = {"crs": "EPSG:4326", "transform": rasterio.Affine(0.01, 0.0, 4.0, 0.0, -0.01, 52.03)}


def second_edition(*fields, values=FIELD, place=GEOGRAPHIC, nodata=None, surface=1):
    """Messages of edition 2, one for each parameter and its hour after 6:00."""
    return b"".join(
        _message(values * (1.0 + hour), parameter, hour, place, nodata, surface) for parameter, hour in fields
    )


def _message(values, parameter, hour, place, nodata, surface):
    discipline, *which = parameter
    template = [*which, 2, 0, 0, 0, 0, 0, 1, *struct.pack(">I", hour), surface, 0, 0, 0, 0, 0, 255, 0, 0, 0, 0, 0]
    about = {
        "DISCIPLINE": str(discipline),
        "IDS": "CENTER=7 REF_TIME=2026-02-14T06:00:00Z",
        "PDS_PDTN": "0",
        "PDS_TEMPLATE_NUMBERS": " ".join(map(str, template)),
    }
    height, width = values.shape
    with warnings.catch_warnings(action="ignore"), MemoryFile() as memory:
        with memory.open(
            driver="GRIB", width=width, height=height, count=1, dtype="float32", nodata=nodata, **place, **about
        ) as file:
            file.write(values.astype("float32"), 1)
        return memory.read()


def first_edition(parameter=82, table=2, time=datetime(2026, 2, 14, 6, tzinfo=UTC), values=(0, 1, 2, 3, 4, 5)):
    """A message of edition 1: three columns and two rows of whole numbers."""

    def three(number):
        return struct.pack(">I", number)[1:]

    product = bytes(
        (table, 7, 0, 255, 0x80, parameter, 1, 0, 0, time.year % 100, time.month, time.day, time.hour, 0, 1)
    )
    product += bytes((0, 0, 0, 0, 0, 0, 21, 0, 0, 0))
    product = three(3 + len(product)) + product
    grid = struct.pack(">BBBHH", 0, 255, 0, 3, 2) + three(52_000) + three(4_000) + bytes((0x80,))
    grid += three(51_000) + three(6_000) + struct.pack(">HHB", 1000, 1000, 0) + bytes(4)
    grid = three(3 + len(grid)) + grid
    numbers = struct.pack(">BHIB", 0, 0, 0, 8) + bytes(values)
    numbers = three(3 + len(numbers)) + numbers
    body = product + grid + numbers + b"7777"
    return b"GRIB" + three(8 + len(body)) + b"\1" + body
