"""Renderers: the exact one from a drawing, the shader on the GPU, and its mirror on the CPU."""
