"""Faces: regions in which the same paths are inside, each of one colour.

A face is found by the set of paths that are inside: the exclusive or of a random key of each. Crossing a border
changes the key by the keys of the paths that begin or end there, whatever lies below and above them. The colour of a
face that is new is composited once, path by path and group by group, as SVG says: source-over in sRGB.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.kernels import kernel
from vexture.layout import PAINT_ONE
from vexture.tree.planar.blend import blend_over
from vexture.tree.winding import inside

__all__ = ["ONE", "Faces", "Layers", "face_of", "layers_of", "new_faces", "refill", "roomier_faces"]

ONE = float(PAINT_ONE)
"""Colours are equal if they are equal in these steps, in which paints are stored."""

FIRST_ROOM = 1024
"""Faces for which a table has room at first."""


class Layers(NamedTuple):
    """What faces are composited of. The first arrays have a row for each path, in painting order."""

    rules: NDArray[np.int64]
    rgba: NDArray[np.float64]  # (paths, 4), premultiplied
    covers: NDArray[np.bool_]  # whether nothing below is seen where it is inside: opaque, and in no group
    keys: NDArray[np.int64]
    group: NDArray[np.int64]  # innermost group of each path, or -1
    outer: NDArray[np.int64]  # of each group: the group around it, or -1
    depth: NDArray[np.int64]  # of each group: how many there are around it
    opacity: NDArray[np.float64]
    blend: NDArray[np.int64]


class Faces(NamedTuple):
    """Table of all faces. Face 0 is where nothing is painted."""

    slots: NDArray[np.int64]  # (4 room,): face + 1 of each hash slot, or 0
    colour_slots: NDArray[np.int64]  # (4 room,): the same by colour
    keys: NDArray[np.int64]  # (room,)
    rgba: NDArray[np.float64]  # (room, 4), premultiplied
    paint: NDArray[np.int64]  # (room,): the first face of the same colour
    starts: NDArray[np.int64]  # (room + 1,): where the stack of each face begins in `paths`
    paths: NDArray[np.int32]  # numbers of the paths inside, from below; from the highest that covers all below it on
    counts: NDArray[np.int64]  # (2,): faces; 1 if there was no room for another


def layers_of(drawing: Drawing) -> Layers:
    """The arrays of a drawing."""
    paints = [path.paint for path in drawing.paths]
    opacity = np.array([paint.opacity for paint in paints]).reshape(-1, 1)
    colour = np.array([paint.color for paint in paints]).reshape(-1, 3)
    groups = drawing.groups
    return Layers(
        np.array([int(path.fill_rule) for path in drawing.paths], np.int64),
        np.hstack([colour * opacity, opacity]),
        np.array([path.paint.is_opaque and path.group < 0 for path in drawing.paths], np.bool_),
        _keys(len(paints)),
        np.array([path.group for path in drawing.paths], np.int64),
        np.array([group.outer for group in groups], np.int64),
        np.array([len(drawing.around(place)) - 1 for place in range(len(groups))], np.int64),
        np.array([group.opacity for group in groups], np.float64),
        np.array([int(group.blend) for group in groups], np.int64),
    )


def _keys(count: int) -> NDArray[np.int64]:
    """Numbers without pattern: SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators")."""
    z = np.arange(1, count + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return (z ^ (z >> np.uint64(31))).view(np.int64)


def new_faces() -> Faces:
    """A table that holds face 0."""
    return _faces(FIRST_ROOM, FIRST_ROOM)


def _faces(room: int, paths: int) -> Faces:
    faces = Faces(
        np.zeros(4 * room, np.int64),
        np.zeros(4 * room, np.int64),
        np.zeros(room, np.int64),
        np.zeros((room, 4)),
        np.zeros(room, np.int64),
        np.zeros(room + 1, np.int64),
        np.zeros(paths, np.int32),
        np.array([1, 0]),
    )
    faces.slots[0] = faces.colour_slots[0] = 1
    return faces


def roomier_faces(faces: Faces) -> Faces:
    """A copy with twice the room of what is full."""
    count, room = int(faces.counts[0]), len(faces.keys)
    out = _faces(2 * room, len(faces.paths)) if count == room else _faces(room, 2 * len(faces.paths))
    for rows, old in zip(out[2:5], faces[2:5], strict=True):
        rows[:count] = old[:count]
    out.starts[: count + 1] = faces.starts[: count + 1]
    out.paths[: faces.starts[count]] = faces.paths[: faces.starts[count]]
    out.counts[0] = count
    refill(out)
    return out


@kernel(allocates=False, ahead=True)
def refill(faces: Faces) -> None:
    """Put all faces into the hash slots."""
    for face in range(1, faces.counts[0]):
        faces.slots[_free_slot(faces.slots, faces.keys[face])] = face + 1
        if faces.paint[face] == face:
            faces.colour_slots[_free_slot(faces.colour_slots, _colour_key(faces.rgba[face]))] = face + 1


@kernel(allocates=False)
def _free_slot(slots: NDArray[np.int64], key: int) -> int:
    """First free slot for a key."""
    slot = key & (len(slots) - 1)
    while slots[slot] != 0:
        slot = (slot + 1) & (len(slots) - 1)
    return slot


@kernel(allocates=False)
def _colour_key(rgba: NDArray[np.float64]) -> int:
    """Hash of a colour in steps of 1/65535; 0 only of what is wholly transparent."""
    key = 0
    for c in range(4):
        key = (key << 16) | int(np.rint(ONE * rgba[c]))
    key ^= key >> 31
    key *= 0x5851F42D4C957F2D
    return key ^ (key >> 29)


@kernel(allocates=False)
def _same_colour(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    for c in range(4):
        if np.rint(ONE * a[c]) != np.rint(ONE * b[c]):
            return False
    return True


@kernel
def _composite(layers: Layers, stack: NDArray[np.int32], out: NDArray[np.float64]) -> None:
    """Write the colour (4,) of a stack of paths; those of a group are composited by themselves."""
    deepest = 0
    for g in range(len(layers.depth)):
        deepest = max(deepest, layers.depth[g] + 1)
    around, inner = np.empty(deepest + 1, np.int64), np.zeros((deepest + 1, 4))
    level = 0  # open groups; inner[level] is what has been painted in the innermost
    for k in range(len(stack) + 1):
        group = layers.group[stack[k]] if k < len(stack) else -1
        while level > 0 and not _is_in(layers, group, around[level]):
            g = around[level]
            blend_over(inner[level - 1], inner[level], layers.opacity[g], layers.blend[g])
            level -= 1
        if k == len(stack):
            break
        while level <= (layers.depth[group] if group >= 0 else -1):
            g = group
            while layers.depth[g] > level:
                g = layers.outer[g]
            level += 1
            around[level] = g
            for c in range(4):
                inner[level, c] = 0.0
        blend_over(inner[level], layers.rgba[stack[k]], 1.0, 0)
    for c in range(4):
        out[c] = inner[0, c]


@kernel(allocates=False)
def _is_in(layers: Layers, group: int, around: int) -> bool:
    """Whether a group, or -1, is another one or lies in it."""
    while group >= 0 and layers.depth[group] > layers.depth[around]:
        group = layers.outer[group]
    return group == around


@kernel(allocates=False)
def _stack(
    faces: Faces, layers: Layers, ground: int, present: NDArray[np.int64], windings: NDArray[np.int64], face: int
) -> bool:
    """Write the stack of a face, which is that of its ground and the paths inside; False if there is no room."""
    start = faces.starts[face]
    end, first = start, faces.starts[ground]
    if start + faces.starts[ground + 1] - first + len(present) > len(faces.paths):
        return False
    for k in range(first, faces.starts[ground + 1]):
        faces.paths[end] = faces.paths[k]
        end += 1
    for k in range(len(present)):
        path = present[k, 0]
        if inside(windings[k], layers.rules[path]):
            end = start if layers.covers[path] else end
            faces.paths[end] = path
            end += 1
    faces.starts[face + 1] = end
    return True


@kernel
def face_of(
    faces: Faces, layers: Layers, ground: int, present: NDArray[np.int64], windings: NDArray[np.int64], key: int
) -> int:
    """The face above another one, `ground`, in which some paths are inside by their windings.

    `present` (n, 2) lists paths in painting order, `windings` (n,) belongs to it. `key` is the exclusive or of the keys
    of the paths that are inside. Without room for a new face, `faces.counts[1]` becomes 1 and the result is 0.
    """
    if key == 0:
        return ground
    key ^= faces.keys[ground]
    mask = len(faces.slots) - 1
    slot = key & mask
    while faces.slots[slot] != 0:
        face = faces.slots[slot] - 1
        if faces.keys[face] == key:
            return face
        slot = (slot + 1) & mask
    face = faces.counts[0]
    if face == len(faces.keys) or not _stack(faces, layers, ground, present, windings, face):
        faces.counts[1] = 1
        return 0
    faces.slots[slot] = face + 1
    faces.counts[0] = face + 1
    faces.keys[face] = key
    _composite(layers, faces.paths[faces.starts[face] : faces.starts[face + 1]], faces.rgba[face])
    slot = _colour_key(faces.rgba[face]) & mask
    while faces.colour_slots[slot] != 0:
        other = faces.colour_slots[slot] - 1
        if _same_colour(faces.rgba[other], faces.rgba[face]):
            faces.paint[face] = other
            return face
        slot = (slot + 1) & mask
    faces.colour_slots[slot] = face + 1
    faces.paint[face] = face
    return face
