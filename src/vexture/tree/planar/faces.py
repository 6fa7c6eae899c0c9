"""Faces: regions in which the same paths are inside, each of one colour.

A face is found by the set of paths that are inside: the exclusive or of a random key of each. Crossing a border
changes the key by the keys of the paths that begin or end there, whatever lies below and above them. The colour of a
face that is new is composited once, path by path and group by group, as SVG says: source-over in sRGB.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.group import Group
from vexture.kernels import kernel
from vexture.layout import PAINT_ONE
from vexture.tree.planar.blend import blend_over, masking
from vexture.tree.planar.style import elements_of
from vexture.tree.winding import inside

__all__ = [
    "ONE",
    "Faces",
    "Layers",
    "composite_stacks",
    "face_of",
    "layers_of",
    "new_faces",
    "refill",
    "roomier_faces",
    "solid_layers",
]

ONE = float(PAINT_ONE)
"""Colours are equal if they are equal in these steps, in which paints are stored."""

FIRST_ROOM = 1024
"""Faces for which a table has room at first."""


class Layers(NamedTuple):
    """What faces are composited of. The first arrays have a row for each path, in painting order."""

    rules: NDArray[np.int64]
    rgba: NDArray[np.float64]  # (paths, 4), premultiplied
    covers: NDArray[np.bool_]  # whether nothing below is seen where it is inside: opaque, and in no group
    hides: NDArray[np.bool_]  # written by the builder: whether something below is left out, as it covers it
    keys: NDArray[np.int64]
    look: NDArray[np.int64]  # key of each path's element, in a map to be restyled, else 0
    group: NDArray[np.int64]  # innermost group of each path, or -1
    outer: NDArray[np.int64]  # of each group: the group around it, or -1
    depth: NDArray[np.int64]  # of each group: how many there are around it
    opacity: NDArray[np.float64]
    blend: NDArray[np.int64]
    mask: NDArray[np.int64]
    masked: NDArray[np.int64]  # of each group: how many masks it has


class Faces(NamedTuple):
    """Table of all faces. Face 0 is where nothing is painted."""

    slots: NDArray[np.int64]  # (4 room,): face + 1 of each hash slot, or 0
    colour_slots: NDArray[np.int64]  # (4 room,): the same by colour
    keys: NDArray[np.int64]  # (room,)
    rgba: NDArray[np.float64]  # (room, 4), premultiplied
    look: NDArray[np.int64]  # (room,): key of the stack's elements, in a map to be restyled, else 0
    paint: NDArray[np.int64]  # (room,): the first face of the same colour and look
    starts: NDArray[np.int64]  # (room + 1,): where the stack of each face begins in `paths`
    paths: NDArray[np.int32]  # numbers of the paths inside, from below; from the highest that covers all below it on
    counts: NDArray[np.int64]  # (2,): faces; 1 if there was no room for another


def layers_of(drawing: Drawing, restyle: bool = False) -> Layers:
    """The arrays of a drawing; with `restyle` faces are alike by their elements, not by their colours."""
    paints = [path.paint for path in drawing.paths]
    rgba = np.array([(*paint.color, paint.opacity) for paint in paints]).reshape(-1, 4)
    group = np.array([path.group for path in drawing.paths], np.int64)
    return solid_layers(rgba, group, drawing.groups)._replace(
        rules=np.array([int(path.fill_rule) for path in drawing.paths], np.int64),
        covers=np.array([paint.is_opaque for paint in paints], np.bool_) & (group < 0),
        look=_looks(drawing) if restyle else np.zeros(len(paints), np.int64),
    )


def solid_layers(rgba: NDArray[np.float64], group: NDArray[np.int64], groups: tuple[Group, ...]) -> Layers:
    """The arrays of flat colours, (n, 4), not premultiplied, and the groups that they are in."""
    depth: list[int] = []
    for each in groups:
        depth.append(depth[each.outer] + 1 if each.outer >= 0 else 0)
    zeros = np.zeros(len(rgba), np.int64)
    return Layers(
        zeros,
        np.hstack([rgba[:, :3] * rgba[:, 3:], rgba[:, 3:]]),
        zeros != 0,
        np.zeros(len(rgba), np.bool_),
        _keys(len(rgba)),
        zeros,
        group,
        np.array([each.outer for each in groups], np.int64),
        np.array(depth, np.int64),
        np.array([each.opacity for each in groups], np.float64),
        np.array([int(each.blend) for each in groups], np.int64),
        np.array([int(each.mask) for each in groups], np.int64),
        np.bincount([each.outer for each in groups if each.mask], minlength=len(groups)).astype(np.int64),
    )


def _looks(drawing: Drawing) -> NDArray[np.int64]:
    """A key for each path, one for those of one element."""
    elements, number = elements_of(drawing)
    return _keys(len(elements))[number]


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
    for rows, old in zip(out[2:6], faces[2:6], strict=True):
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
            faces.colour_slots[_free_slot(faces.colour_slots, _colour_key(faces, face))] = face + 1


@kernel(allocates=False)
def _free_slot(slots: NDArray[np.int64], key: int) -> int:
    """First free slot for a key."""
    slot = key & (len(slots) - 1)
    while slots[slot] != 0:
        slot = (slot + 1) & (len(slots) - 1)
    return slot


@kernel(allocates=False)
def _colour_key(faces: Faces, face: int) -> int:
    """Hash of a face's look and colour in steps of 1/65535; 0 only of what is wholly transparent."""
    key = 0
    for c in range(4):
        key = (key << 16) | int(np.rint(ONE * faces.rgba[face, c]))
    key ^= faces.look[face]
    key ^= key >> 31
    key *= 0x5851F42D4C957F2D
    return key ^ (key >> 29)


@kernel(allocates=False)
def _same_colour(faces: Faces, a: int, b: int) -> bool:
    for c in range(4):
        if np.rint(ONE * faces.rgba[a, c]) != np.rint(ONE * faces.rgba[b, c]):
            return False
    return faces.look[a] == faces.look[b]


@kernel
def _composite(layers: Layers, stack: NDArray[np.int32], out: NDArray[np.float64]) -> None:
    """Write the colour (4,) of a stack of paths; those of a group are composited by themselves."""
    deepest = 0
    for g in range(len(layers.depth)):
        deepest = max(deepest, layers.depth[g] + 1)
    around, inner = np.empty(deepest + 1, np.int64), np.zeros((deepest + 1, 4))
    shown, missing = np.ones(deepest + 1), np.zeros(deepest + 1, np.int64)  # by masks; masks of which nothing was met
    level = 0  # open groups; inner[level] is what has been painted in the innermost
    for k in range(len(stack) + 1):
        group = layers.group[stack[k]] if k < len(stack) else -1
        while level > 0 and not _is_in(layers, group, around[level]):
            g = around[level]
            left = layers.opacity[g] * (shown[level] if missing[level] == 0 else 0.0)
            if layers.mask[g] == 0:
                blend_over(inner[level - 1], inner[level], left, layers.blend[g])
            else:
                shown[level - 1] *= left * masking(inner[level], layers.mask[g])
                missing[level - 1] -= 1
            level -= 1
        if k == len(stack):
            break
        while level <= (layers.depth[group] if group >= 0 else -1):
            g = group
            while layers.depth[g] > level:
                g = layers.outer[g]
            level += 1
            around[level], shown[level], missing[level] = g, 1.0, layers.masked[g]
            for c in range(4):
                inner[level, c] = 0.0
        blend_over(inner[level], layers.rgba[stack[k]], 1.0, 0)
    for c in range(4):
        out[c] = inner[0, c]


@kernel
def composite_stacks(
    layers: Layers, starts: NDArray[np.int64], paths: NDArray[np.int32], out: NDArray[np.float64]
) -> None:
    """Write the colours (n, 4) of stacks, of which number k is `paths[starts[k] : starts[k + 1]]`."""
    for k in range(len(out)):
        _composite(layers, paths[starts[k] : starts[k + 1]], out[k])


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
            if layers.covers[path] and end > start:
                layers.hides[path], end = True, start
            faces.paths[end] = path
            end += 1
    faces.starts[face + 1] = end
    return True


@kernel(allocates=False)
def _look_of(layers: Layers, stack: NDArray[np.int32]) -> int:
    """Hash of a stack's elements, in order; 0 of a map that is not to be restyled."""
    key = 0
    for k in range(len(stack)):
        key = (key ^ layers.look[stack[k]]) * 0x5851F42D4C957F2D
        key ^= key >> 29
    return key


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
    stack = faces.paths[faces.starts[face] : faces.starts[face + 1]]
    _composite(layers, stack, faces.rgba[face])
    faces.look[face] = _look_of(layers, stack)
    slot = _colour_key(faces, face) & mask
    while faces.colour_slots[slot] != 0:
        other = faces.colour_slots[slot] - 1
        if _same_colour(faces, other, face):
            faces.paint[face] = other
            return face
        slot = (slot + 1) & mask
    faces.colour_slots[slot] = face + 1
    faces.paint[face] = face
    return face
