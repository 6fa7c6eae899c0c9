"""Order of features where they overlap, as in `vexture map`."""

from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.maps.coverage import ranks, ranks_by_area
from vexture_geo.tiles.grid import HALF
from vexture_geo.tiles.pieces import FeaturePieces

RANKS: Final = "ranks.npy"
"""File in the folder of an unfinished pyramid."""

WORLD: Final = (-HALF, -HALF, HALF, HALF)


class Order:
    """The order of a source's features, which come in batches: by a column, else the smaller above the larger."""

    def __init__(self, column: str | None) -> None:
        self._column = column
        self._areas: list[NDArray[np.float64]] = []
        self._values: list[Any] = []
        self._features: Any = None

    def add(self, features: Any, found: FeaturePieces, first: int) -> None:
        """Append features, which are numbered from `first`, and their pieces in the world."""
        if self._column is None:
            import shapely

            inside = found.within(WORLD)  # what is repeated beyond the antimeridian counts once
            area: NDArray[np.float64] = shapely.area(inside.shapes)
            self._areas.append(np.bincount(inside.order - first, area, len(features.ids)).astype(np.float64))
            return
        if self._features is None:
            ranks(features, self._column)  # says what is wrong with the column before all is read
            self._features = features
        self._values.append(features.table.column(self._column))

    def write(self, folder: Path) -> None:
        """Keep the place of each feature, from the lowest on."""
        np.save(folder / RANKS, self._ranks().astype(np.uint32))

    def _ranks(self) -> NDArray[np.int64]:
        if self._column is None:
            return ranks_by_area(np.concatenate([np.empty(0), *self._areas]))
        if self._features is None:
            return np.empty(0, np.int64)
        import pyarrow as pa

        chunks = [chunk for column in self._values for chunk in column.chunks]
        values = pa.chunked_array(chunks, self._values[0].type)
        whole = replace(self._features, ids=np.empty(len(values), object), table=pa.table({self._column: values}))
        return ranks(whole, self._column)


def ranks_of(folder: Path) -> NDArray[np.uint32]:
    """The places of features by their numbers: the higher one is seen where they overlap."""
    found: NDArray[np.uint32] = np.load(folder / RANKS)
    return found
