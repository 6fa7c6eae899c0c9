"""Find borders that polygons share, byte-identically, and their lengths."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Corners(NamedTuple):
    """Rings of polygons as lists of corners; none repeats its first corner."""

    points: NDArray[np.float64]  # (m, 2), each once, sorted
    ids: NDArray[np.intp]  # (n,): the corner at each place of the rings, one ring after another
    starts: NDArray[np.intp]  # (r,): the first place of each ring
    polygon: NDArray[np.intp]  # (r,): the polygon of each ring

    @property
    def lengths(self) -> NDArray[np.intp]:
        """Number of corners of each ring."""
        return np.diff(np.append(self.starts, len(self.ids)))

    @property
    def after(self) -> NDArray[np.intp]:
        """The corner after each place, around its ring."""
        following = np.arange(1, len(self.ids) + 1)
        following[self.starts + self.lengths - 1] = self.starts
        return self.ids[following]

    @property
    def sides(self) -> NDArray[np.int64]:
        """Number of the side after each place, the same in both directions."""
        after = self.after
        return np.minimum(self.ids, after) * len(self.points) + np.maximum(self.ids, after)


def corners_of(shapes: NDArray[Any]) -> Corners:
    """Collect the corners of shapely polygons."""
    import shapely

    rings, polygon = shapely.get_rings(shapes, return_index=True)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    last = np.diff(ring, append=-1) != 0
    points, ring = points[~last], ring[~last]
    places = np.ascontiguousarray(points + 0.0).view(np.complex128).ravel()  # without -0.0
    unique, ids = np.unique(places, return_inverse=True)
    return Corners(unique.view(np.float64).reshape(-1, 2), ids, np.flatnonzero(np.diff(ring, prepend=-1)), polygon)


def shared_lengths(shapes: NDArray[Any]) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
    """Find the sides that two polygons share: one polygon, the other, and the side's length, in both directions."""
    corners = corners_of(shapes)
    sides = corners.sides
    order = np.argsort(sides, kind="stable")
    owner = np.repeat(corners.polygon, corners.lengths)[order]
    sides = sides[order]
    same = np.flatnonzero((sides[1:] == sides[:-1]) & (owner[1:] != owner[:-1]))
    first, last = np.divmod(sides[same], len(corners.points))
    length = np.hypot(*(corners.points[last] - corners.points[first]).T)
    one, other = owner[same], owner[same + 1]
    return np.concatenate([one, other]), np.concatenate([other, one]), np.concatenate([length, length])
