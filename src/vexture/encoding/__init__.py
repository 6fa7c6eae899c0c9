"""Encodings: each turns a `CellTree` into textures and back."""

from vexture.encoding.files import target_of
from vexture.encoding.texture import ThesisTexture, load
from vexture.encoding.thesis import decode, encode, info, largest_step

__all__ = ["ThesisTexture", "decode", "encode", "info", "largest_step", "load", "target_of"]
