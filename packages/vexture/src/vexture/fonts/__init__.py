"""Fonts: their outlines, metrics and colours, and the shaping of text with them."""
