"""Features: polygons, lines and points in files of any vector format."""
