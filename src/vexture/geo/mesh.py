"""Depths on the faces or on the nodes of a UGRID mesh, and their contours and grids in a frame.

A mesh is contoured directly, not resampled to a raster first. Each face is divided into triangles around its middle,
and values are linear in each triangle. The middle has the value of the face, and a node the mean of the faces around.
"""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.errors import LimitError, SourceError, reason_of
from vexture.geo.contours import Ring, above_dry, fitted_drawing
from vexture.geo.crs import period, transformed
from vexture.geo.extent import Bounds, Frame
from vexture.geo.netcdf import crs_of, depths_of, listed, refuse_layers, time_axis, times_of
from vexture.geo.raster import grid_places, outside
from vexture.geo.series import Values, box_around
from vexture.geo.triangles import Outline, outlines_above

__all__ = ["MeshInFrame", "MeshSeries", "holds_mesh", "mesh_series"]

MOST_FACES: Final = 2_000_000

NEAR: Final = 1.5
"""Edges. Parts of the mesh's border this near to the frame's border, or beyond it, move outside the square."""

OUTSIDE: Final = 0.25
"""Unit-square units. How far outside the square they move, so that no fitted cubic reaches back in."""


@dataclass(frozen=True, slots=True, eq=False)
class MeshSeries:
    """An open file of depths on a mesh; `crs`, `variable`, `times` and `read` as in `Series`.

    `nodes` are places, (n, 2); `faces` are the numbers of the nodes of each face, (m, k), counter-clockwise, and -1
    where a face has fewer. Depths are on faces or on nodes.
    """

    nodes: NDArray[np.float64]
    faces: NDArray[np.int64]
    on_faces: bool
    crs: str | None
    variable: str
    times: tuple[datetime | None, ...]
    read: Callable[[int], tuple[Values, Values | None]]

    @property
    def box(self) -> Bounds:
        """West, south, east, north."""
        return box_around(self.nodes)


def holds_mesh(dataset: Any) -> bool:
    """Whether an open dataset has a mesh by the UGRID conventions."""
    return any(_is_mesh(dataset[name]) for name in dataset.variables)


def _is_mesh(variable: Any) -> bool:
    return bool(variable.attrs.get("cf_role") == "mesh_topology")


def mesh_series(dataset: Any, time_dim: str | None, variable: str | None) -> MeshSeries:
    """Depths on the mesh of an open dataset; errors as of `netcdf.series_of`."""
    grid = _grid(dataset)
    nodes = np.column_stack([grid.node_x, grid.node_y]).astype(np.float64)
    faces = np.asarray(grid.face_node_connectivity).astype(np.int64)
    if not np.isfinite(nodes).all() or faces.max(initial=-1) >= len(nodes) or not len(faces):
        raise SourceError("its mesh has no faces, or names nodes that do not exist; write it again")
    if len(faces) > MOST_FACES:
        raise LimitError(f"its mesh has {len(faces):,} faces; the limit is {MOST_FACES:,}; cut out a part of it")
    places = (grid.face_dimension, grid.node_dimension)
    candidates = [
        str(name)
        for name in dataset.data_vars
        if dataset[name].dtype.kind in "iuf"
        and any(place in dataset[name].dims for place in places)
        and not str(name).endswith(("_x", "_y", "_nodes", "_faces", "_links"))
        and "start_index" not in dataset[name].attrs
    ]
    name = depths_of(dataset, candidates, variable)[0]
    place = places[0] if places[0] in dataset[name].dims else places[1]
    # the bed must be where the depths are
    _, depth, bed = depths_of(dataset, [other for other in candidates if place in dataset[other].dims], name)
    time = time_axis(dataset, dataset[name].dims, time_dim)
    refuse_layers(dataset, name, (time, place))
    times = times_of(dataset, time)

    def read(step: int) -> tuple[Values, Values | None]:
        return depth({time: step}, (place,)), bed({time: step}, (place,)) if bed else None

    keys = dataset[grid.name].attrs.get("node_coordinates", "") if grid.name in dataset.variables else ""
    coordinates = [dataset[key] for key in str(keys).split() if key in dataset.variables]
    crs = crs_of(dataset, name, coordinates if len(coordinates) == 2 else [None, None])
    return MeshSeries(nodes, _counter_clockwise(nodes, faces), place == places[0], crs, name, times, read)


def _grid(dataset: Any) -> Any:
    """Mesh of a dataset, by xugrid."""
    import xugrid

    names = [
        str(name)
        for name in dataset.variables
        if _is_mesh(dataset[name]) and dataset[name].attrs.get("topology_dimension", 2) == 2
    ]
    if len(names) != 1:
        raise SourceError(f"it has {len(names)} meshes of faces ({listed(names)}); write a file with one")
    try:
        return xugrid.Ugrid2d.from_dataset(dataset, names[0])
    except Exception as error:  # xugrid raises any type of exception for an invalid mesh
        raise SourceError(f"its mesh {names[0]!r} cannot be read ({reason_of(error)}); write it again") from None


def _with_next(faces: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Node after each node of a face, and which entries are nodes."""
    count, columns = (faces >= 0).sum(axis=1)[:, None], np.arange(faces.shape[1])
    return np.take_along_axis(faces, np.where(columns + 1 < count, columns + 1, 0), axis=1), columns < count


def _counter_clockwise(nodes: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """Faces with their nodes in counter-clockwise order."""
    after, used = _with_next(faces)
    here, there = nodes[faces], nodes[after]
    twice = ((here[..., 0] * there[..., 1] - here[..., 1] * there[..., 0]) * used).sum(axis=1)
    columns = np.arange(faces.shape[1])
    back = np.where(used, used.sum(axis=1)[:, None] - 1 - columns, columns)
    return np.where((twice < 0.0)[:, None], np.take_along_axis(faces, back, axis=1), faces)


class MeshInFrame:
    """A series on a mesh that is placed in the unit square of a frame: its triangles and their contours."""

    def __init__(self, series: MeshSeries, system: str, frame: Frame) -> None:
        self._frame, self._on_faces, self.read = frame, series.on_faces, series.read
        self._face, column = np.nonzero(series.faces >= 0)
        self._node = series.faces[self._face, column]
        self._sizes = (len(series.faces), len(series.nodes))
        nodes = transformed(series.nodes, system, frame.crs)
        turn = period(frame.crs)
        if turn:
            middle = (frame.bounds[0] + frame.bounds[2]) / 2
            nodes = nodes + np.array([np.round((middle - np.median(nodes[:, 0])) / turn) * turn, 0.0])
        nodes = (nodes - frame.to_source[:, 2]) / frame.to_source[:, :2].diagonal()
        fans = self._fans(series.faces)
        self._points = np.concatenate([nodes, self._mean(nodes, self._node, self._face, len(series.faces))])
        inside = np.isfinite(self._points[fans]).all(axis=(1, 2))
        low, high = self._points[fans].min(axis=1), self._points[fans].max(axis=1)
        inside &= (high > -OUTSIDE).all(axis=1) & (low < 1.0 + OUTSIDE).all(axis=1)
        self._triangles = fans[inside]
        x0, y0, x1, y1 = frame.box
        seen = (high > (x0, y0)).all(axis=1) & (low < (x1, y1)).all(axis=1)
        if not (seen & inside).any():
            raise outside(frame, series.box, system)
        self._found = self._located()

    def _fans(self, faces: NDArray[np.int64]) -> NDArray[np.int64]:
        """Triangles from the middle of each face to each of its sides; the middles are numbered after the nodes."""
        after, used = _with_next(faces)
        middle = np.broadcast_to(self._sizes[1] + np.arange(len(faces))[:, None], faces.shape)
        fans: NDArray[np.int64] = np.stack([middle, faces, after], axis=-1)[used]
        return fans

    def _mean(
        self, values: NDArray[np.float64], source: NDArray[np.int64], target: NDArray[np.int64], count: int
    ) -> NDArray[np.float64]:
        """Mean, at each of `count` targets, of the known values at the sources beside it."""
        flat = values.reshape(len(values), -1)
        known = np.isfinite(flat[source]).all(axis=1)
        times = np.bincount(target[known], minlength=count)
        sums = [np.bincount(target[known], flat[source[known], k], count) for k in range(flat.shape[1])]
        with np.errstate(invalid="ignore", divide="ignore"):
            found: NDArray[np.float64] = np.stack(sums, axis=1) / times[:, None]
        return found.reshape(count, *values.shape[1:])

    def drawing(self, depth: Values, bed: Values | None, hmin: float) -> Drawing:
        """The area under water."""
        values = self._everywhere(self._shored(depth, bed, hmin))
        found = [one for one in outlines_above(self._points, self._triangles, values) if len(one.points) > 2]
        return fitted_drawing(_grouped([self._ring(outline) for outline in found]))

    def _shored(self, depth: Values, bed: Values | None, hmin: float) -> Values:
        """Depths less `hmin`, negative on dry faces or nodes beside wet ones; see `contours.shored`.

        Where the bed is known, from the mean water level around; else, and at walls, the shore is halfway.
        """
        known, above = above_dry(depth, hmin)
        wet = np.where(known & (above >= 0.0), above, np.nan)
        estimate = -self._around(wet)
        if bed is not None:
            reached = self._around(wet + bed) - bed
            estimate = np.where(reached < 0.0, reached, estimate)
        estimate = np.where(np.isfinite(estimate), np.minimum(estimate, -1e-6), -1.0)
        return np.where(known, above, estimate)

    def _around(self, values: Values) -> Values:
        """Mean of the values of faces that share nodes with each face, or of nodes that share faces."""
        here, there = (self._face, self._node) if self._on_faces else (self._node, self._face)
        faces, nodes = self._sizes
        own, other = (faces, nodes) if self._on_faces else (nodes, faces)
        return self._mean(self._mean(values, here, there, other), there, here, own)

    def _everywhere(self, values: Values) -> Values:
        """Values at all nodes and, after them, at the middles of all faces."""
        faces, nodes = self._sizes
        if self._on_faces:
            return np.concatenate([np.nan_to_num(self._mean(values, self._face, self._node, nodes), nan=-1.0), values])
        return np.concatenate([values, self._mean(values, self._node, self._face, faces)])

    def _ring(self, outline: Outline) -> Ring:
        """Ring of an outline; where the mesh's border is that of the frame, the ring extends outside the square."""
        points, near = outline.points.copy(), NEAR * outline.cell
        for axis in range(2):
            low, high = self._frame.box[axis], self._frame.box[2 + axis]
            points[outline.border & (outline.points[:, axis] <= low + near), axis] = -OUTSIDE
            points[outline.border & (outline.points[:, axis] >= high - near), axis] = 1.0 + OUTSIDE
        before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
        inner = ~outline.border
        ends = outline.border & (np.roll(inner, 1) | np.roll(inner, -1))
        a, b = points - before, after - points
        bent = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) > 1e-3 * np.hypot(*a.T) * np.hypot(*b.T)
        return Ring(points, outline.cell, ends | (outline.border & bent))

    def _located(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Samples of the frame's grid that lie in the mesh, and the triangle of each."""
        import shapely

        places, _ = grid_places(self._frame)
        tree = shapely.STRtree(shapely.polygons(self._points[self._triangles[:, [0, 1, 2, 0]]]))
        sample, triangle = tree.query(shapely.points(places), predicate="intersects")
        sample, first = np.unique(sample, return_index=True)
        return sample, triangle[first]

    def grid(self, values: Values) -> NDArray[np.float32]:
        """Values over the frame, the northernmost row first: of the face, or linear between nodes; NaN beyond."""
        places, shape = grid_places(self._frame)
        sample, triangle = self._found
        corners = self._triangles[triangle]
        out = np.full(len(places), np.nan)
        if self._on_faces:
            out[sample] = values[corners[:, 0] - self._sizes[1]]
        else:
            everywhere = self._everywhere(values)
            a, b, c = (self._points[corners[:, k]] for k in range(3))
            ab, ac, ap = b - a, c - a, places[sample] - a
            size = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
            size = np.where(size == 0.0, 1.0, size)
            v = (ap[:, 0] * ac[:, 1] - ap[:, 1] * ac[:, 0]) / size
            w = (ab[:, 0] * ap[:, 1] - ab[:, 1] * ap[:, 0]) / size
            shares = np.stack([1.0 - v - w, v, w], axis=1)
            out[sample] = (shares * everywhere[corners]).sum(axis=1)
        return out.reshape(shape).astype(np.float32)


def _grouped(rings: list[Ring]) -> list[list[Ring]]:
    """Rings by polygon: each counter-clockwise ring, and the holes in it."""
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
