"""Depths on the faces or on the nodes of a mesh: their contours and grids in a frame.

A mesh is contoured directly, not resampled to a raster first. Each face is divided into triangles around its middle, in
which values are linear. The middle has the value of the face, and a node the mean of the faces around it. Each step
processes only faces near a shore: of a million, some ten thousand.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture_geo.base.crs import period, transform_points
from vexture_geo.base.extent import Bounds, Frame
from vexture_geo.depth.contours import Ring, above_dry, fit_drawing
from vexture_geo.depth.mesh_topology import Faces, Patch, border_of, touched_nodes, touching_faces
from vexture_geo.depth.raster import grid_places, outside
from vexture_geo.depth.series import METRES, Meaning, Reading, Values, box_around
from vexture_geo.depth.triangles import LevelOutline, grid_ranges, locate_samples, outlines_above

NEAR: Final = 1.5
"""Edges. Parts of the mesh's border along the frame's border and this close to it move outside the square."""

ALONG: Final = 0.05
"""Slope above which the mesh's border leaves the frame's border; there the model ends, and it stays in place."""

ON: Final = 0.01
"""Edges. A part of the mesh's border this close to the frame's border lies on it."""

OUTSIDE: Final = 0.25
"""Unit-square units by which these parts move outside, so that no fitted cubic reaches back in."""


@dataclass(frozen=True, slots=True, eq=False)
class MeshSeries:
    """An open file of depths on a mesh; see `Series` for `crs`, `variable`, `times`, `read`, `meaning` and `unit`.

    `nodes` are places, (n, 2); `faces` are the numbers of the nodes of each face, (m, k), counter-clockwise, padded
    with -1. Depths are on faces or on nodes.
    """

    nodes: NDArray[np.float64]
    faces: Faces
    on_faces: bool
    crs: str | None
    variable: str
    times: tuple[datetime | None, ...]
    read: Callable[[int], Reading]
    meaning: Meaning = METRES
    unit: str = ""

    @property
    def box(self) -> Bounds:
        """West, south, east, north."""
        return box_around(self.nodes)


class MeshSamples(NamedTuple):
    """Samples of the frame's grid in the mesh; the face of each, and its triangle in a patch of those faces.

    `nodes` are the numbers of the patch's nodes, `corners` those of the triangle's corners in the patch, and `shares`
    the weights of the corners.
    """

    samples: NDArray[np.int64]
    faces: NDArray[np.intp]
    patch: Patch
    nodes: NDArray[np.intp]
    corners: NDArray[np.int64]
    shares: NDArray[np.float64]


class MeshInFrame:
    """A mesh series in the unit square of a frame: the faces near it, and their contours."""

    def __init__(self, series: MeshSeries, system: str, frame: Frame) -> None:
        self._frame, self._on_faces, self._series = frame, series.on_faces, series
        nodes = _in_square(series.nodes, system, frame)
        low, high = _boxes(nodes, series.faces)
        near = (high > -OUTSIDE).all(axis=1) & (low < 1.0 + OUTSIDE).all(axis=1)
        x0, y0, x1, y1 = frame.box
        if not (near & (high > (x0, y0)).all(axis=1) & (low < (x1, y1)).all(axis=1)).any():
            raise outside(frame, series.box, system)
        kept = np.flatnonzero(near)
        self._patch, numbers = Patch.select(series.faces[kept], len(nodes))
        self._nodes = nodes[numbers]
        self._chosen = kept if series.on_faces else numbers
        self._border = border_of(self._patch.faces, self._patch.count)
        self._sampled = self._locate_samples(low[kept], high[kept])

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_series": None}  # a copy in another process reads nothing

    def read(self, step: int) -> Reading:
        """Read a step of the faces or nodes near the square."""
        return self._series.read(step).at(self._chosen)

    def drawings(self, depth: Values, bed: Values | None, hmin: float, depths: Sequence[float]) -> list[Drawing]:
        """Draw the area under water, and the areas with at least each depth."""
        known, above = above_dry(depth, hmin)
        more = [least - hmin for least in (hmin, *depths)]
        crossed = [self._crossed_faces(known & (above > least)) for least in more]
        around = self._around_faces(np.logical_or.reduce(crossed))
        part, numbers = Patch.select(self._patch.faces[around], self._patch.count)
        chosen = around if self._on_faces else numbers
        shored = self._shore_values(part, depth[chosen], None if bed is None else bed[chosen], hmin)
        values = self._everywhere(part, shored)
        fans = part.fans()
        points = np.concatenate([self._nodes[numbers], part.on_faces(self._nodes[numbers])])
        border = self._border[around]
        return [
            self._outline_drawing(points, values - least, fans, border, inner[around])
            for least, inner in zip(more, crossed, strict=True)
        ]

    def _outline_drawing(
        self,
        points: NDArray[np.float64],
        values: Values,
        fans: tuple[NDArray[np.int64], NDArray[np.intp], NDArray[np.intp]],
        border: NDArray[np.bool_],
        crossed: NDArray[np.bool_],
    ) -> Drawing:
        """Draw the area where values at points are above 0, within the faces of a patch that its outline can cross."""
        corners, face, column = fans
        inner = crossed[face]
        sides = np.zeros((int(inner.sum()), 3), np.bool_)
        sides[:, 1] = border[face[inner], column[inner]]
        found = outlines_above(points, corners[inner], values, sides)
        return fit_drawing(_group_rings([self._ring(outline) for outline in found if len(outline.points) > 2]))

    def heights(self, values: Values) -> NDArray[np.float32]:
        """Resample heights like `grid`, which is linear in each triangle."""
        return self.grid(values)

    def _crossed_faces(self, wet: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Mark faces that an outline of the water can cross or follow."""
        faces, count = self._patch.faces, self._patch.count
        if self._on_faces:
            crossed = touching_faces(faces, touched_nodes(faces, wet, count) & touched_nodes(faces, ~wet, count))
        else:
            crossed = touching_faces(faces, np.append(wet, False)) & touching_faces(faces, np.append(~wet, False))
        return crossed | self._border.any(axis=1)

    def _around_faces(self, crossed: NDArray[np.bool_]) -> NDArray[np.intp]:
        """Numbers of all faces on whose values the `crossed` faces depend."""
        faces, count = self._patch.faces, self._patch.count
        around = touching_faces(faces, touched_nodes(faces, crossed, count))
        if self._on_faces:  # values at nodes need the faces around; those of dry faces need the faces around these
            around = touching_faces(faces, touched_nodes(faces, around, count))
        return np.flatnonzero(around)

    def _shore_values(self, part: Patch, depth: Values, bed: Values | None, hmin: float) -> Values:
        """Depths minus `hmin`, negative on dry faces or nodes beside wet ones; see `contours.shore_values`.

        Where the bed is known, the mean water level around is used; elsewhere, and at walls, the shore is halfway.
        """
        known, above = above_dry(depth, hmin)
        wet = np.where(known & (above >= 0.0), above, np.nan)
        estimate = -self._around(part, wet)
        if bed is not None:
            reached = self._around(part, wet + bed) - bed
            estimate = np.where(reached < 0.0, reached, estimate)
        estimate = np.where(np.isfinite(estimate), np.minimum(estimate, -1e-6), -1.0)
        return np.where(known, above, estimate)

    def _around(self, part: Patch, values: Values) -> Values:
        """Average the values of faces that share nodes with each face, or of nodes that share faces."""
        return part.on_faces(part.on_nodes(values)) if self._on_faces else part.on_nodes(part.on_faces(values))

    def _everywhere(self, part: Patch, values: Values) -> Values:
        """Compute values at all nodes, followed by those at the middles of all faces."""
        if self._on_faces:
            return np.concatenate([np.nan_to_num(part.on_nodes(values), nan=-1.0), values])
        return np.concatenate([values, part.on_faces(values)])

    def _ring(self, outline: LevelOutline) -> Ring:
        """Make the ring of an outline; where the mesh ends at the frame's border, it extends outside the square."""
        points = outline.points.copy()
        for axis in range(2):
            along = outline.points[:, 1 - axis]
            from_low = (outline.points[:, axis] - self._frame.box[axis]) / outline.cell
            from_high = (self._frame.box[2 + axis] - outline.points[:, axis]) / outline.cell
            points[_beside(from_low, along / outline.cell, outline.border), axis] = -OUTSIDE
            points[_beside(from_high, along / outline.cell, outline.border), axis] = 1.0 + OUTSIDE
        before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
        inner = ~outline.border
        ends = outline.border & (np.roll(inner, 1) | np.roll(inner, -1))
        a, b = points - before, after - points
        bent = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) > 1e-3 * np.hypot(*a.T) * np.hypot(*b.T)
        return Ring(points, outline.cell, ends | (outline.border & bent))

    def _locate_samples(self, low: NDArray[np.float64], high: NDArray[np.float64]) -> MeshSamples:
        """Locate samples of the frame's grid in the mesh, whose faces have boxes from `low` to `high`."""
        places, (_, columns) = grid_places(self._frame)
        x, y = places[:columns, 0], places[::columns, 1]
        first, last = grid_ranges(low, high, x, y)
        some = np.flatnonzero((last >= first).all(axis=1))
        part, numbers = Patch.select(self._patch.faces[some], self._patch.count)
        corners, face, _ = part.fans()
        points = np.concatenate([self._nodes[numbers], part.on_faces(self._nodes[numbers])])
        samples, triangle, shares = locate_samples(points[corners], x, y)
        return MeshSamples(samples, some[face[triangle]], part, numbers, corners[triangle], shares)

    def grid(self, values: Values) -> NDArray[np.float32]:
        """Resample values over the frame, the northernmost row first: per face, or linear between nodes; NaN beyond."""
        places, shape = grid_places(self._frame)
        out = np.full(len(places), np.nan, np.float32)
        found = self._sampled
        if self._on_faces:
            out[found.samples] = values[found.faces]
        else:
            everywhere = self._everywhere(found.patch, values[found.nodes])
            out[found.samples] = (found.shares * everywhere[found.corners]).sum(axis=1)
        return out.reshape(shape)


def _in_square(places: NDArray[np.float64], system: str, frame: Frame) -> NDArray[np.float64]:
    """Transform places, (n, 2), to the unit square of a frame."""
    nodes = transform_points(places, system, frame.crs)
    turn = period(frame.crs)
    if turn:
        middle = (frame.bounds[0] + frame.bounds[2]) / 2
        nodes = nodes + np.array([np.round((middle - np.median(nodes[:, 0])) / turn) * turn, 0.0])
    unit: NDArray[np.float64] = (nodes - frame.to_source[:, 2]) / frame.to_source[:, :2].diagonal()
    return unit


def _boxes(nodes: NDArray[np.float64], faces: Faces) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lower and upper corners of boxes around faces, (m, 2); NaN where a node has no place."""
    low = nodes[faces[:, 0]]
    high = low.copy()
    for column in faces.T[1:]:
        place = nodes[np.where(column >= 0, column, faces[:, 0])]
        np.minimum(low, place, out=low)
        np.maximum(high, place, out=high)
    unknown = ~np.isfinite(high).all(axis=1)
    low[unknown] = high[unknown] = np.nan
    return low, high


def _beside(across: NDArray[np.float64], along: NDArray[np.float64], border: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark points of a ring where the mesh's border runs beside one side of the frame.

    `across` is their distance inside the frame, in edges, and `along` their place along that side.
    """
    on = border & (across <= ON)
    beside = on & (np.roll(on, 1) | np.roll(on, -1))
    near = border & (across <= NEAR)
    if near.all():
        return near
    turned = np.roll(np.arange(len(near)), -int(np.argmin(near)))  # start off the side, so that no run is cut in two
    steps = np.diff(near[turned].astype(np.int8), append=np.int8(0))
    for first, last in zip(np.flatnonzero(steps == 1) + 1, np.flatnonzero(steps == -1) + 1, strict=True):
        run = turned[first:last]
        before, after = np.array_split(run, 2)
        if len(after):  # medians of both halves, as the ends of a run may be the corners of the mesh
            rise = np.median(across[after]) - np.median(across[before])
            beside[run] |= abs(rise) <= ALONG * abs(np.median(along[after]) - np.median(along[before]))
    return beside


def _group_rings(rings: list[Ring]) -> list[list[Ring]]:
    """Group rings by polygon: each counter-clockwise ring, and the holes in it."""
    import shapely

    areas = [_area(ring.points) for ring in rings]
    outer = [k for k, area in enumerate(areas) if area > 0.0]
    holes = [k for k, area in enumerate(areas) if area < 0.0]
    groups = {k: [rings[k]] for k in outer}
    tree = shapely.STRtree([shapely.Polygon(rings[k].points) for k in outer])
    for k in holes:
        around = [outer[place] for place in tree.query(shapely.Point(rings[k].points[0]), predicate="intersects")]
        if around:
            groups[min(around, key=areas.__getitem__)].append(rings[k])
    return list(groups.values())


def _area(points: NDArray[np.float64]) -> float:
    after = np.roll(points, -1, axis=0)
    return float((points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0]).sum()) / 2.0
