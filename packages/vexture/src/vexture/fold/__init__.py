"""Texture folding: a shape that moves although its texture does not."""
