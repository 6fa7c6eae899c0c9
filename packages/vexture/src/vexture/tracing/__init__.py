"""Tracing of raster images into drawings."""
