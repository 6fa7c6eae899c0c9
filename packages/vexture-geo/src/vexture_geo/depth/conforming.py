"""Make the faces of a mesh share nodes: merge nodes at one place, and split sides at hanging nodes.

Quadtrees of SFINCS and discontinuous Galerkin methods give each face its own nodes. Beside smaller faces, a side of a
quadtree has a hanging node in its middle. Both would look like borders, where water ends.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture_geo.depth.mesh_topology import Faces, after_each, border_of

MOST_CORNERS: Final = 64
"""Most nodes of a face, to limit memory: tables of nodes have as many columns as the largest face has nodes."""

SAME: Final = 1e-3
"""Fraction of a short side within which nodes are at one place, because files round coordinates."""

SHORT: Final = 0.01
"""Quantile of the lengths of sides that counts as short; the shortest side may be an error."""

DEEPEST: Final = 4
"""Most times that a side is halved; once is usual, because quadtrees are balanced."""

FINEST: Final = 2.0**-40
"""Fraction of the extent within which nodes are at one place, however short sides are: the resolution of 64 bits."""

Places = NDArray[np.float64]


class Conforming(NamedTuple):
    """Nodes, (n, 2), faces as in `vexture_geo.depth.mesh.MeshSeries`, and the new number of each old node.

    `numbers` is None if nothing has changed, and -1 for a node that no face has.
    """

    nodes: Places
    faces: Faces
    numbers: NDArray[np.int64] | None

    def values(self, old: Places) -> Places:
        """Average the known values of the nodes at each place."""
        if self.numbers is None:
            return old
        known = np.isfinite(old) & (self.numbers >= 0)
        count = len(self.nodes)
        with np.errstate(invalid="ignore"):
            sums = np.bincount(self.numbers[known], old[known], count)
            return np.asarray(sums / np.bincount(self.numbers[known], minlength=count))


@np.errstate(all="ignore")  # extremely distant places are refused later
def conforming(nodes: Places, faces: Faces) -> Conforming:
    """Make faces share nodes at one place, and add nodes in the middle of their sides as corners.

    Examples
    --------
    >>> unit = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> whole, lower, upper = 2.0 * unit, unit + (2.0, 0.0), unit + (2.0, 1.0)
    >>> nodes = np.concatenate([whole, lower, upper])
    >>> mesh = conforming(nodes, np.arange(12, dtype=np.int32).reshape(3, 4))
    >>> len(mesh.nodes), mesh.faces[0]
    (8, array([0, 1, 6, 2, 3], dtype=int32))
    """
    whole = _without_repeats(faces)
    start, end = _border_sides(whole, len(nodes))
    lengths = np.hypot(*(nodes[end] - nodes[start]).T)
    lengths = lengths[lengths > 0.0]
    first = np.arange(len(nodes))
    if len(lengths):
        near = _nearness(nodes, float(np.quantile(lengths, SHORT)))
        some = np.unique(np.concatenate([start, end]))
        first[some] = some[_alike(nodes[some], near)]
        if (first[some] < some).any():
            whole = _without_repeats(np.where(whole >= 0, first[whole], -1).astype(np.int32))
        whole = _divide_faces(nodes, whole, near)
    if whole is faces:
        return Conforming(nodes, faces, None)
    used = np.unique(whole[whole >= 0])
    numbers = np.full(len(nodes) + 1, -1)
    numbers[used] = np.arange(len(used))
    return Conforming(nodes[used], numbers[whole].astype(np.int32), numbers[first])


def _nearness(nodes: Places, side: float) -> float:
    """Return the largest distance between nodes at one place, by the length of short sides.

    Models that calculate in 32 bits but write 64 round coordinates to half a metre where y is 5,000 km.
    """
    with np.errstate(over="ignore"):
        is_single = bool((nodes.astype(np.float32) == nodes).all())
    rounded = float(np.finfo(np.float32).eps * np.abs(nodes).max()) if is_single else 0.0
    return max(SAME * side, min(rounded, side / 4.0), FINEST * float(np.ptp(nodes, axis=0).max()))


def _border_sides(faces: Faces, count: int) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the start and end nodes of sides that only one face has."""
    border = border_of(faces, count)
    return faces[border], after_each(faces)[border]


def _alike(points: Places, near: float) -> NDArray[np.intp]:
    """Choose the same representative for all points at one place.

    Points are assigned to square cells twice as wide as the tolerance. In one of four such grids, half a cell apart,
    points at one place share a cell. All other points are much farther away.
    """
    _, one, place = np.unique(points[:, 0] + 1j * points[:, 1], return_index=True, return_inverse=True)
    kept, rank = np.sort(one), np.argsort(np.argsort(one))  # merge equal points first, which are most common
    first = np.arange(len(kept))
    cells = (points[kept] - points.min(axis=0)) / (2.0 * near)
    for x in (0.0, 0.5):
        for y in (0.0, 0.5):
            check_time()
            at = np.floor(cells + np.array([x, y]))
            _, leader, cell = np.unique(at[:, 0] + 1j * at[:, 1], return_index=True, return_inverse=True)
            first = first[leader][cell]
    return np.asarray(kept[first][rank[place]])


def _divide_faces(nodes: Places, faces: Faces, near: float) -> Faces:
    """Add the nodes in the middle of sides, and of halves of these, as corners of faces."""
    for _ in range(DEEPEST):
        check_time()
        halved = _split_sides(nodes, faces, near)
        if halved is faces:
            break
        faces = halved
    return faces


def _split_sides(nodes: Places, faces: Faces, near: float) -> Faces:
    """Add nodes in the middle of sides as corners; return the same faces if there are none, or too many for a face."""
    border = border_of(faces, len(nodes))
    if not border.any():  # faces cover one another
        return faces
    start, end = faces[border], after_each(faces)[border]
    ends = np.unique(start)
    same = _alike(np.concatenate([nodes[ends], (nodes[start] + nodes[end]) / 2.0]), near)[len(ends) :]
    amid = np.full(faces.shape, -1, np.int32)
    found = ends[np.minimum(same, len(ends) - 1)]
    amid[border] = np.where((same < len(ends)) & (found != start) & (found != end), found, -1)
    rows = np.flatnonzero((amid >= 0).any(axis=1))
    if not len(rows):
        return faces
    wider = _pack_faces(np.stack([faces[rows], amid[rows]], axis=2).reshape(len(rows), -1))
    columns = max(faces.shape[1], wider.shape[1])
    if columns > MOST_CORNERS:
        return faces
    whole = np.full((len(faces), columns), -1, np.int32)
    whole[:, : faces.shape[1]] = faces
    whole[rows, : wider.shape[1]] = wider
    return whole


def _without_repeats(faces: Faces) -> Faces:
    """Remove corners that equal the next corner; return the same faces if there are none."""
    again = (faces >= 0) & (faces == after_each(faces))
    again[~((faces >= 0) & ~again).any(axis=1), 0] = False  # keep one corner of a face whose corners are all equal
    return _pack_faces(np.where(again, -1, faces)) if again.any() else faces


def _pack_faces(faces: Faces) -> Faces:
    """Move nodes to the start of each row, and drop columns that no face uses."""
    order = np.argsort(faces < 0, axis=1, kind="stable")
    most = int((faces >= 0).sum(axis=1).max())
    return np.take_along_axis(faces, order, axis=1)[:, :most]
