"""Texture folding: animation of a shape whose texture does not change."""
