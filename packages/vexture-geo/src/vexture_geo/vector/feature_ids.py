"""Ids of GeoJSON features as in the file: GDAL changes ids that occur twice or are texts.

RFC 7946, 3.2: a feature has an id beside its properties, a text or a number. A property may also be named id.
"""

import json
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.vector.vector_files import JSON
from vexture_geo.vector.vectors import gdal_errors

if TYPE_CHECKING:
    import pyarrow

KEY: Final = b'"id"'
WHOLE: Final = re.compile(rb'"id"\s*:\s*(-?\d{1,18})\s*[,}\]]')


def ids_of_json(content: bytes, has_column: bool) -> dict[int, str | None]:
    """Ids of GeoJSON features by GDAL's numbers of them; empty if GDAL has the same ids.

    See `may_differ` for `has_column`.
    """
    from pyogrio import raw

    if KEY not in content:
        return {}

    options: dict[str, Any] = {"columns": [], "read_geometry": False, "return_fids": True, "use_pyarrow": True}
    with gdal_errors(JSON), raw.open_arrow(content, **options) as (_, reader):
        numbers = reader.read_all().column(0).to_pylist()
    ids = given_ids(content) if may_differ(content, numbers, has_column) else None
    return {} if ids is None or len(ids) != len(numbers) else dict(zip(numbers, ids, strict=True))


def with_ids(table: "pyarrow.Table", numbers: NDArray[np.int64], ids: dict[int, str | None]) -> "pyarrow.Table":
    """Add a column `id` of the features' own ids to attributes; a property of that name is renamed."""
    import pyarrow as pa

    column = pa.array([ids[number] for number in numbers.tolist()], pa.string())
    return table.rename_columns(names_beside_id(table.column_names)).append_column("id", column)


def names_beside_id(names: list[str]) -> list[str]:
    """Rename a column `id` to make room for the features' own ids.

    Examples
    --------
    >>> names_beside_id(["id", "id_", "name"])
    ['id__', 'id_', 'name']
    """
    new = "id_"
    while new in names:
        new += "_"
    return [new if name == "id" else name for name in names]


def may_differ(content: bytes, numbers: Sequence[int], has_column: bool) -> bool:
    """Return whether GDAL's ids of features may differ from those of a file; most files need not be read twice.

    `numbers` are GDAL's numbers of all features, in order; `has_column` says whether there is an attribute `id`.

    Examples
    --------
    >>> may_differ(b'{"id": 7}, {"id": 9}', [7, 9], False), may_differ(b'{"id": 7}, {"id": 7}', [7, 0], False)
    (False, True)
    """
    keys = content.count(KEY)
    if has_column:  # from properties, or made by GDAL from text ids; each feature has one such key
        return keys > len(numbers)
    return keys > 0 and [int(found[1]) for found in WHOLE.finditer(content)] != [*numbers]


def given_ids(content: bytes) -> list[str | None] | None:
    """Return the id of each feature of a collection, None where it has none; None instead of a list if none has one.

    Examples
    --------
    >>> given_ids(b'{"type": "FeatureCollection", "features": [{"id": 5}, {"id": "5"}, {}]}')
    ['5', '5', None]
    """
    try:
        whole = json.loads(content)
    except (ValueError, RecursionError):
        return None  # GDAL reports the error, or reads it in another way
    features = whole.get("features") if isinstance(whole, dict) and whole.get("type") == "FeatureCollection" else None
    if not isinstance(features, list):
        return None
    ids = [_text(feature.get("id")) if isinstance(feature, dict) else None for feature in features]
    return ids if any(one is not None for one in ids) else None


def _text(value: Any) -> str | None:
    return value if isinstance(value, str) or value is None else json.dumps(value)
