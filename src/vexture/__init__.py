"""Vector textures: drawings that a GPU reads at random, sharp at every zoom."""
