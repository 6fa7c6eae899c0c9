"""The texture: its bits, its file and its queries.

FORMAT.md specifies the bits, and `vexture.base.layout` names them. `encode.py` writes texels. `walk.py` validates and
reads them for trees, `contains.py` reads them for points. The shader (`vexture/shaders`) and its mirror
(`renderers/cpu.py`) read them for pixels.
"""
