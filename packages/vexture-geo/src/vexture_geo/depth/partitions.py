"""Merge the map files of a partitioned D-Flow FM run into one mesh with each face once."""

import re
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture_geo.depth.mesh import MeshSeries
from vexture_geo.depth.netcdf import open_dataset
from vexture_geo.depth.series import Reading, Values
from vexture_geo.depth.ugrid import mesh_series
from vexture_geo.depth.variables import load_values

NAME: Final = re.compile(r"(.+_)(\d{4})(_map\.nc)")
"""Name of the map file of a partition."""

DOMAIN: Final = "flowelem_domain"
"""Suffix of the variable with the partition of each face, because files also hold some faces of others."""


def partitions_beside(path: Path) -> list[Path]:
    """List all map files of a partition's run, itself included, in order; empty if it is not a partition.

    Examples
    --------
    >>> partitions_beside(Path("fm_map.nc"))
    []
    """
    name = NAME.fullmatch(path.name)
    if name is None:
        return []
    start, _, end = name.groups()
    found = (one for one in path.parent.glob(f"*{end}") if (other := NAME.fullmatch(one.name)) and other[1] == start)
    return sorted(found)


@contextmanager
def open_partitions(
    paths: Sequence[Path], time_dim: str | None, variable: str | None, notes: Notes
) -> Iterator[MeshSeries]:
    """Open the map files of a run as one mesh.

    Raises
    ------
    SourceError
        If a partition is missing, or if the files are not of one run.
    """
    with ExitStack() as stack:
        parts, owned, domains = [], [], set()
        numbers = [_number(path) for path in paths]
        for path, number in zip(paths, numbers, strict=True):
            dataset = stack.enter_context(open_dataset(path, time_dim))
            part = mesh_series(dataset, time_dim, variable, notes)
            domain = _domain(dataset, len(part.faces))
            if domain is None and len(paths) == 1:
                yield part
                return
            if domain is None or not part.on_faces:
                raise SourceError(
                    f"{path.name} is one of {len(paths)} partitions, but has no depths on faces with a variable "
                    f"{DOMAIN}, which says whose each face is; merge them with the model's own tool"
                )
            parts.append(part)
            owned.append(domain == number)
            domains |= set(np.unique(domain).tolist())
        missing = sorted(domains - set(numbers))
        if missing:
            name = NAME.sub(lambda found: f"{found[1]}{missing[0]:04d}{found[3]}", paths[0].name)
            raise SourceError(f"its partition {name} is missing beside it; copy it there")
        if len({part.meaning.ranges for part in parts}) > 1:
            raise SourceError("its partitions have different classes of depth; write all of them in one run")
        if len({part.times for part in parts}) > 1:
            raise SourceError("its partitions have different times; write all of them in one run")
        yield _merge_meshes(parts, owned)


def _concatenate(values: Sequence[Values | None]) -> Values | None:
    """Concatenate the values of all parts; None if any part has none."""
    known = [one for one in values if one is not None]
    return np.concatenate(known) if len(known) == len(values) else None


def _number(path: Path) -> int:
    """Read the number of a partition from its name."""
    name = NAME.fullmatch(path.name)
    return -1 if name is None else int(name[2])


def _domain(dataset: Any, faces: int) -> NDArray[np.int64] | None:
    """Read the partition of each face; None if the file does not store it."""
    for name in dataset.variables:
        if str(name).endswith(DOMAIN) and dataset[name].shape == (faces,):
            return np.asarray(load_values(dataset[name]), np.int64)
    return None


def _merge_meshes(parts: Sequence[MeshSeries], owned: Sequence[NDArray[np.bool_]]) -> MeshSeries:
    """Merge the faces that the parts own into one mesh; nodes at byte-identical places become one."""
    places, numbers = np.unique(np.concatenate([part.nodes for part in parts]), axis=0, return_inverse=True)
    starts = np.cumsum([0, *(len(part.nodes) for part in parts)])
    corners = max(part.faces.shape[1] for part in parts)
    faces = []
    for part, own, start in zip(parts, owned, starts, strict=False):
        mine = part.faces[own].astype(np.int64)
        renumbered = np.where(mine >= 0, numbers.ravel()[np.maximum(mine, 0) + start], -1)
        faces.append(np.pad(renumbered, [(0, 0), (0, corners - mine.shape[1])], constant_values=-1))

    def read(step: int) -> Reading:
        read = [part.read(step).at(own) for part, own in zip(parts, owned, strict=True)]
        return Reading(*map(_concatenate, zip(*read, strict=True)))  # type: ignore[arg-type]

    first = parts[0]
    return MeshSeries(
        places,
        np.concatenate(faces).astype(np.int32),
        True,
        first.crs,
        first.variable,
        first.times,
        read,
        first.meaning,
        first.unit,
    )
