"""Servers of textures that change while people look at them."""
