"""Notebook widgets for drawings, textures and floods (`vexture[notebook]`)."""
