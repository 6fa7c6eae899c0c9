"""The model of the gallery: a bottle with a label, as glTF."""

import base64
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Profile = NDArray[np.float64]
"""Radii and heights, from above to below on the outside."""

WIDE: Final = 0.42
NARROW: Final = 0.15
"""Radii of the body and of the neck."""

LABEL: Final = 1.12
"""Side of the label, which is square on the paper."""


def lathe(profile: Profile, turn: float = 2 * np.pi, corners: int = 96) -> tuple[Any, Any, Any, Any]:
    """Corners, normals, texture coordinates and triangles of a profile that is turned about the y axis.

    The part of it that is there faces the z axis; u goes around it to the right, v down.
    """
    angles = np.linspace(-turn / 2, turn / 2, corners + 1)
    around = np.stack([np.sin(angles), np.cos(angles)], axis=1)
    along = np.gradient(profile, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)

    def turned(radii: Any, heights: Any) -> Any:
        x, z = radii[:, None] * around[:, 0], radii[:, None] * around[:, 1]
        return np.stack([x, np.broadcast_to(heights[:, None], x.shape), z], axis=2).reshape(-1, 3)

    places, normals = turned(*profile.T), turned(-along[:, 1], along[:, 0])
    lengths = np.insert(np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1)), 0, 0.0)
    u, v = np.meshgrid(np.linspace(0, 1, corners + 1), lengths / lengths[-1])
    first = (np.arange(len(profile) - 1)[:, None] * (corners + 1) + np.arange(corners)).reshape(-1, 1)
    below = first + corners + 1
    triangles = np.concatenate([first, below, first + 1, first + 1, below, below + 1], axis=1)
    coordinates = np.stack([u, v], axis=2).reshape(-1, 2)
    return np.float32(places), np.float32(normals), np.float32(coordinates), np.uint16(triangles.reshape(-1))


def glass() -> Profile:
    """Profile of the bottle: a lip, a neck, a round shoulder, a body and a foot."""
    shoulder = np.linspace(0, np.pi, 24)
    ease = (1 - np.cos(shoulder)) / 2
    foot = np.linspace(0, np.pi / 2, 8)
    lip = [(-0.03, 2.9), (0, 2.9), (0.025, 2.88), (0.025, 2.78), (0, 2.76), (0, 2.4)]
    parts = [
        np.array(lip) + np.array((NARROW, 0)),
        np.stack([NARROW + (WIDE - NARROW) * ease, 2.35 - 0.65 * shoulder / np.pi], axis=1),
        [(WIDE, 1.6), (WIDE, 0.1)],
        np.stack([WIDE - 0.08 + 0.08 * np.cos(foot), 0.08 - 0.08 * np.sin(foot)], axis=1),
        [(0.0, 0.0)],
    ]
    return np.concatenate([np.array(part, np.float64) for part in parts])


def bottle() -> dict[str, Any]:
    """The bottle: dark glass, a cork, and the paper of the label just outside of the glass."""
    outside = WIDE + 0.004
    label = np.stack([np.full(2, outside), np.array([0.28 + LABEL, 0.28])], axis=1)
    cork = np.array([(0.0, 3.06), (0.12, 3.06), (0.13, 3.04), (0.125, 2.8)])
    parts = {
        "Glass": (lathe(glass()), (0.03, 0.075, 0.03), 0.08),
        "Cork": (lathe(cork), (0.55, 0.36, 0.2), 0.9),
        "Label": (lathe(label, LABEL / outside), (0.96, 0.93, 0.85), 0.75),
    }
    binary, views, accessors, meshes, materials, nodes = b"", [], [], [], [], []
    for place, (name, (arrays, color, roughness)) in enumerate(parts.items()):
        for array in arrays:
            views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes})
            is_flat = array.ndim == 1
            bounds = {} if is_flat else {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
            kind = "SCALAR" if is_flat else f"VEC{array.shape[1]}"
            accessors.append({"bufferView": len(views) - 1, "componentType": 5123 if is_flat else 5126, **bounds})
            accessors[-1] |= {"count": len(array), "type": kind}
            binary += array.tobytes() + bytes(-array.nbytes % 4)
        first = 4 * place
        attributes = {"POSITION": first, "NORMAL": first + 1, "TEXCOORD_0": first + 2}
        meshes.append({"primitives": [{"attributes": attributes, "indices": first + 3, "material": place}]})
        surface = {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": roughness}
        materials.append({"name": name, "pbrMetallicRoughness": surface})
        nodes.append({"name": name, "mesh": place})
    uri = f"data:application/octet-stream;base64,{base64.b64encode(binary).decode()}"
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(binary), "uri": uri}],
    }
