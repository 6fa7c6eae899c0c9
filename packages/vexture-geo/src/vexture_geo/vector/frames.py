"""Columns and indices of GeoDataFrames."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.labels import texts_of

if TYPE_CHECKING:
    import pyarrow


def labels_of(index: Any) -> tuple[NDArray[Any] | None, str]:
    """Labels of an index as texts, if they are unique and more than row numbers.

    If they are not unique, there are none, and the second text says why.
    """
    if index.nlevels > 1:
        return None, "has several levels"
    if index.hasnans:
        return None, "lacks labels"
    labels = np.array(texts_of(index.tolist()), object)
    if len(set(labels.tolist())) < len(labels):
        return None, "has labels that are equal"
    is_number = [str(number) for number in range(len(labels))] == labels.tolist()
    return None if is_number else labels, ""


def arrow_of(values: Any) -> Any:
    """Convert a column of pandas to Arrow; values without a type in Arrow, such as mixed numbers and texts, are texts.

    Numbers beyond 64 bits become floats, categories keep their order, and periods and intervals become texts.
    """
    import pyarrow as pa

    if hasattr(values, "cat"):
        codes = values.cat.codes.to_numpy()
        names = arrow_of(values.cat.categories.to_series())
        return pa.DictionaryArray.from_arrays(pa.array(codes, mask=codes < 0), names, ordered=values.cat.ordered)
    try:
        found = pa.array(values, from_pandas=True)
    except OverflowError:
        return _floats(values)
    except (pa.ArrowInvalid, pa.ArrowTypeError, pa.ArrowNotImplementedError):
        return _as_texts(values)
    return _as_texts(values) if isinstance(found.type, pa.BaseExtensionType) else found


def _floats(values: Any) -> Any:
    import pyarrow as pa

    try:
        return pa.array(values.astype(float), from_pandas=True)
    except (TypeError, ValueError):
        return _as_texts(values)


def _as_texts(values: Any) -> Any:
    import pyarrow as pa

    known = ~values.isna()
    return pa.array([str(value) if there else None for value, there in zip(values, known, strict=True)], pa.string())


def check_texts(table: "pyarrow.Table") -> None:
    """Refuse texts in another encoding, which GDAL does not convert."""
    import pyarrow as pa

    for name, column in zip(table.column_names, table.columns, strict=True):
        if pa.types.is_string(column.type) or pa.types.is_large_string(column.type):
            try:
                column.validate(full=True)
            except pa.ArrowInvalid:
                raise SourceError(
                    f"the texts in its column {name!r} are not UTF-8; name their encoding, such as ISO-8859-1, in a "
                    "file of the same name that ends in .cpg, or leave the column out by `columns`"
                ) from None
