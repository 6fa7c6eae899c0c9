"""Columns and indices of GeoDataFrames."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["arrow_of", "labels_of"]


def labels_of(index: Any) -> NDArray[Any] | None:
    """The labels of an index as texts, where they tell rows apart and are more than their numbers."""
    if index.nlevels > 1 or index.hasnans or not index.is_unique:
        return None
    labels = np.array([str(label) for label in index.tolist()], object)
    is_number = [str(number) for number in range(len(labels))] == labels.tolist()
    return None if is_number or len(set(labels)) < len(labels) else labels


def arrow_of(values: Any) -> Any:
    """A column of pandas; one that Arrow has no type for, as of numbers and texts together, is its values as texts."""
    import pyarrow as pa

    try:
        return pa.array(values, from_pandas=True)
    except (pa.ArrowInvalid, pa.ArrowTypeError, pa.ArrowNotImplementedError):
        known = ~values.isna()
        return pa.array([str(value) if there else None for value, there in zip(values, known, strict=True)])
