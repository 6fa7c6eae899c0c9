"""Faces of a mesh that stand for an area: each once, and none from one side of the antimeridian to the other."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.notes import Notes
from vexture_geo.base.longitudes import narrower
from vexture_geo.depth.mesh_topology import Faces

TURN: Final = 360.0

FAMILIAR: Final = 90.0
"""Degrees. Places that do not say that they are degrees must span less than this to be moved by a turn."""

MIXING: Final = np.uint64(0x9E3779B97F4A7C15)
"""Factor by which numbers of nodes differ in all of their bits."""


def faces_once(faces: Faces, notes: Notes) -> NDArray[np.intp] | None:
    """Numbers of faces without those that have the nodes of an earlier one; None if there are none of them.

    Sides of a face that a file has twice would have faces on both sides, also where the water ends.
    """
    mixed = np.zeros(len(faces), np.uint64)
    for column in faces.T:  # sums do not depend on the node with which a face begins
        number = (column.astype(np.int64) + 2).astype(np.uint64) * MIXING
        mixed += (number ^ (number >> np.uint64(29))) * MIXING
    order = np.argsort(mixed, kind="stable")
    same = mixed[order][1:] == mixed[order][:-1]
    if not same.any():
        return None
    alike = np.concatenate([same, [False]]) | np.concatenate([[False], same])
    some = np.sort(order[alike])
    _, first = np.unique(np.sort(faces[some], axis=1), axis=0, return_index=True)
    again = np.setdiff1d(some, some[first])
    if not len(again):
        return None
    notes.remark(f"its mesh has {len(again):,} faces more than once; the first of each is read")
    return np.setdiff1d(np.arange(len(faces)), again)


def faces_unwrapped(
    nodes: NDArray[np.float64], faces: Faces, *, are_degrees: bool, notes: Notes
) -> tuple[NDArray[np.float64], NDArray[np.intp] | None]:
    """Nodes with longitudes that do not jump, and the numbers of faces that are whole with them; None if all are.

    A mesh across the antimeridian is moved to one side of it. Of one around the world, faces that cross it are left
    out, which a note says. Places may be degrees without saying so.
    """
    if not _jump(nodes, faces).any() or np.abs(nodes).max() > TURN:
        return nodes, None
    moved = np.column_stack([narrower(nodes[:, 0], TURN), nodes[:, 1]])
    if not _jump(moved, faces).any() and (are_degrees or np.ptp(moved[:, 0]) < FAMILIAR):
        return moved, None
    if not are_degrees:
        return nodes, None
    jump = _jump(nodes, faces)
    notes.remark(f"its mesh goes around the world; faces across the antimeridian are left out: {int(jump.sum()):,}")
    return nodes, np.flatnonzero(~jump)


def _jump(nodes: NDArray[np.float64], faces: Faces) -> NDArray[np.bool_]:
    """Mark faces that are wider than half a turn."""
    low = nodes[faces[:, 0], 0]
    high = low.copy()
    for column in faces.T[1:]:
        x = nodes[np.where(column >= 0, column, faces[:, 0]), 0]
        np.minimum(low, x, out=low)
        np.maximum(high, x, out=high)
    return np.asarray(high - low > TURN / 2.0)
