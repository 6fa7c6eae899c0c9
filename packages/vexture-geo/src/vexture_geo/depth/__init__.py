"""Depths of water: rasters and meshes, at one time or several."""
