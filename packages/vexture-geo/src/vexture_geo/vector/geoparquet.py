"""Find the geometry column of an Arrow table, its encoding, and its reference system."""

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError
from vexture_geo.vector.curves import BROKEN
from vexture_geo.vector.geojson import WORLD
from vexture_geo.vector.wkt import wkb_of_texts

if TYPE_CHECKING:
    import pyarrow
    import pyarrow.parquet


NAMES: Final = ("geometry", "geom", "wkb_geometry", "wkb", "wkt")
"""Names of columns that may hold geometries, if nothing else in the file marks one."""

WKB, WKT = "wkb", "wkt"
DEPTHS: Final = {"point": 0, "linestring": 1, "multipoint": 1, "polygon": 2, "multilinestring": 2, "multipolygon": 3}
"""Encodings of GeoArrow, and the depth of the lists around their coordinates."""

EXTENSION: Final = "geoarrow."
PROJJSON: Final = "projjson:"
SRID: Final = "srid:"

SPHERICAL: Final = "its sides are great circles; they are drawn straight in longitude and latitude"
TEXTS: Final = "its geometries are texts in WKT"

WRAPPING: Final = "Unknown error: Wrapping"
"""Start of Arrow's message if there is no memory for an object."""

REMEDY: Final = "save it as GeoParquet with geometries in WKB"


@dataclass(frozen=True)
class GeometryColumn:
    """Column of geometries.

    Parameters
    ----------
    name : str
    encoding : str
        ``wkb``, ``wkt``, or one of GeoArrow, such as ``polygon``.
    crs : str, optional
        None if it is stated to be unknown, or not stated.
    remarks : tuple of str
        Remarks for the user.
    """

    name: str
    encoding: str
    crs: str | None
    remarks: tuple[str, ...] = ()

    def shapes(self, table: "pyarrow.Table") -> NDArray[Any]:
        """Convert a table's geometries to WKB; None where there is none, `BROKEN` where one is broken."""
        column = table.column(self.name)
        if self.encoding in DEPTHS:
            return np.concatenate([np.empty(0, object), *(_of_arrow(chunk, self.encoding) for chunk in column.chunks)])
        shapes = objects_of(column)
        return wkb_of_texts(shapes) if self.encoding == WKT else shapes


def geometry_column(file: Any) -> GeometryColumn:
    """Find the geometry column of a table by its metadata, by a type for geometries, or by name."""
    import pyarrow.parquet as pq

    schema = file.schema_arrow
    metadata, logical = schema.metadata or {}, dict[str, Any]()
    if isinstance(file, pq.ParquetFile):
        metadata = file.metadata.metadata or {}
        logical = {column.name: column.logical_type for column in map(file.schema.column, range(len(file.schema)))}
    if (geo := metadata.get(b"geo")) is not None:
        return _of_metadata(geo, schema)
    for field in schema:
        kind = str(getattr(logical.get(field.name), "type", ""))
        if kind in ("GEOMETRY", "GEOGRAPHY"):
            crs = json.loads(logical[field.name].to_json()).get("crs") or WORLD
            remarks = (SPHERICAL,) if kind == "GEOGRAPHY" else ()
            return GeometryColumn(field.name, WKB, _named_crs(str(crs), metadata), remarks)
    for field in schema:
        extension, about = _extension(field)
        if extension.startswith(EXTENSION):
            return _make_column(field.name, extension.removeprefix(EXTENSION), *about)
    return _of_name(schema)


def _of_metadata(geo: bytes, schema: "pyarrow.Schema") -> GeometryColumn:
    """Find the column that GeoParquet metadata name."""
    try:
        about = json.loads(geo)
        name = about["primary_column"]
        column = about["columns"][name]
        encoding, crs, edges = column["encoding"].lower(), column.get("crs", WORLD), column.get("edges")
    except (ValueError, KeyError, TypeError, AttributeError):
        raise SourceError('the metadata "geo" of the table are damaged; save it again') from None
    if name not in schema.names:
        raise SourceError(f"its metadata name a column of geometries, {name!r:.60}, that it does not have; {REMEDY}")
    return _make_column(str(name), encoding, crs, edges)


def _make_column(name: str, encoding: str, crs: Any, edges: Any) -> GeometryColumn:
    """Make a column, if its encoding is supported."""
    if encoding not in (WKB, WKT, *DEPTHS):
        raise SourceError(f"its geometries are {encoding!r:.60}; {REMEDY}")
    said = {SPHERICAL: edges not in (None, "planar"), TEXTS: encoding == WKT}
    remarks = tuple(remark for remark, is_so in said.items() if is_so)
    return GeometryColumn(name, encoding, crs if crs is None or isinstance(crs, str) else json.dumps(crs), remarks)


def _extension(field: "pyarrow.Field") -> tuple[str, tuple[Any, Any]]:
    """Return the extension type of a column, with its reference system and the kind of its sides."""
    import pyarrow as pa

    if isinstance(field.type, pa.BaseExtensionType):
        name, about = field.type.extension_name, field.type.__arrow_ext_serialize__()
    else:
        told = field.metadata or {}
        name, about = told.get(b"ARROW:extension:name", b"").decode(), told.get(b"ARROW:extension:metadata", b"")
    try:
        found = json.loads(about or b"{}")
        return name, (found.get("crs"), found.get("edges"))
    except (ValueError, AttributeError):
        return name, (None, None)


def _named_crs(crs: str, metadata: dict[bytes, bytes]) -> str | None:
    """Find the reference system of a GEOMETRY column, named by a number or by a key of the file's metadata."""
    if crs.startswith(PROJJSON):
        found = metadata.get(crs.removeprefix(PROJJSON).encode())
        return crs if found is None else found.decode(errors="replace")
    number = crs.removeprefix(SRID)
    if number.isdecimal():
        return f"EPSG:{int(number)}" if int(number) else None
    return crs


def _of_name(schema: "pyarrow.Schema") -> GeometryColumn:
    """Find the column whose name suggests geometries."""
    import pyarrow as pa

    for field in schema:
        is_text = pa.types.is_string(field.type) or pa.types.is_large_string(field.type)
        is_bytes = pa.types.is_binary(field.type) or pa.types.is_large_binary(field.type)
        if field.name.lower() in NAMES and (is_text or is_bytes):
            return GeometryColumn(field.name, WKT if is_text else WKB, None, (TEXTS,) if is_text else ())
    raise SourceError(
        'the table has no geometries: neither metadata named "geo" nor a column of a type for them; '
        "save it as GeoParquet"
    )


def objects_of(column: "pyarrow.ChunkedArray") -> NDArray[Any]:
    """Convert WKB or texts to objects; None where there is none."""
    import pyarrow as pa

    try:
        return np.asarray(column.to_numpy(zero_copy_only=False), object)
    except pa.ArrowException as error:
        if WRAPPING in str(error)[: 2 * len(WRAPPING)]:  # the rest of the message is the geometry
            if not pa.types.is_binary(column.type) and not pa.types.is_large_binary(column.type):
                return _objects_of_texts(column)
            raise MemoryError from None
        raise


def _objects_of_texts(column: "pyarrow.ChunkedArray") -> NDArray[Any]:
    """Decode texts that may not be in UTF-8; invalid bytes become characters that no WKT has."""
    import pyarrow as pa

    held = column.cast(pa.large_binary()).to_pylist()
    return np.array([None if text is None else text.decode(errors="replace") for text in held] + [None], object)[:-1]


def _of_arrow(array: Any, encoding: str) -> NDArray[Any]:
    """Convert geometries in lists of GeoArrow to WKB."""
    import pyarrow as pa
    import shapely

    array = array.storage if isinstance(array, pa.ExtensionArray) else array
    there = np.asarray(array.is_valid())
    kind = shapely.GeometryType[encoding.upper()]
    points, offsets = _lists_of(array, DEPTHS[encoding])
    made = np.full(len(there), None, object)
    try:
        made[:] = shapely.to_wkb(shapely.from_ragged_array(kind, points, offsets))
    except (ValueError, shapely.errors.GEOSException):
        if len(made) == 1:
            made[0] = BROKEN
        elif len(made):
            check_time()
            half = len(made) // 2
            made[:half], made[half:] = _of_arrow(array[:half], encoding), _of_arrow(array[half:], encoding)
    made[~there] = None
    return made


def _lists_of(array: Any, depth: int) -> tuple[NDArray[np.float64], tuple[NDArray[np.int64], ...]]:
    """Return the coordinates in nested lists, and the ends of the lists, the innermost first."""
    import pyarrow as pa

    offsets: tuple[NDArray[np.int64], ...] = ()
    for _ in range(depth):
        if not (pa.types.is_list(array.type) or pa.types.is_large_list(array.type)):
            raise SourceError(f"its geometries are not in lists of coordinates, as their encoding says; {REMEDY}")
        ends = np.asarray(array.offsets).astype(np.int64)
        array = array.values[int(ends[0]) : int(ends[-1])]
        offsets = (ends - ends[0], *offsets)
    if pa.types.is_fixed_size_list(array.type) and array.type.list_size >= 2:
        size = array.type.list_size
        flat = array.values[array.offset * size : (array.offset + len(array)) * size]
        return _numbers(flat).reshape(-1, size)[:, :2].copy(), offsets
    if pa.types.is_struct(array.type) and {"x", "y"} <= {field.name for field in array.type}:
        both = [_numbers(array.field(array.type.get_field_index(name))) for name in ("x", "y")]
        return np.stack(both, axis=1), offsets
    raise SourceError(f"its geometries have no coordinates x and y, as their encoding says; {REMEDY}")


def _numbers(values: Any) -> NDArray[np.float64]:
    import pyarrow as pa

    return np.asarray(values.cast(pa.float64()).to_numpy(zero_copy_only=False), np.float64)
