"""Renderers: the exact renderer of drawings, the shader on the GPU, and its mirror on the CPU."""
