"""Pyramids of tiles for maps too large for one texture: a planar map for each tile of the web's Mercator grid."""
