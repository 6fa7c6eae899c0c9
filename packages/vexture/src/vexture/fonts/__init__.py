"""Fonts: their outlines, metrics and colours, and text shaping."""
