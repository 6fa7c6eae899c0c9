"""Read features (polygons, lines and points) from files of any vector format."""
