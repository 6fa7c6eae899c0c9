"""Encoding and decoding in either encoding, for tests that hold for both."""

from vexture.texture.decode import decode as decode_packed
from vexture.texture.encode import encode as encode_packed
from vexture.texture.root import Root
from vexture.thesis.decode import decode as decode_thesis
from vexture.thesis.encode import encode as encode_thesis
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellTree


def encode(tree, bits=16, *, to_source, name, crs=None):
    """Encode one tree as a texture."""
    if isinstance(tree, CellTree):
        return encode_thesis(tree, bits, to_source=to_source, name=name, crs=crs)
    return encode_packed([tree], [Root(name, 0, to_source, tree.deviation, crs)], name=name)


def decode(texture, root=None):
    """Decode a texture to a tree."""
    return decode_thesis(texture) if isinstance(texture, ThesisTexture) else decode_packed(texture, root)


def info(texture):
    """Facts of a texture."""
    return texture.info()
