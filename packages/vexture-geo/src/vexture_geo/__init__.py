"""Geographic data for vexture: maps, tiles and floods."""
