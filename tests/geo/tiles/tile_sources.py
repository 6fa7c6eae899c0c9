"""Sources of tiles for tests: features in memory, in batches, and a file whose content stands for them."""

import json
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, ClassVar

import numpy as np
import shapely

from vexture_geo.base.rings import rings_of

COUNT = 12
VALUES = [None, *range(1, COUNT)]


@dataclass(frozen=True, eq=False)
class Batch:
    """As much of `vexture_geo.vector.features.Features` as tiles need."""

    rings: Any
    ids: Any
    crs: str = "EPSG:4326"
    lines: ClassVar = SimpleNamespace(ends=())
    points: ClassVar = SimpleNamespace(points=())


def batch_of(shapes, ids, crs="EPSG:4326"):
    """Features of shapely's polygons and multipolygons."""
    parts, owner = shapely.get_parts(np.asarray(shapes, object), return_index=True)
    rings = rings_of(parts, lambda index: f"feature {owner[index] + 1}", owner.astype(np.intp))
    return Batch(rings, np.asarray(ids, object), crs)


def batches_of(shapes, ids, crs="EPSG:4326", size=1000):
    """What reads a source in batches, in place of that module."""

    def batches(_source, **_options):
        for first in range(0, len(shapes), size):
            yield batch_of(shapes[first : first + size], ids[first : first + size], crs)

    return batches


def cells(count, box, seed=1):
    """Voronoi cells that share their borders, in a box."""
    points = np.random.default_rng(seed).uniform(box[:2], box[2:], (count, 2))
    found = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(points), extend_to=shapely.box(*box)))
    return shapely.clip_by_rect(found, *box)


def write_source(path, shapes, ids):
    features = [
        {"type": "Feature", "properties": {"parcel": name}, "geometry": shapely.geometry.mapping(shape)}
        for name, shape in zip(ids, shapes, strict=True)
    ]
    path.write_text(json.dumps({"type": "FeatureCollection", "name": "parcels", "features": features}))
    return path


def write_many(path):
    """Parcels with many points, of several parts."""
    shapes = shapely.segmentize(cells(3000, (4.0, 51.0, 16.0, 59.0)), 0.006)
    return write_source(path, shapes, range(len(shapes)))


def write_columns(path, shapes, **columns):
    rows = [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]
    features = [
        {"type": "Feature", "properties": row, "geometry": shapely.geometry.mapping(shape)}
        for row, shape in zip(rows, shapes, strict=True)
    ]
    path.write_text(json.dumps({"type": "FeatureCollection", "name": "parcels", "features": features}))
    return path


def write_parcels(folder):
    """A source of `COUNT` parcels, the first of which has no value."""
    names = [f"p{k}" for k in range(COUNT)]
    shapes = cells(COUNT, (4.0, 51.0, 6.0, 53.0))
    return write_columns(folder / "parcels.geojson", shapes, parcel=names, value=VALUES)
