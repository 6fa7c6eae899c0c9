"""The texture: bits, files, and what can be read of it."""
