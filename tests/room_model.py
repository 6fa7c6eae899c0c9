"""A small model of glTF: a box on a floor, two materials, made here."""

import json
import struct
from itertools import product

import numpy as np

CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))
"""Corners of a square, with texture coordinates that go down, as in glTF."""


def square(center, right, down):
    """Corners of a square of side 2, its normals, its texture coordinates, and two triangles."""
    center, right, down = (np.array(one, np.float32) for one in (center, right, down))
    places = np.array([center + (2 * u - 1) * right + (2 * v - 1) * down for u, v in CORNERS], np.float32)
    normals = np.tile(np.cross(down, right), (4, 1)).astype(np.float32)
    return places, normals, np.array(CORNERS, np.float32), np.array([0, 2, 1, 0, 3, 2], np.uint16)


def box():
    """Six squares, each with the whole of the texture coordinates."""
    sides = []
    for axis, sign in product(range(3), (1, -1)):
        center, down = np.zeros(3), np.zeros(3)
        center[axis], down[(axis + 1) % 3] = sign, 1.0
        sides.append(square(center, np.cross(center, down), down))
    places, normals, coordinates, triangles = (np.concatenate(each) for each in zip(*sides, strict=True))
    return places, normals, coordinates, triangles + np.repeat(np.arange(6, dtype=np.uint16) * 4, 6)


def make_room(**members):
    """Document and binary of a model: the floor, whose material is Sign, and the box, whose material is Wall."""
    binary, views, accessors, meshes = b"", [], [], []
    shapes = {"Floor": square((0, 0, 0), (1, 0, 0), (0, -1, 0)), "Box": box()}
    for place, (name, arrays) in enumerate(shapes.items()):
        for array, target in zip(arrays, (34962, 34962, 34962, 34963), strict=True):
            views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes, "target": target})
            kind = {1: "SCALAR", 2: "VEC2", 3: "VEC3"}[1 if array.ndim == 1 else array.shape[1]]
            accessor = {"bufferView": len(views) - 1, "componentType": 5126 if array.ndim > 1 else 5123}
            bounds = {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()} if array.ndim > 1 else {}
            accessors.append(accessor | {"count": len(array), "type": kind, **bounds})
            binary += array.tobytes() + bytes(-array.nbytes % 4)
        first = 4 * place
        attributes = {"POSITION": first, "NORMAL": first + 1, "TEXCOORD_0": first + 2}
        meshes.append(
            {"name": name, "primitives": [{"attributes": attributes, "indices": first + 3, "material": place}]}
        )
    document = {
        "asset": {"version": "2.0", "generator": "vexture's tests"},
        "scene": 0,
        "scenes": [{"name": "Room", "nodes": [0, 1]}],
        "nodes": [
            {"name": "Floor", "mesh": 0},
            {"name": "Box", "mesh": 1, "translation": [0.1, 0.30000000000000004, -3]},
        ],
        "materials": [
            {"name": "Sign", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0}},
            {"name": "Wall", "extras": {"kept": ["é", 1e-7, 12345678901234567890]}},
        ],
        "meshes": meshes,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(binary)}],
    }
    return document | members, binary


def glb_content(document, binary=None, *others):
    """Contents of a .glb."""
    text = json.dumps(document).encode()
    chunks = [(b"JSON", text + b" " * (-len(text) % 4))]
    if binary is not None:
        chunks.append((b"BIN\0", binary + bytes(-len(binary) % 4)))
    body = b"".join(struct.pack("<I4s", len(content), kind) + content for kind, content in (*chunks, *others))
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def chunks_of(content):
    """Type and content of each chunk of a .glb, read without vexture."""
    assert struct.unpack_from("<4sII", content) == (b"glTF", 2, len(content))
    at, found = 12, []
    while at < len(content):
        length, kind = struct.unpack_from("<I4s", content, at)
        assert length % 4 == 0
        found.append((kind, content[at + 8 : at + 8 + length]))
        at += 8 + length
    return found


def document_of(content):
    """The JSON of a .glb."""
    return json.loads(chunks_of(content)[0][1])
