"""Faces of a mesh: their sides, triangles and neighbours, and means over neighbours."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Faces = NDArray[np.int32]
"""Numbers of the nodes of each face, (m, k); a row of fewer nodes ends in -1."""


def after_each(faces: Faces) -> Faces:
    """Return the node after each node of a face; -1 where there is no node.

    Examples
    --------
    >>> after_each(np.array([[4, 5, 6, -1]], np.int32))
    array([[ 5,  6,  4, -1]], dtype=int32)
    """
    after = np.concatenate([faces[:, 1:], np.full((len(faces), 1), -1, np.int32)], axis=1)
    return np.where((faces >= 0) & (after < 0), faces[:, :1], after)


def counter_clockwise(nodes: NDArray[np.float64], faces: Faces) -> Faces:
    """Order the nodes of faces counter-clockwise; `nodes` are places, (n, 2)."""
    after, first = after_each(faces), nodes[faces[:, 0]]
    twice = np.zeros(len(faces))
    for here, there in zip(faces.T, after.T, strict=True):  # one column at a time, for little memory
        a, b = nodes[here] - first, nodes[there] - first
        twice += np.where(here >= 0, a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], 0.0)
    turned = np.flatnonzero(twice < 0.0)
    if not len(turned):
        return faces
    used = faces[turned] >= 0
    columns = np.arange(faces.shape[1])
    back = np.where(used, used.sum(axis=1)[:, None] - 1 - columns, columns)
    faces = faces.copy()
    faces[turned] = np.take_along_axis(faces[turned], back, axis=1)
    return faces


def border_of(faces: Faces, count: int) -> NDArray[np.bool_]:
    """Mark sides, from each node to the next, that no other face has, (m, k); there are `count` nodes."""
    after, used = after_each(faces), faces >= 0
    keys = np.minimum(faces, after)[used].astype(np.int64) * count + np.maximum(faces, after)[used]
    order = np.argsort(keys)
    keys = keys[order]
    differ = np.concatenate([[True], keys[1:] != keys[:-1], [True]])
    border = np.zeros(faces.shape, np.bool_)
    where = np.flatnonzero(used.ravel())[order[differ[1:] & differ[:-1]]]
    border.reshape(-1)[where] = True
    return border


def touched_nodes(faces: Faces, chosen: NDArray[Any] | slice, count: int) -> NDArray[np.bool_]:
    """Mark which of `count` nodes the chosen faces have; a False follows for the number -1."""
    marks = np.zeros(count + 1, np.bool_)
    marks[faces[chosen]] = True
    marks[count] = False
    return marks


def touching_faces(faces: Faces, marks: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark faces that have marked nodes; `marks` are those of `touched_nodes`."""
    found = marks[faces[:, 0]]
    for column in faces.T[1:]:
        found |= marks[column]
    return found


@dataclass(frozen=True, eq=False)
class Patch:
    """Some faces of a mesh, with `count` nodes, renumbered in their old order."""

    faces: Faces
    count: int

    @classmethod
    def select(cls, faces: Faces, count: int) -> tuple["Patch", NDArray[np.int64]]:
        """Make a patch of faces of a mesh with `count` nodes; return it and the old numbers of its nodes."""
        marks = touched_nodes(faces, slice(None), count)
        old = np.flatnonzero(marks)
        numbers = np.full(count + 1, -1, np.int32)
        numbers[old] = np.arange(len(old))
        return cls(numbers[faces], len(old)), old

    @cached_property
    def pairs(self) -> tuple[NDArray[np.intp], NDArray[np.int32]]:
        """Face and node of each corner."""
        face, column = np.nonzero(self.faces >= 0)
        return face, self.faces[face, column]

    def on_nodes(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Average, at each node, the known values of the faces around it."""
        face, node = self.pairs
        return _mean(values, face, node, self.count)

    def on_faces(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Average, on each face, the known values at its nodes."""
        face, node = self.pairs
        return _mean(values, node, face, len(self.faces))

    def fans(self) -> tuple[NDArray[np.int64], NDArray[np.intp], NDArray[np.intp]]:
        """Triangles from the middle of each face to each of its sides, the face of each, and its column.

        The middles are numbered after the nodes. A triangle's corners are the middle, the node of the column, and the
        next node.
        """
        face, column = np.nonzero(self.faces >= 0)
        after = after_each(self.faces)
        corners = np.column_stack([self.count + face, self.faces[face, column], after[face, column]])
        return corners.astype(np.int64), face, column


def _mean(
    values: NDArray[np.float64], source: NDArray[np.integer], target: NDArray[np.integer], count: int
) -> NDArray[np.float64]:
    """Average, at each of `count` targets, the known values at its sources; NaN if there are none."""
    flat = values.reshape(len(values), math.prod(values.shape[1:]))
    known = np.isfinite(flat[source]).all(axis=1)
    source, target = source[known], target[known]
    times = np.bincount(target, minlength=count)
    sums = [np.bincount(target, flat[source, k], count) for k in range(flat.shape[1])]
    with np.errstate(invalid="ignore", divide="ignore"):
        found: NDArray[np.float64] = np.stack(sums, axis=1) / times[:, None]
    return found.reshape(count, *values.shape[1:])
