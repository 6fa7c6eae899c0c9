"""Models with textures: what a file has of them, and what it has besides."""

import hashlib
import json

import vexture
from room_model import chunks_of

EXTENSION = "VEXTURE_vector_texture"

KITE = vexture.Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)])


def digest(content):
    return hashlib.sha256(content).hexdigest()


def without_extension(document):
    """A document without all that vexture adds to it."""
    cleaned = json.loads(json.dumps(document))
    for owner in (cleaned, *cleaned.get("materials", [])):
        owner.get("extensions", {}).pop(EXTENSION, None)
        if owner.get("extensions") == {}:
            del owner["extensions"]
    cleaned["extensionsUsed"] = [name for name in cleaned.get("extensionsUsed", []) if name != EXTENSION]
    return cleaned


def bytes_of(content, index=0):
    """File of a texture in a .glb."""
    (_, text), (_, binary), *_ = chunks_of(content)
    document = json.loads(text)
    texture = document["extensions"][EXTENSION]["textures"][index]
    view = document["bufferViews"][texture["bufferView"]]
    assert view["buffer"] == 0
    assert view["byteOffset"] + view["byteLength"] <= document["buffers"][0]["byteLength"] <= len(binary)
    return binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
