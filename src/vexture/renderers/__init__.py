"""Renderers: the exact one from a drawing, the mirror on the CPU, the shader on the GPU."""
