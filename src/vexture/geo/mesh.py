"""Depths on a UGRID mesh: on its faces or on its nodes.

A mesh is contoured as it is, not by way of a raster: between its nodes, values are linear in each triangle. Faces
are cut into triangles around their middle, which has the face's value; their nodes have the mean of the faces around.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.errors import LimitError, SourceError
from vexture.geo.contours import THIN, Ring, fitted_drawing
from vexture.geo.frame import Frame
from vexture.geo.netcdf import check_dimension, crs_of, depths_of, line_of, listed, time_axis, times_of
from vexture.geo.placing import frame_places
from vexture.geo.reference import period, shown_bounds, transformed
from vexture.geo.series import Reading, Values, plausible
from vexture.geo.triangles import Outline, outlines_above

__all__ = ["MeshSeries", "holds_mesh", "mesh_series", "mesh_steps"]

MOST_FACES: Final = 2_000_000

NEAR: Final = 1.5
"""Edges. What of the mesh's border is so near to the frame's, or beyond, goes on to the border of the unit square."""

OUTSIDE: Final = 0.25
"""Unit-square units. How far beyond the square it is put: farther than cubics reach in."""


@dataclass(frozen=True, slots=True, eq=False)
class MeshSeries:
    """A file of depths on a mesh that is open.

    Parameters
    ----------
    nodes : (n, 2) float64 array
        Where they are.
    faces : (m, k) int array
        Nodes of each face, turning left; -1 where it has fewer.
    on_faces : bool
        Whether depths are on faces rather than on nodes.
    crs, variable, times
        As of `Series`.
    read : function
        Depth and, if the file has it, height of the bed at a step.
    """

    nodes: NDArray[np.float64]
    faces: NDArray[np.int64]
    on_faces: bool
    crs: str | None
    variable: str
    times: tuple[datetime | None, ...]
    read: Callable[[int], tuple[Values, Values | None]]

    @property
    def box(self) -> tuple[float, float, float, float]:
        """West, south, east, north."""
        low, high = self.nodes.min(axis=0), self.nodes.max(axis=0)
        return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))


def holds_mesh(dataset: Any) -> bool:
    """Whether an open dataset has a mesh by the UGRID conventions."""
    return any(dataset[name].attrs.get("cf_role") == "mesh_topology" for name in dataset.variables)


def mesh_series(dataset: Any, time_dim: str | None, variable: str | None) -> MeshSeries:
    """Depths on the mesh of an open dataset.

    Raises
    ------
    SourceError, LimitError
        If there are none, or more than one.
    """
    check_dimension(dataset, time_dim)
    grid = _grid(dataset)
    nodes = np.column_stack([grid.node_x, grid.node_y]).astype(np.float64)
    faces = np.asarray(grid.face_node_connectivity).astype(np.int64)
    if not np.isfinite(nodes).all() or faces.max(initial=-1) >= len(nodes) or not len(faces):
        raise SourceError("its mesh has no faces, or nodes that are not there; write it again")
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
    extra = [dim for dim in dataset[name].dims if dim not in (time, place) and dataset.sizes[dim] > 1]
    if extra:
        raise SourceError(
            f"variable {name!r} also has the dimension {listed(extra)} ({dataset.sizes[extra[0]]} long); "
            "write a file with one layer, or name another `variable`"
        )
    times = times_of(dataset, time) if time is not None else (None,)

    def read(step: int) -> tuple[Values, Values | None]:
        return depth({time: step}, (place,)), bed({time: step}, (place,)) if bed else None

    coordinates = [dataset[key] for key in _coordinates(dataset, grid) if key in dataset.variables]
    crs = crs_of(dataset, name, coordinates if len(coordinates) == 2 else [None, None])
    return MeshSeries(nodes, _turned_left(nodes, faces), place == places[0], crs, name, times, read)


def _grid(dataset: Any) -> Any:
    """Mesh of a dataset, by xugrid."""
    import xugrid

    names = [
        str(name)
        for name in dataset.variables
        if dataset[name].attrs.get("cf_role") == "mesh_topology"
        and dataset[name].attrs.get("topology_dimension", 2) == 2
    ]
    if len(names) != 1:
        raise SourceError(f"it has {len(names)} meshes of faces ({listed(names)}); write a file with one")
    try:
        return xugrid.Ugrid2d.from_dataset(dataset, names[0])
    except Exception as error:  # of a stranger's mesh the library raises what it likes
        raise SourceError(f"its mesh {names[0]!r} cannot be read ({line_of(error)}); write it again") from None


def _coordinates(dataset: Any, grid: Any) -> list[str]:
    return str(dataset[grid.name].attrs.get("node_coordinates", "")).split() if grid.name in dataset.variables else []


def _turned_left(nodes: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """Faces with their nodes in the order that turns left."""
    count = (faces >= 0).sum(axis=1)
    columns = np.arange(faces.shape[1])
    after = np.where(columns + 1 < count[:, None], columns + 1, 0)
    here, there = nodes[faces], nodes[np.take_along_axis(faces, after, axis=1)]
    twice = ((here[..., 0] * there[..., 1] - here[..., 1] * there[..., 0]) * (columns < count[:, None])).sum(axis=1)
    back = np.where(columns < count[:, None], count[:, None] - 1 - columns, columns)
    return np.where((twice < 0.0)[:, None], np.take_along_axis(faces, back, axis=1), faces)


def mesh_steps(series: MeshSeries, system: str, frame: Frame, hmin: float) -> Iterator[Reading]:
    """Read the steps of a series into a frame."""
    sheet = Sheet(series, system, frame)
    for step in range(len(series.times)):
        read, ground = series.read(step)
        depth, bed = plausible(read), None if ground is None else plausible(ground)
        above = sheet.shored(depth, hmin, bed)
        drawing = sheet.drawing(sheet.spread(above))
        grid = sheet.grid(np.where(depth < 0.0, 0.0, depth))
        known = bool(np.isfinite(depth).any())
        yield Reading(drawing, grid, None if bed is None else sheet.grid(bed), known)


class Sheet:
    """Triangles of a mesh in the unit square of a frame.

    Parameters
    ----------
    series : MeshSeries
    system : str
        Its reference system.
    frame : Frame

    Raises
    ------
    SourceError
        If none of it is in the frame.
    """

    def __init__(self, series: MeshSeries, system: str, frame: Frame) -> None:
        self._frame, self._on_faces = frame, series.on_faces
        count = len(series.nodes)
        self._face, column = np.nonzero(series.faces >= 0)
        self._node = series.faces[self._face, column]
        self._sizes = (len(series.faces), count)
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
            raise SourceError(
                f"nothing of it is within the bounds {shown_bounds(frame.bounds, frame.crs)}: "
                f"it covers {shown_bounds(series.box, system)}; give other `bounds`"
            )
        self._found = self._located()

    def _fans(self, faces: NDArray[np.int64]) -> NDArray[np.int64]:
        """Triangles from the middle of each face to each of its sides; the middles are numbered after the nodes."""
        count = (faces >= 0).sum(axis=1)
        columns = np.arange(faces.shape[1])
        after = np.take_along_axis(faces, np.where(columns + 1 < count[:, None], columns + 1, 0), axis=1)
        middle = np.broadcast_to(self._sizes[1] + np.arange(len(faces))[:, None], faces.shape)
        fans: NDArray[np.int64] = np.stack([middle, faces, after], axis=-1)[columns < count[:, None]]
        return fans

    def _mean(
        self, values: NDArray[np.float64], source: NDArray[np.int64], target: NDArray[np.int64], count: int
    ) -> NDArray[np.float64]:
        """Mean, at each of `count` targets, of the values at the sources beside it that have one."""
        flat = values.reshape(len(values), -1)
        known = np.isfinite(flat[source]).all(axis=1)
        times = np.bincount(target[known], minlength=count)
        sums = [np.bincount(target[known], flat[source[known], k], count) for k in range(flat.shape[1])]
        with np.errstate(invalid="ignore", divide="ignore"):
            found: NDArray[np.float64] = np.stack(sums, axis=1) / times[:, None]
        return found.reshape(count, *values.shape[1:])

    def shored(self, depth: Values, hmin: float, bed: Values | None) -> Values:
        """Depths less `hmin` that go on below 0 on dry faces or nodes beside wet ones, as of `contours.shored`.

        Where the bed is known, by the mean water level around; else, and at walls, halfway.
        """
        with np.errstate(invalid="ignore"):
            known = np.isfinite(depth) & ((depth > THIN * hmin) | (depth < 0.0))
        above = np.where(known, depth, 0.0) - hmin
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

    def spread(self, values: Values) -> Values:
        """Values at all nodes and, after them, at the middles of all faces."""
        faces, nodes = self._sizes
        if self._on_faces:
            return np.concatenate([np.nan_to_num(self._mean(values, self._face, self._node, nodes), nan=-1.0), values])
        return np.concatenate([values, self._mean(values, self._node, self._face, faces)])

    def drawing(self, values: Values) -> Drawing:
        """Where values, as `spread` gives them, are above 0."""
        return fitted_drawing(_grouped([self._ring(found) for found in self._outlines(values)]))

    def _outlines(self, values: Values) -> list[Outline]:
        return [found for found in outlines_above(self._points, self._triangles, values) if len(found.points) > 2]

    def _ring(self, outline: Outline) -> Ring:
        """Ring of an outline; its part on the mesh's border goes on beyond the square where the frame ends there."""
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
        """Which samples of a grid over the frame are in which triangles."""
        import shapely

        places, _ = frame_places(self._frame)
        tree = shapely.STRtree(shapely.polygons(self._points[self._triangles[:, [0, 1, 2, 0]]]))
        sample, triangle = tree.query(shapely.points(places), predicate="intersects")
        sample, first = np.unique(sample, return_index=True)
        return sample, triangle[first]

    def grid(self, values: Values) -> NDArray[np.float32]:
        """Values over the frame, the northernmost row first: the face's, or linear between nodes; NaN beyond."""
        places, shape = frame_places(self._frame)
        sample, triangle = self._found
        corners = self._triangles[triangle]
        out = np.full(len(places), np.nan)
        if self._on_faces:
            out[sample] = values[corners[:, 0] - self._sizes[1]]
        else:
            everywhere = self.spread(values)
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
    """Rings by polygon: each that turns left, and the holes that are in it."""
    import shapely

    areas = [_area(ring.points) for ring in rings]
    outer = [k for k, area in enumerate(areas) if area > 0.0]
    holes = [k for k, area in enumerate(areas) if area < 0.0]
    groups = {k: [rings[k]] for k in outer}
    if outer and holes:
        tree = shapely.STRtree([shapely.Polygon(rings[k].points) for k in outer])
        hole, place = tree.query(shapely.points([rings[k].points[0] for k in holes]), predicate="intersects")
        for number, k in enumerate(holes):
            around = [outer[p] for p in place[hole == number]]
            if around:
                groups[min(around, key=areas.__getitem__)].append(rings[k])
    return list(groups.values())


def _area(points: NDArray[np.float64]) -> float:
    after = np.roll(points, -1, axis=0)
    return float((points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0]).sum()) / 2.0
