"""Encodings: each turns a `CellTree` into textures and back."""

from vexture.encoding.dispatch import load
from vexture.encoding.files import target_of
from vexture.encoding.packed import encode_packed
from vexture.encoding.packed_texture import PackedTexture, Root
from vexture.encoding.texture import ThesisTexture
from vexture.encoding.thesis import decode, encode, info, quantisation_step

__all__ = [
    "PackedTexture",
    "Root",
    "ThesisTexture",
    "decode",
    "encode",
    "encode_packed",
    "info",
    "load",
    "quantisation_step",
    "target_of",
]
