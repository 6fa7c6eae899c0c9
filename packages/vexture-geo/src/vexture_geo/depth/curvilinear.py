"""Depths on rows and columns whose samples have two coordinates each: rotated and curvilinear grids of models.

SFINCS, Delft3D-FLOW and ROMS write such files. Straight and even rows and columns, rotated or not, are a lattice like
that of a GeoTIFF. Other grids become a mesh: each sample is a face, with corners in the middle of its neighbours.
"""

import re
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError, SourceError
from vexture.base.notes import Notes
from vexture_geo.base.longitudes import narrower
from vexture_geo.depth.conforming import conforming
from vexture_geo.depth.mesh import MeshSeries
from vexture_geo.depth.mesh_topology import Faces, counter_clockwise
from vexture_geo.depth.netcdf import axes_of, crs_of, points_east, points_north, times_of
from vexture_geo.depth.series import Lattice, Reading, Series, Values
from vexture_geo.depth.speeds import speed_of
from vexture_geo.depth.ugrid import MOST_FACES
from vexture_geo.depth.variables import depths_of, has_depths, load_values, reader_of, refuse_layers, time_axis, unit_of

ENDING: Final = r"(_?(rho|r|t|c|z|centers?|centres?))?"
EAST: Final = re.compile(rf"(x|lon|longitude|nav_lon|xlong|glamt|easting){ENDING}", re.IGNORECASE)
NORTH: Final = re.compile(rf"(y|lat|latitude|nav_lat|xlat|gphit|northing){ENDING}", re.IGNORECASE)
"""Names of coordinates, for files without attributes that describe them."""

MASKS: Final = {"msk", "mask_rho", "wetdry_mask_rho", "kcs"}
"""Variables, in lower case, that are 0 where a model has no cell or no water, in SFINCS, ROMS and Delft3D-FLOW."""

OFF_LATTICE: Final = 0.02
"""Largest deviation of samples from an even lattice, in cells, besides the rounding of 32-bit coordinates."""

TURN: Final = 360.0

Places = NDArray[np.float64]

FAR: float = 1e9
"""Limit of coordinates in metres or degrees; files without a declared fill value contain 1e37."""


class GridPlaces(NamedTuple):
    """Dimensions of rows and columns, and the names of their coordinates, east and north."""

    rows: str
    columns: str
    x: str
    y: str


def places_of_grid(dataset: Any, time_dim: str | None) -> dict[str, GridPlaces]:
    """Find variables of an open dataset that may hold depths at places with two coordinates each, and these places.

    Return none if depths are on rows and columns with coordinates of their own.
    """
    found, straight = {}, []
    for name in map(str, dataset.data_vars):
        places = _places(dataset, name, time_dim)
        if dataset[name].dtype.kind not in "iuf":
            continue
        axes = axes_of(dataset, name, time_dim)
        if axes is not None and all(_has_units(dataset, dim) for dim in axes[1:]):
            straight.append(name)
        elif places is not None and name not in (places.x, places.y):
            found[name] = places
    return {} if has_depths(dataset, straight) else found


def grid_series(
    dataset: Any, grids: dict[str, GridPlaces], time_dim: str | None, variable: str | None, notes: Notes
) -> Series | MeshSeries:
    """Read depths at the places that `places_of_grid` found; see `netcdf.series_of` for errors."""
    among = {one: places for one, places in grids.items() if one.lower() not in MASKS}
    name = depths_of(dataset, _with_depths(dataset, among) if variable is None else list(among), variable, notes).name
    places = grids[name]
    here = [one for one in among if among[one][:2] == places[:2]]
    name, depth, bed, meaning = depths_of(dataset, here, name, notes)  # the bed must have the places of the depths
    order = places[:2]
    time = time_axis(dataset, dataset[name].dims, time_dim)
    refuse_layers(dataset, name, (time, *order))
    masks = [reader_of(dataset[mask]) for mask in grids if mask.lower() in MASKS and grids[mask][:2] == order]
    times = times_of(dataset, time, notes)
    x, y, stride = _coordinates(dataset, places)
    known = np.isfinite(x) & np.isfinite(y)
    if not known.any():
        raise SourceError(f"coordinates {places.x!r} and {places.y!r} hold no place; write them into the file")

    speed = speed_of(dataset, name, order, time)

    def read(step: int, rows: slice, columns: slice) -> Reading:
        where = {time: step, places.rows: rows, places.columns: columns}
        values = depth(where, order)
        for mask in masks:
            values = np.where(mask(where, order) == 0.0, np.nan, values)
        if stride == 1:
            values = np.where(known[rows, columns], values, np.nan)
        return Reading(values, *(one(where, order) if one else None for one in (bed, speed)))

    crs = crs_of(dataset, name, [dataset[places.x], dataset[places.y]])
    rounding = float(np.finfo(np.float32).eps) if dataset[places.x].dtype == np.float32 else 0.0
    lattice = _lattice(x, y, known, stride, tuple(int(dataset.sizes[dim]) for dim in order), rounding)
    if lattice is not None:
        return Series(lattice, crs, name, times, read, meaning, unit_of(dataset[places.x]))
    if stride > 1:
        raise LimitError(
            f"{known.size * stride**2:,} cells with coordinates of their own each are too many; "
            f"the limit is {MOST_FACES:,}; cut out a part of it"
        )
    nodes, faces = _mesh(dataset, places, np.stack([x, y], axis=-1), known)

    def read_faces(step: int) -> Reading:
        return read(step, slice(None), slice(None)).at(known)

    whole = counter_clockwise(nodes, faces)
    return MeshSeries(nodes, whole, True, crs, name, times, read_faces, meaning, unit_of(dataset[places.x]))


def _with_depths(dataset: Any, grids: dict[str, GridPlaces]) -> list[str]:
    """Select the variables on the only rows and columns with depths, by name, or else all variables."""
    by_place: dict[tuple[str, ...], list[str]] = {}
    for name, places in grids.items():
        by_place.setdefault(places[:2], []).append(name)
    found = [names for names in by_place.values() if has_depths(dataset, names)]
    return found[0] if len(found) == 1 else list(grids)


def _places(dataset: Any, name: str, time_dim: str | None) -> GridPlaces | None:
    """Places of a variable: its stated coordinates, or else those on its dimensions, longitude and latitude first."""
    variable = dataset[name]
    time = time_axis(dataset, variable.dims, time_dim)
    dims = [str(dim) for dim in variable.dims if dim != time]
    told = f"{variable.attrs.get('coordinates', '')} {variable.encoding.get('coordinates', '')}".split()
    on = [
        str(key)
        for key in dataset.variables
        if dataset[key].ndim == 2 and set(map(str, dataset[key].dims)) <= set(dims) and dataset[key].dtype.kind in "iuf"
    ]
    on.sort(key=lambda key: (key not in told, "degree" not in str(dataset[key].attrs.get("units", ""))))
    east = next((key for key in on if points_east(dataset[key]) or EAST.fullmatch(key)), None)
    north = next((key for key in on if points_north(dataset[key]) or NORTH.fullmatch(key)), None)
    if east is None or north is None or set(dataset[east].dims) != set(dataset[north].dims):
        return None
    rows, columns = (dim for dim in dims if dim in dataset[east].dims)
    return GridPlaces(rows, columns, east, north)


def _has_units(dataset: Any, dim: str) -> bool:
    """Return whether a dimension has coordinates of a reference system rather than row numbers."""
    if dim not in dataset.variables:
        return False
    about = dataset[dim].attrs
    return _of_the_world(about) or str(about.get("units", "1")).strip() not in ("", "1")


def _of_the_world(about: Any) -> bool:
    """Return whether attributes describe a coordinate of a reference system."""
    standard = str(about.get("standard_name", ""))
    return standard in ("longitude", "latitude") or standard.startswith(("projection_", "grid_l"))


def _coordinates(dataset: Any, places: GridPlaces) -> tuple[Values, Values, int]:
    """Coordinates east and north, NaN without a cell, of every sample or, in a huge grid, of one in `stride`."""
    rows, columns = (int(dataset.sizes[dim]) for dim in places[:2])
    stride = int(np.ceil(np.sqrt(rows * columns / MOST_FACES)))
    x, y = (
        load_values(dataset[key].transpose(*places[:2])[::stride, ::stride]).astype(np.float64)
        for key in (places.x, places.y)
    )
    x, y = without_fill(x, y)
    if "degree" in str(dataset[places.x].attrs.get("units", "")):
        x = narrower(x, TURN)
    return x, y, stride


def _lattice(
    x: Values, y: Values, known: NDArray[np.bool_], stride: int, shape: tuple[int, ...], rounding: float
) -> Lattice | None:
    """Fit a lattice of `shape` to samples, one in `stride`; None if they are not straight and even.

    `rounding` is the largest rounding error of coordinates, as a fraction of them.
    """
    if min(x.shape) < 2 or known.sum() < 3:
        return None
    rows, columns = np.nonzero(known)
    cells = np.column_stack([columns, rows]) * float(stride)
    places = np.column_stack([x[known], y[known]])
    middle, origin = cells.mean(axis=0), places.mean(axis=0)
    moved = cells - middle
    if np.linalg.matrix_rank(moved.T @ moved) < 2:
        return None
    turn = np.linalg.solve(moved.T @ moved, moved.T @ (places - origin)).T
    side = float(np.hypot(*turn).min())
    off = np.abs(moved @ turn.T + origin - places).max()
    if off > OFF_LATTICE * side + rounding * float(np.abs(places).max()):
        return _rectilinear(x, y) if stride == 1 else None
    if abs(np.linalg.det(turn)) < OFF_LATTICE * side**2:
        return None
    affine = np.column_stack([turn, origin - turn @ middle])
    return Lattice(np.arange(float(shape[1])), np.arange(float(shape[0])), affine)


def _rectilinear(x: Values, y: Values) -> Lattice | None:
    """Make a lattice of columns with one x and rows with one y each, at any spacing; None if they have not."""
    if not (np.isfinite(x).any(axis=0).all() and np.isfinite(y).any(axis=1).all()):
        return None
    across, up = np.nanmean(x, axis=0), np.nanmean(y, axis=1)
    for axis, off in ((across, np.abs(x - across)), (up, np.abs(y - up[:, None]))):
        step = np.diff(axis)
        if not ((step > 0.0).all() or (step < 0.0).all()) or np.nanmax(off) > OFF_LATTICE * np.abs(step).min():
            return None
    return Lattice(across, up, np.eye(2, 3))


def _mesh(
    dataset: Any, places: GridPlaces, centres: Values, known: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], Faces]:
    """Nodes, (n, 2), and a face for each known cell; its corners are its bounds in the file, or else amid cells."""
    bounds = [str(dataset[key].attrs.get("bounds", "")) for key in (places.x, places.y)]
    if all(key in dataset.variables and dataset[key].shape == (*known.shape, 4) for key in bounds):
        corners = np.stack([load_values(dataset[key])[known] for key in bounds], axis=-1).astype(np.float64)
        if np.isfinite(corners).all():
            own = np.arange(4 * len(corners), dtype=np.int32).reshape(-1, 4)
            nodes, faces, _ = conforming(corners.reshape(-1, 2), own)
            return nodes, faces
    nodes = corners_of(centres, known).reshape(-1, 2)
    row, column = np.nonzero(known)
    wide = known.shape[1] + 1
    first = row * wide + column
    faces = np.column_stack([first, first + 1, first + wide + 1, first + wide])
    used, numbers = np.unique(faces, return_inverse=True)
    return nodes[used], numbers.reshape(faces.shape).astype(np.int32)


def without_fill(x: Places, y: Places) -> tuple[Places, Places]:
    """Replace coordinates of cells that a model lacks by NaN: those with fill values, which several cells share.

    A number, such as 0 or -999, that is both coordinates of more than one cell is a fill value.

    Examples
    --------
    >>> without_fill(np.array([[0.0, 0.0, 5.0]]), np.array([[0.0, 0.0, 0.0]]))[0]
    array([[nan, nan,  5.]])
    """
    with np.errstate(invalid="ignore"):
        lost = ~np.isfinite(x) | ~np.isfinite(y) | (np.abs(x) > FAR) | (np.abs(y) > FAR)
    alike = ~lost & (x == y)
    values, counts = np.unique(x[alike], return_counts=True)
    lost |= alike & np.isin(x, values[counts > 1])
    return np.where(lost, np.nan, x), np.where(lost, np.nan, y)


def corners_of(centres: Places, known: NDArray[np.bool_]) -> Places:
    """Corners of cells, (rows + 1, columns + 1, 2), from their middles, (rows, columns, 2); NaN where no cell is.

    A corner amid four known cells is the mean of their middles. On a border it is half a cell beyond the middles, by
    the distance between the middles on this side of it.

    Examples
    --------
    >>> x, y = np.meshgrid([0.0, 10.0], [0.0, 4.0])
    >>> corners_of(np.stack([x, y], axis=-1), np.ones((2, 2), bool))[:, 0]
    array([[-5., -2.],
           [-5.,  2.],
           [-5.,  6.]])
    """
    rows, columns = known.shape
    middles = np.where(known[..., None], centres, np.nan)
    down, across = _with_other(*(_steps(middles, axis) for axis in (0, 1)))
    total, among = np.zeros((rows + 1, columns + 1, 2)), np.zeros((rows + 1, columns + 1, 2))
    count = np.zeros((rows + 1, columns + 1, 1))
    for below in (0, 1):
        for right in (0, 1):
            at = slice(below, rows + below), slice(right, columns + right)
            corner = middles + (below - 0.5) * down + (right - 0.5) * across
            total[at] += np.where(known[..., None], corner, 0.0)
            among[at] += np.where(known[..., None], middles, 0.0)
            count[at] += known[..., None]
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(count == 4.0, among, total) / count


def _steps(middles: Places, axis: int) -> Places:
    """Step from each cell to the next along an axis: the mean of the steps to known neighbours; NaN without any."""
    ways = np.diff(middles, axis=axis)
    none = np.full_like(np.take(middles, [0], axis), np.nan)
    both = np.stack([np.concatenate([none, ways], axis), np.concatenate([ways, none], axis)])
    there = np.isfinite(both)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.where(there, both, 0.0).sum(axis=0) / there.sum(axis=0))


def _with_other(down: Places, across: Places) -> tuple[Places, Places]:
    """Complete steps down and across: if only one is known, as in a channel of one cell, the other is as long."""
    turned = down[..., 0] * across[..., 1] - down[..., 1] * across[..., 0]
    hand = -1.0 if np.nansum(np.sign(turned)) < 0.0 else 1.0

    def square(way: Places, sign: float) -> Places:
        return sign * hand * np.stack([-way[..., 1], way[..., 0]], axis=-1)

    return (
        np.where(np.isfinite(down), down, np.nan_to_num(square(across, -1.0))),
        np.where(np.isfinite(across), across, np.nan_to_num(square(down, 1.0))),
    )
