"""Encodings: each turns a `CellTree` into textures and back."""

from vexture.encoding.files import target_of
from vexture.encoding.texture import ThesisTexture, load
from vexture.encoding.thesis import decode, encode, info, quantisation_step

__all__ = ["ThesisTexture", "decode", "encode", "info", "load", "quantisation_step", "target_of"]
