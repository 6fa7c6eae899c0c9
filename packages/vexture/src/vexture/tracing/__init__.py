"""Raster images, traced into drawings."""
