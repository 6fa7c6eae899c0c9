"""Shared parts of all geographic data: reference systems, extents, rings, and calls of GDAL."""
