"""Polygons of features in Web Mercator, on their way through files and processes."""

from dataclasses import dataclass
from io import BytesIO
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.extent import Bounds
from vexture_geo.base.rings import clip_polygons

SCHEMA_NAMES: Final = ("order", "id", "geometry")
"""Columns: the number of the feature in the source, its id, and a polygon in WKB."""


@dataclass(frozen=True, eq=False)
class FeaturePieces:
    """Polygons, (n,), in any order; `order` is the number of each one's feature in the source, `ids` its id."""

    order: NDArray[np.int64]
    ids: NDArray[Any]
    shapes: NDArray[Any]

    def __len__(self) -> int:
        return len(self.order)

    def take(self, selection: NDArray[Any]) -> "FeaturePieces":
        """Select pieces by a mask or by indices."""
        return FeaturePieces(self.order[selection], self.ids[selection], self.shapes[selection])

    def with_shapes(self, shapes: NDArray[Any]) -> "FeaturePieces":
        """Replace the shapes of the features, and keep only polygons."""
        import shapely

        parts, owner = shapely.get_parts(shapes, return_index=True)
        kinds = shapely.get_type_id(parts)
        while (kinds > shapely.GeometryType.POLYGON).any():
            parts, inner = shapely.get_parts(parts, return_index=True)
            owner, kinds = owner[inner], shapely.get_type_id(parts)
        areal = (kinds == shapely.GeometryType.POLYGON) & ~shapely.is_empty(parts)
        return FeaturePieces(self.order[owner[areal]], self.ids[owner[areal]], parts[areal])

    def within(self, box: Bounds) -> "FeaturePieces":
        """Clip the pieces to a box; polygons wholly inside stay byte-identical."""
        import shapely

        bounds = shapely.bounds(self.shapes).reshape(-1, 4)
        reaches = (bounds[:, :2] < box[2:]).all(axis=1) & (bounds[:, 2:] > box[:2]).all(axis=1)
        if not reaches.any():
            return self.take(reaches)
        found, bounds = self.take(reaches), bounds[reaches]
        leaves = (bounds[:, :2] < box[:2]).any(axis=1) | (bounds[:, 2:] > box[2:]).any(axis=1)
        if not leaves.any():
            return found
        shapes = found.shapes.copy()
        shapes[leaves] = clip_polygons(shapes[leaves], box)
        return found.with_shapes(shapes)

    @property
    def points(self) -> int:
        """Number of points of all pieces."""
        import shapely

        return int(shapely.get_num_coordinates(self.shapes).sum())

    def to_table(self) -> Any:
        """Convert the pieces to a table of Arrow."""
        import pyarrow as pa
        import shapely

        geometry = pa.array(shapely.to_wkb(self.shapes), pa.binary())
        return pa.table([pa.array(self.order), pa.array(self.ids, pa.string()), geometry], schema=schema())

    @classmethod
    def of_table(cls, table: Any) -> "FeaturePieces":
        """Read pieces from a table, or a batch, of Arrow."""
        import shapely

        order, ids, geometry = (table.column(name) for name in SCHEMA_NAMES)
        shapes = np.asarray(shapely.from_wkb(geometry.to_numpy(zero_copy_only=False)))
        return cls(order.to_numpy(zero_copy_only=False), ids.to_numpy(zero_copy_only=False), shapes)

    def to_bytes(self) -> bytes:
        """Write a Parquet file, byte-identical for the same pieces."""
        import pyarrow.parquet as pq

        file = BytesIO()
        pq.write_table(self.to_table(), file)
        return file.getvalue()

    @classmethod
    def of_bytes(cls, data: bytes) -> "FeaturePieces":
        """Read a Parquet file, without threads, because the process may be forked at any moment."""
        import pyarrow.parquet as pq

        file = pq.ParquetFile(BytesIO(data))
        groups = range(file.num_row_groups)  # one by one, because their bytes take more memory than shapes
        return join_pieces([cls.of_table(file.read_row_group(number, use_threads=False)) for number in groups])


def join_pieces(parts: "list[FeaturePieces]") -> FeaturePieces:
    """Concatenate pieces."""
    if not parts:
        return FeaturePieces(np.empty(0, np.int64), np.empty(0, object), np.empty(0, object))
    return FeaturePieces(
        np.concatenate([part.order for part in parts]),
        np.concatenate([part.ids for part in parts]),
        np.concatenate([part.shapes for part in parts]),
    )


def schema() -> Any:
    """Schema of a table of pieces."""
    import pyarrow as pa

    return pa.schema(list(zip(SCHEMA_NAMES, (pa.int64(), pa.string(), pa.binary()), strict=True)))
