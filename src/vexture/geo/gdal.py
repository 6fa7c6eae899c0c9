"""How GDAL reads rasters here: with little memory, however large they are, and without messages of its own."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

__all__ = ["gdal"]

CACHE: Final = 128 * 2**20
"""Bytes of blocks that GDAL keeps, which by default takes a twentieth of the memory. A row of blocks of a raster of
50,000 columns has 100 MB."""


@contextmanager
def gdal() -> Iterator[None]:
    """Read rasters within this context."""
    import rasterio

    with rasterio.Env(CPL_LOG=os.devnull, GDAL_CACHEMAX=CACHE):
        yield
