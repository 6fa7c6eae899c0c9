"""Faces: regions in which the same paths are inside, each of one paint.

A face is found by the set of paths that are inside: its key is the exclusive or of a random key of each of them. At a
border only the keys of the paths that begin or end there change it, whatever lies below and above them. The paint of a
new face is composed once, path by path and group by group: a colour, or a program if it holds gradients.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.tree.planar.compose import ONE, Operations, compose, key_of_operations, new_operations
from vexture.tree.planar.layers import PlanarLayers, solid_layers
from vexture.tree.winding import inside

FIRST_ROOM = 1024
"""Faces for which a table has room at first."""


class FaceTable(NamedTuple):
    """Table of all faces. Face 0 is where nothing is painted."""

    slots: NDArray[np.int64]  # (4 room,): face + 1 of each hash slot, or 0
    paint_slots: NDArray[np.int64]  # (4 room,): the same for a hash of paints
    keys: NDArray[np.int64]  # (room,)
    rgba: NDArray[np.float64]  # (room, 4), premultiplied; 0 for programs
    program: NDArray[np.int64]  # (room,): key of its operations; 0 for a colour
    look: NDArray[np.int64]  # (room,): key of the stack's elements, in a map to be restyled, else 0
    paint: NDArray[np.int64]  # (room,): the first face of the same colour or program, and look
    starts: NDArray[np.int64]  # (room + 1,): where the stack of each face begins in `paths`
    paths: NDArray[np.int32]  # stacks: numbers of the paths inside, from below, without those that another one hides
    counts: NDArray[np.int64]  # (2,): number of faces; 1 if there was no room for another, else 0


class CellFaces(NamedTuple):
    """The table of faces and what decides which of them a point of a cell lies in."""

    faces: FaceTable
    layers: PlanarLayers
    ground: int  # the face where no path in the cell is inside
    present: NDArray[np.int64]  # (n, 2): paths in painting order, each with its winding at the cell's corner
    windings: NDArray[np.int64]  # (n or more,), scratch: windings of these paths at a point


@kernel(ahead=True)
def new_faces(room: int, paths: int) -> FaceTable:
    """Make a table that holds face 0, with room for faces, a power of two, and for paths in their stacks."""
    faces = FaceTable(
        np.zeros(4 * room, np.int64),
        np.zeros(4 * room, np.int64),
        np.zeros(room, np.int64),
        np.zeros((room, 4)),
        np.zeros(room, np.int64),
        np.zeros(room, np.int64),
        np.zeros(room, np.int64),
        np.zeros(room + 1, np.int64),
        np.zeros(paths, np.int32),
        np.zeros(2, np.int64),
    )
    faces.slots[0] = faces.paint_slots[0] = faces.counts[0] = 1
    return faces


def faces_with(faces: FaceTable, face: int) -> FaceTable:
    """Make a table of face 0 and, as face 1, a face of another table, unless that is face 0 itself."""
    start, end = faces.starts[face : face + 2]
    out = FaceTable(*new_faces(FIRST_ROOM, max(FIRST_ROOM, int(end - start))))
    if face:
        for rows, given in zip(out[2:6], faces[2:6], strict=True):
            rows[1] = given[face]
        out.paint[1] = 0 if faces.paint[face] == 0 else 1
        out.starts[2] = end - start
        out.paths[: end - start] = faces.paths[start:end]
        out.counts[0] = 2
        refill(out)
    return out


def trim_faces(faces: FaceTable) -> FaceTable:
    """Copy a table without its spare room and slots; nothing can be found in it or added to it."""
    count = int(faces.counts[0])
    none = np.zeros(0, np.int64)
    starts = faces.starts[: count + 1].copy()
    return FaceTable(
        none,
        none,
        faces.keys[:count].copy(),
        faces.rgba[:count].copy(),
        faces.program[:count].copy(),
        faces.look[:count].copy(),
        faces.paint[:count].copy(),
        starts,
        faces.paths[: starts[-1]].copy(),
        faces.counts.copy(),
    )


@kernel
def roomier_faces(faces: FaceTable) -> FaceTable:
    """Copy a full table with twice the room for faces or for paths, whichever is full."""
    count, room, paths = faces.counts[0], len(faces.keys), len(faces.paths)
    out = new_faces(2 * room, paths) if count == room else new_faces(room, 2 * paths)
    for k in range(count):
        out.keys[k], out.program[k], out.look[k] = faces.keys[k], faces.program[k], faces.look[k]
        out.paint[k], out.starts[k + 1] = faces.paint[k], faces.starts[k + 1]
        for c in range(4):
            out.rgba[k, c] = faces.rgba[k, c]
    for k in range(faces.starts[count]):
        out.paths[k] = faces.paths[k]
    out.counts[0] = count
    refill(out)
    return out


@kernel(allocates=False, ahead=True)
def refill(faces: FaceTable) -> None:
    """Put all faces into the hash slots."""
    for face in range(1, faces.counts[0]):
        faces.slots[_free_slot(faces.slots, faces.keys[face])] = face + 1
        if faces.paint[face] == face:
            faces.paint_slots[_free_slot(faces.paint_slots, _paint_key(faces, face))] = face + 1


@kernel(allocates=False, ahead=True)
def add_faces(faces: FaceTable, more: FaceTable, first: int, last: int, number: NDArray[np.int64]) -> None:
    """Add faces first..last-1 of the table `more` to one with room; write their new numbers to `number`."""
    for k in range(first, last):
        slot = _slot_of(faces, more.keys[k]) if more.keys[k] != 0 else 0
        if more.keys[k] == 0 or faces.slots[slot] != 0:
            number[k] = faces.slots[slot] - 1 if more.keys[k] != 0 else 0
            continue
        face = faces.counts[0]
        faces.counts[0], faces.slots[slot], number[k] = face + 1, face + 1, face
        faces.keys[face], faces.program[face], faces.look[face] = more.keys[k], more.program[k], more.look[k]
        for c in range(4):
            faces.rgba[face, c] = more.rgba[k, c]
        at = faces.starts[face]
        for place in range(more.starts[k], more.starts[k + 1]):
            faces.paths[at] = more.paths[place]
            at += 1
        faces.starts[face + 1] = at
        _set_paint(faces, face)


@kernel(allocates=False)
def _free_slot(slots: NDArray[np.int64], key: int) -> int:
    """First free slot for a key."""
    slot = key & (len(slots) - 1)
    while slots[slot] != 0:
        slot = (slot + 1) & (len(slots) - 1)
    return slot


@kernel(allocates=False)
def _paint_key(faces: FaceTable, face: int) -> int:
    """Hash of a face's program and look, or of its colour in steps of 1/65535; 0 only for a transparent face."""
    key = faces.program[face] ^ faces.look[face]
    if key != 0:
        return key
    for c in range(4):
        key = (key << 16) | int(np.rint(ONE * faces.rgba[face, c]))
    key ^= key >> 31
    key *= 0x5851F42D4C957F2D
    return key ^ (key >> 29)


@kernel(allocates=False)
def _same_paint(faces: FaceTable, a: int, b: int) -> bool:
    for c in range(4):
        if np.rint(ONE * faces.rgba[a, c]) != np.rint(ONE * faces.rgba[b, c]):
            return False
    return faces.program[a] == faces.program[b] and faces.look[a] == faces.look[b]


@kernel
def stack_of(faces: FaceTable, face: int) -> NDArray[np.int32]:
    """Stack of a face: the numbers of the paths inside, from below."""
    return faces.paths[faces.starts[face] : faces.starts[face + 1]]


@kernel
def operations_of(layers: PlanarLayers, stack: NDArray[np.int32]) -> tuple[int, Operations, int]:
    """Compose a stack; return the number of operations, the operations, and whether gradients became their means.

    The last is 1 if no paint can hold the gradients, else 0.
    """
    ops = new_operations(layers, stack)
    count = compose(layers, stack, False, ops)
    if count >= 0:
        return count, ops, 0
    return compose(layers, stack, True, ops), ops, 1


@kernel(allocates=False)
def _stack(
    faces: FaceTable,
    layers: PlanarLayers,
    ground: int,
    present: NDArray[np.int64],
    windings: NDArray[np.int64],
    face: int,
) -> bool:
    """Write the stack of a face: its ground's stack, then the paths inside; return False if there is no room."""
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
def _look_of(layers: PlanarLayers, stack: NDArray[np.int32]) -> int:
    """Hash of a stack's elements, in order; 0 in a map that is not to be restyled."""
    key = 0
    for k in range(len(stack)):
        key = (key ^ layers.look[stack[k]]) * 0x5851F42D4C957F2D
        key ^= key >> 29
    return key


@kernel
def composite_stacks(
    rgba: NDArray[np.float64],
    group: NDArray[np.int64],
    groups: NDArray[np.int64],
    opacities: NDArray[np.float64],
    starts: NDArray[np.int64],
    members: NDArray[np.int32],
) -> NDArray[np.float64]:
    """Colours (n, 4) of stacks of flat colours, of which number k is `members[starts[k] : starts[k + 1]]`.

    The first four arguments are those of `solid_layers`.
    """
    layers = solid_layers(rgba, group, groups, opacities)
    out = np.zeros((len(starts) - 1, 4))
    for k in range(len(out)):
        stack = members[starts[k] : starts[k + 1]]
        ops = new_operations(layers, stack)
        if compose(layers, stack, True, ops) > 0:
            for c in range(4):
                out[k, c] = ops.rgba[0, c]
    return out


@kernel(allocates=False)
def face_of(
    faces: FaceTable,
    layers: PlanarLayers,
    ground: int,
    present: NDArray[np.int64],
    windings: NDArray[np.int64],
    key: int,
) -> int:
    """Find or add the face whose stack is that of the face `ground` and the paths that are inside.

    `present` (n, 2) lists paths in painting order, and `windings` (n,) decides which are inside. `key` is the exclusive
    or of their keys. Without room for a new face, `faces.counts[1]` becomes 1 and the result is 0.
    """
    if key == 0:
        return ground
    key ^= faces.keys[ground]
    slot = _slot_of(faces, key)
    if faces.slots[slot] != 0:
        return faces.slots[slot] - 1
    return _new_face(faces, layers, ground, present, windings, key, slot)  # rare, and slows this function if inlined


@kernel(allocates=False)
def paint_of(cell: CellFaces, key: int) -> int:
    """Paint where the paths of a cell have its `windings`; `key` is the exclusive or of the keys of those inside."""
    return cell.faces.paint[face_of(cell.faces, cell.layers, cell.ground, cell.present, cell.windings, key)]


@kernel(allocates=False)
def _slot_of(faces: FaceTable, key: int) -> int:
    """Slot of the face with a key, or the free slot for it."""
    mask = len(faces.slots) - 1
    slot = key & mask
    while faces.slots[slot] != 0 and faces.keys[faces.slots[slot] - 1] != key:
        slot = (slot + 1) & mask
    return slot


@kernel
def _new_face(
    faces: FaceTable,
    layers: PlanarLayers,
    ground: int,
    present: NDArray[np.int64],
    windings: NDArray[np.int64],
    key: int,
    slot: int,
) -> int:
    """Add a face to the table at a free slot, and its paint if that is new."""
    face = faces.counts[0]
    if face == len(faces.keys) or not _stack(faces, layers, ground, present, windings, face):
        faces.counts[1] = 1
        return 0
    faces.slots[slot] = face + 1
    faces.counts[0] = face + 1
    faces.keys[face] = key
    stack = stack_of(faces, face)
    faces.look[face] = _look_of(layers, stack)
    count, ops, _ = operations_of(layers, stack)
    faces.program[face] = key_of_operations(ops, count)
    for c in range(4):
        faces.rgba[face, c] = ops.rgba[0, c] if faces.program[face] == 0 and count > 0 else 0.0
    _set_paint(faces, face)
    return face


@kernel(allocates=False)
def _set_paint(faces: FaceTable, face: int) -> None:
    """Set the paint of a new face: the first face that looks the same, or the new face itself."""
    mask = len(faces.slots) - 1
    slot = _paint_key(faces, face) & mask
    while faces.paint_slots[slot] != 0:
        other = faces.paint_slots[slot] - 1
        if _same_paint(faces, other, face):
            faces.paint[face] = other
            return
        slot = (slot + 1) & mask
    faces.paint_slots[slot] = face + 1
    faces.paint[face] = face
