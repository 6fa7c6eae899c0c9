"""Read depths on a UGRID mesh of a NetCDF file: from D-Flow FM, ADCIRC, SCHISM, or quadtrees of SFINCS."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError, SourceError, reason_of
from vexture.base.notes import Notes
from vexture_geo.base.longitudes import narrower
from vexture_geo.depth.conforming import MOST_CORNERS, conforming
from vexture_geo.depth.mesh import MeshSeries
from vexture_geo.depth.mesh_topology import Faces, counter_clockwise
from vexture_geo.depth.netcdf import crs_of, points_east, times_of
from vexture_geo.depth.series import Reading
from vexture_geo.depth.speeds import speed_of
from vexture_geo.depth.variables import (
    depths_of,
    has_depths,
    list_names,
    load_values,
    reader_of,
    refuse_layers,
    time_axis,
    unit_of,
)

MOST_FACES: Final = 10_000_000
"""Most faces; reading needs about 0.3 GB for a million."""

DRY: Final = {"dryflagnode", "dryflagelement", "wetdry_node", "wetdry_elem"}
"""Variables of SCHISM, in lower case, that are 1 where there is no water, whatever its level."""

TURN: Final = 360.0

FAMILIAR: Final = 90.0
"""Degrees. Places not stated to be in degrees must span less than this to be moved by a turn."""

MIXING: Final = np.uint64(0x9E3779B97F4A7C15)
"""Factor that makes numbers of nodes differ in all bits, for a hash."""


def holds_mesh(dataset: Any) -> bool:
    """Return whether an open dataset has a UGRID mesh."""
    return any(_is_mesh(dataset[name]) for name in dataset.variables)


def _is_mesh(variable: Any) -> bool:
    return "mesh_topology" in (variable.attrs.get("cf_role"), variable.attrs.get("standard_name"))


def name_of_mesh(dataset: Any) -> str:
    """Return the name of the only mesh of faces."""
    names = [
        str(name)
        for name in dataset.variables
        if _is_mesh(dataset[name]) and dataset[name].attrs.get("topology_dimension", 2) == 2
    ]
    if len(names) != 1:
        raise SourceError(f"it has {len(names)} meshes of faces ({list_names(names)}); write a file with one")
    return names[0]


def mesh_series(dataset: Any, time_dim: str | None, variable: str | None, notes: Notes) -> MeshSeries:
    """Read depths on the mesh of an open dataset; see `netcdf.series_of` for errors."""
    mesh = name_of_mesh(dataset)
    try:
        axes, connections, places = _parts(dataset, mesh)
        nodes = np.column_stack([load_values(axis) for axis in axes]).astype(np.float64)
        faces = _faces(connections, len(nodes))
    except (SourceError, LimitError):
        raise
    except Exception as error:  # an invalid mesh can be anything
        raise SourceError(f"its mesh {mesh!r} cannot be read ({reason_of(error)}); write it again") from None
    if not len(faces) or not np.isfinite(nodes).all() or faces[:, 0].min() < 0 or faces.max() >= len(nodes):
        raise SourceError("its mesh has no faces, or names nodes that do not exist; write it again")
    units = unit_of(axes[0])
    nodes, kept = faces_unwrapped(nodes, faces, are_degrees="degree" in units.lower(), notes=notes)
    kept = _select_faces(kept, faces_once(faces if kept is None else faces[kept], notes))
    whole = conforming(nodes, faces if kept is None else faces[kept])
    candidates = [
        str(name)
        for name in dataset.data_vars
        if dataset[name].dtype.kind in "iuf"
        and any(place in dataset[name].dims for place in places)
        and not str(name).endswith(("_x", "_y", "_nodes", "_faces", "_links", "_domain", "_globalnr"))
        and "start_index" not in dataset[name].attrs
    ]
    # the bed must have the places of the depths
    here = {place: [name for name in candidates if place in dataset[name].dims] for place in places}
    on = [place for place in places if has_depths(dataset, here[place])]
    name = depths_of(dataset, here[on[0]] if len(on) == 1 and variable is None else candidates, variable, notes).name
    place = places[0] if places[0] in dataset[name].dims else places[1]
    _, depth, bed, meaning = depths_of(dataset, here[place], name, notes)
    time = time_axis(dataset, dataset[name].dims, time_dim)
    on_faces = place == places[0]
    refuse_layers(dataset, name, (time, place))
    times = times_of(dataset, time, notes)

    speed = speed_of(dataset, name, (place,), time)
    dry = [reader_of(dataset[one]) for one in here[place] if one.lower() in DRY]

    def read(step: int) -> Reading:
        where, order = {time: step}, (place,)
        values = depth(where, order)
        for flag in dry:
            values = np.where(flag(where, order) == 1.0, np.minimum(values, 0.0), values)
        found = Reading(values, *(one(where, order) if one else None for one in (bed, speed)))
        if on_faces:
            return found if kept is None else found.at(kept)
        return found.each(whole.values)

    crs = crs_of(dataset, name, axes)
    turned = counter_clockwise(whole.nodes, whole.faces)
    return MeshSeries(whole.nodes, turned, on_faces, crs, name, times, read, meaning, units)


def _select_faces(some: NDArray[np.intp] | None, among: NDArray[np.intp] | None) -> NDArray[np.intp] | None:
    """Numbers of some of the faces that were kept; None for all of them."""
    return some if among is None else (among if some is None else some[among])


def _parts(dataset: Any, mesh: str) -> tuple[list[Any], Any, tuple[str, str]]:
    """Coordinates of nodes, east and north; the table of nodes of faces; the dimensions of faces and of nodes."""
    about = dataset[mesh].attrs
    axes = [dataset[key] for key in str(about["node_coordinates"]).split()][:2]
    if points_east(axes[1]) and not points_east(axes[0]):
        axes.reverse()
    connections = dataset[about["face_node_connectivity"]]
    if about.get("face_dimension") == connections.dims[1]:
        connections = connections.transpose()
    size, corners = connections.shape
    if size > MOST_FACES or corners > MOST_CORNERS:
        raise LimitError(
            f"its mesh {mesh!r} has {size:,} faces of up to {corners} nodes; "
            f"the limit is {MOST_FACES:,} of {MOST_CORNERS}; cut out a part of it"
        )
    return axes, connections, (str(connections.dims[0]), str(axes[0].dims[0]))


def _faces(connections: Any, count: int) -> Faces:
    """Read the numbers of the nodes of faces, from 0, padded with -1."""
    numbers: NDArray[Any] = load_values(connections)
    with np.errstate(invalid="ignore"):
        known = np.isfinite(numbers) & (numbers >= 0)
    used = numbers[known]
    # without `start_index` numbers start at 0, or at 1 if they include the number of nodes, but not 0
    start = connections.attrs.get("start_index", int(used.size > 0 and used.min() == 1 and used.max() == count))
    faces = np.where(known, numbers, start - 1).astype(np.int64) - int(start)
    if (faces[:, :-1] < 0).any() and ((faces[:, :-1] < 0) & (faces[:, 1:] >= 0)).any():
        faces = np.take_along_axis(faces, np.argsort(faces < 0, axis=1, kind="stable"), axis=1)
    return np.clip(faces, -1, count).astype(np.int32)


def faces_once(faces: Faces, notes: Notes) -> NDArray[np.intp] | None:
    """Numbers of faces without duplicates, which have the nodes of an earlier face; None if there are no duplicates.

    The sides of a duplicated face would have faces on both sides, even where the water ends.
    """
    mixed = np.zeros(len(faces), np.uint64)
    for column in faces.T:  # a sum does not depend on the node with which a face begins
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
    """Unwrap longitudes of nodes; return these and the numbers of faces that are whole then, None if all are.

    A mesh across the antimeridian is moved to one side of it. In a mesh around the world, faces that cross it are left
    out with a note. Places may be in degrees without saying so.
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
