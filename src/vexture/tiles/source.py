"""Features of a file in batches, never all in memory: what GDAL reads, by Arrow."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.errors import ParameterError, SourceError, reason_of
from vexture.geo.crs import chosen_crs, gis_packages
from vexture.geo.rings import Rings, rings_of
from vexture.notes import Notes

__all__ = ["Features", "feature_batches"]

BATCH: Final = 65_536
"""Features of a batch."""


@dataclass(frozen=True, eq=False)
class Features:
    """Polygons of features: `feature` is the place of each polygon's in `ids`, and `crs` is that of their points."""

    rings: Rings
    feature: NDArray[np.intp]
    ids: NDArray[Any]
    crs: str


@gis_packages()
def feature_batches(
    source: Path,
    *,
    layer: str | None = None,
    where: str | None = None,
    crs: str | None = None,
    id: str | None = None,
    notes: Notes,
) -> Iterator[Features]:
    """Read features of a file, some at a time.

    Parameters
    ----------
    source : path
    layer, where : str or None
        Of a file with several layers; a condition in OGR's SQL on attributes.
    crs : str or None
        Reference system of the coordinates, in place of what the file says.
    id : str or None
        Column whose values are the ids of features; else they are numbered from 0.
    notes : Notes
        Gets what is left out.

    Raises
    ------
    SourceError
        If the file cannot be read.
    ParameterError
        If there is no such layer or column.
    """
    from pyogrio import raw

    asked = {"layer": layer, "where": where, "columns": [] if id is None else [id]}
    try:
        if id is not None and id not in (fields := raw_fields(source, layer)):
            raise ParameterError(f"{source}: it has no column `id` {id!r}; its columns are: {', '.join(fields)}")
        with raw.open_arrow(source, batch_size=BATCH, use_pyarrow=True, **asked) as (meta, reader):
            own = chosen_crs(crs, meta["crs"])
            count = 0
            for batch in reader:
                yield _features(batch, meta["geometry_name"] or "wkb_geometry", id, own, count, notes)
                count += batch.num_rows
    except (RuntimeError, OSError, ValueError) as error:
        if isinstance(error, ParameterError):
            raise
        raise SourceError(f"{source}: it cannot be read ({reason_of(error)}); correct or convert it") from None


def raw_fields(source: Path, layer: str | None) -> list[str]:
    """Names of a layer's columns."""
    from pyogrio import read_info

    return [str(name) for name in read_info(source, layer=layer)["fields"]]


def _features(batch: Any, column: str, id: str | None, own: str, first: int, notes: Notes) -> Features:
    """Features of a batch of Arrow."""
    import shapely

    found = batch.column(column).to_numpy(zero_copy_only=False)
    shapes = shapely.force_2d(shapely.from_wkb(found, on_invalid="fix"))
    parts, owner = shapely.get_parts(shapes, return_index=True)
    kinds = shapely.get_type_id(parts)
    while (kinds > shapely.GeometryType.POLYGON).any():
        parts, inner = shapely.get_parts(parts, return_index=True)
        owner, kinds = owner[inner], shapely.get_type_id(parts)
    areal = (kinds == shapely.GeometryType.POLYGON) & ~shapely.is_empty(parts)
    for _ in range(int((~areal).sum())):
        notes.left_out("feature that is no polygon")
    owner = owner[areal]
    if id is None:
        ids = np.array([str(number) for number in range(first, first + batch.num_rows)], object)
    else:
        ids = np.array([str(value) for value in batch.column(id).to_pylist()], object)
    rings = rings_of(parts[areal], lambda index: f"feature {first + owner[index] + 1}")
    return Features(rings, owner.astype(np.intp), ids, own)
