"""Encodings: each turns a tree into textures and back."""

from vexture.encoding.dispatch import decode, encode, info, load
from vexture.encoding.files import target_of
from vexture.encoding.packed import decode_packed, encode_packed
from vexture.encoding.packed_texture import PackedTexture, Root
from vexture.encoding.texture import ThesisTexture
from vexture.encoding.thesis import quantisation_step

__all__ = [
    "PackedTexture",
    "Root",
    "ThesisTexture",
    "decode",
    "decode_packed",
    "encode",
    "encode_packed",
    "info",
    "load",
    "quantisation_step",
    "target_of",
]
