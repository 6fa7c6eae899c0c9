"""Drawings, textures and floods as widgets of notebooks (`vexture[notebook]`)."""
