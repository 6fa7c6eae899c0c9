"""Encodings: each turns a `CellTree` into textures and back."""

from vexture.encoding.texture import ThesisTexture, load
from vexture.encoding.thesis import decode, encode, info

__all__ = ["ThesisTexture", "decode", "encode", "info", "load"]
