"""The texture: its bits, its file, and what can be read from it.

FORMAT.md specifies the bits, and `vexture.base.layout` names them. `encode.py` writes a field of a texel. `walk.py`
checks it and reads it for trees, `contains.py` reads it for points. The shader (`vexture/shaders`) and its mirror
(`renderers/cpu.py`) read it for pixels.
"""
