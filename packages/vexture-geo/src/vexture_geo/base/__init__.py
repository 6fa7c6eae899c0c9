"""Parts that all geographic data share: reference systems, extents, rings, and how GDAL is called."""
