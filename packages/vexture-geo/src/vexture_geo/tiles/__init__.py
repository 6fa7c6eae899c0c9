"""Pyramids of tiles: what one texture cannot hold, as a planar map for each tile of the web's Mercator grid."""
