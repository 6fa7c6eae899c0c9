"""Read vector files of geographic data as rings.

GDAL reads all formats but GeoJSON and tables.
"""

import os
import re
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from threading import Lock
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import FileKind, decompress, is_geodatabase, kind_of, read_bytes, start_of
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.notes import Notes
from vexture_geo.base.gdal import vector_formats
from vexture_geo.base.rings import Rings, rings_of
from vexture_geo.vector.archives import unzip
from vexture_geo.vector.curves import straighten_curves
from vexture_geo.vector.geojson import UNLOCATED, areas_of
from vexture_geo.vector.sequences import one_json
from vexture_geo.vector.vector_files import VectorFile, open_vectors

AREAL: Final = ("Polygon", "Surface", "Unknown", "GeometryCollection", "Triangle", "TIN")
"""Words in geometry types of layers that may contain polygons."""

QUIET: Final = Lock()
"""Lock held while Python's warnings are silenced, because all threads share the filter."""

DAMAGED: Final = "feature whose geometry is damaged, or has a line or ring of too few points"

NO_MEMORY: Final = "bad_alloc"
"""Word in messages of GEOS and GDAL about lack of memory."""

MOST_NAMED: Final = 12
"""Most layers that a message names."""

POINTS_OF_LINES: Final = "_points"
"""Suffix of the names of layers that hold the points of another layer's lines."""

OF_MEMORY: Final = re.compile("pyogrio_[0-9a-f]{32}")
"""Name of a file in memory, which a layer without a name gets and which changes each time the file is opened."""

UNNAMED: Final = "unnamed"
"""Name used here for such a layer."""

FORMATS: Final = "not recognized as being in a supported file format"
"""GDAL's message about damage in the first bytes; advice on its own options follows."""

SCHEMAS: Final = "*.gfs"
"""Files in memory in which GDAL caches the schema of GML."""


class Layer(NamedTuple):
    """Layer of a file: its number, by which it is opened, its name, and the kind of its geometries, if any."""

    number: int
    name: str
    kind: str | None


def read_areas(
    source: str | os.PathLike[str] | bytes, file_name: str, layer: str | None, notes: Notes
) -> tuple[Rings, str | None]:
    """Read the polygons of a vector file in its own coordinates, and the reference system that it names.

    Raises a `LimitError` if it has several layers and `layer` is None, and a `ParameterError` if it has no such layer.
    """
    source = unzip(decompress(source) if isinstance(source, bytes) else source)
    kind = FileKind.AREAS if is_geodatabase(source) else kind_of(start_of(source) or read_bytes(source), file_name)
    if kind is FileKind.TEXTURE:
        raise SourceError("is a texture already; give the data that it was made from")
    if kind is FileKind.GEOJSON:
        if layer is not None:
            raise ParameterError(f"GeoJSON has no layers, so none {layer!r}; leave `layer` out")
        return _geojson(one_json(read_bytes(source)), notes)
    import_module("pyogrio")  # reports a missing package before anything else
    with open_vectors(source) as file:
        for link, count in file.links.items():
            notes.remark(link, count)
        return _gdal(file, layer, notes)


def _geojson(content: bytes, notes: Notes) -> tuple[Rings, str | None]:
    areas, crs = areas_of(content, notes)
    rings = [ring for area in areas for ring in area.rings]
    owner = np.repeat(np.arange(len(areas)), [len(area.rings) for area in areas]).astype(np.intp)
    ends = np.cumsum([len(ring) for ring in rings]).astype(np.intp)
    points = np.concatenate(rings) if rings else np.empty((0, 2))
    return Rings(points, ends, owner, lambda index: areas[index].where), crs


def _gdal(file: VectorFile, layer: str | None, notes: Notes) -> tuple[Rings, str | None]:
    """Read polygons with GDAL."""
    from pyogrio import raw

    with gdal_errors(file.formats):
        chosen = choose_layer(layers_of(file, layer), layer)
        meta, _, shapes, _ = raw.read(file.content, layer=chosen.number, columns=[], force_2d=True)
    if shapes is None:
        raise SourceError(f"its layer {chosen.name!r} has no geometries; choose another by `layer`")
    return areas_of_wkb(shapes, notes), meta["crs"]


def layers_of(file: VectorFile, name: str | None) -> list[Layer]:
    """List the layers to choose from, within `gdal_errors`.

    For a format with fixed layers, these are the layers with features, unless one is `name`. Layers with the points of
    another layer are left out: GPX repeats the points of its routes and tracks in such layers.
    """
    from pyogrio import list_layers, read_info

    found = [
        Layer(number, OF_MEMORY.sub(UNNAMED, str(name)), None if kind is None else str(kind))
        for number, (name, kind) in enumerate(list_layers(file.content))
    ]
    if not file.has_fixed_layers or name is not None:
        return found
    own = [layer for layer in found if not layer.name.endswith(POINTS_OF_LINES)]
    infos = (read_info(file.content, layer=layer.number, force_feature_count=True) for layer in own)
    return [layer for layer, info in zip(own, infos, strict=True) if info["features"]] or own[:1]


@contextmanager
def gdal_errors(formats: Sequence[str]) -> Iterator[None]:
    """Let GDAL read features in some formats, silence its warnings, and turn its errors into a `SourceError`."""
    with QUIET, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # warnings of GDAL; invalid geometries are found later
        try:
            with vector_formats(formats):
                yield
                if "GML" in formats:
                    _forget_schemas()
        except ParameterError:  # about `layer`; it is a ValueError too
            raise
        except (
            RuntimeError,
            ValueError,
            OverflowError,
            OSError,
            NameError,
        ) as error:  # the last is pyogrio's for a bad .prj
            if is_memory(error):
                raise MemoryError from None
            raise SourceError(f"GDAL cannot read it ({gdal_reason(error)}); save it again") from None


def _forget_schemas() -> None:
    from pyogrio import vsi_listtree, vsi_unlink

    for path in vsi_listtree("/vsimem/", SCHEMAS):
        vsi_unlink(path)


def gdal_reason(error: Exception) -> str:
    """Shorten GDAL's message, without internals."""
    text = " ".join(str(error).split()).rpartition("Raw error: ")[2]
    if isinstance(error, NameError):
        return "its reference system is damaged"
    if FORMATS in text:
        return f"the file is {FORMATS}, or damaged"
    if "sqlite3" in text:  # the query follows
        return "its database is damaged"
    start = text.find("/vsi")
    if start >= 0:  # the name of a file in memory
        text = "the file" + text[start:].partition("'")[2] if "'" in text[start:] else "damaged"
    return text[:160]


def choose_layer(layers: list[Layer], name: str | None, *, any_kind: bool = False) -> Layer:
    """Choose the layer to read: one that may contain polygons, or any with `any_kind`."""
    areal = [layer for layer in layers if any_kind or any(word in str(layer.kind) for word in AREAL)]
    if name is None:
        if len(areal) == 1 or len(layers) == 1:
            return (areal or layers)[0]
        if not layers:
            raise SourceError("it has no layers; save it again")
        raise LimitError(f"it has {len(areal or layers)} layers; choose one by `layer`: {_join_names(areal or layers)}")
    for layer in layers:
        if layer.name == name:
            return layer
    raise ParameterError(f"it has no layer {name!r}; its layers are: {_join_names(layers)}")


def _join_names(layers: list[Layer]) -> str:
    return ", ".join(layer.name for layer in layers[:MOST_NAMED]) + (", ..." if len(layers) > MOST_NAMED else "")


def parse_wkb(shapes: NDArray[Any], notes: Notes) -> tuple[NDArray[Any], NDArray[np.intp], NDArray[np.intp]]:
    """Parse WKB with shapely; return the geometries and the place of each. Missing geometries are noted and left out.

    The places of damaged geometries, also left out, are returned last.

    Raises a `SourceError` if none is sound.
    """
    import shapely

    given = np.array([bool(shape) for shape in shapes], np.bool_)  # FlatGeobuf has empty bytes for no geometry
    for _ in range(int((~given).sum())):
        notes.left_out(UNLOCATED)
    feature = np.flatnonzero(given)
    shapes = straighten_curves(shapes)
    with np.errstate(invalid="ignore"):  # NaN is refused later, with the name of its ring
        whole = shapely.from_wkb(shapes[given], on_invalid="fix")
    broken = shapely.is_missing(whole)
    if broken.any():
        first = int(broken.argmax())
        check_memory(shapes[given][first])
        if broken.all():
            raise SourceError("each geometry is damaged, or has a line or ring of too few points; save the file again")
        for _ in range(int(broken.sum())):
            notes.left_out(DAMAGED)
    damaged, whole, feature = feature[broken], whole[~broken], feature[~broken]
    empty = shapely.is_empty(whole)
    for _ in range(int(empty.sum())):
        notes.left_out(UNLOCATED)
    return whole[~empty], feature[~empty], damaged


def check_memory(shape: bytes) -> None:
    """Raise a `MemoryError` if a geometry was not read for lack of memory rather than damage."""
    import shapely

    try:
        shapely.from_wkb(shape)  # fails again only if it is damaged
    except shapely.errors.GEOSException as error:
        if not is_memory(error):
            return
    raise MemoryError


def is_memory(error: Exception) -> bool:
    """Return whether GEOS lacked memory."""
    return NO_MEMORY in str(error)


def parts_of(whole: NDArray[Any]) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """Split geometries into points, lines and polygons; return these and the place of the geometry of each."""
    import shapely

    parts, owner = shapely.get_parts(whole, return_index=True)
    while (shapely.get_type_id(parts) > shapely.GeometryType.POLYGON).any():  # collections in collections
        parts, inner = shapely.get_parts(parts, return_index=True)
        owner = owner[inner]
    return parts, owner


def areas_of_wkb(shapes: NDArray[Any], notes: Notes) -> Rings:
    """Read the polygons of geometries in WKB."""
    import shapely

    whole, feature, _ = parse_wkb(shapes, notes)
    parts, owner = parts_of(whole)
    kinds = shapely.get_type_id(parts)
    areal = kinds == shapely.GeometryType.POLYGON
    for part in parts[~areal]:
        notes.left_out(part.geom_type)
    polygons, feature = parts[areal], feature[owner[areal]]

    def place(index: int) -> str:
        number = index - int(np.searchsorted(feature, feature[index])) + 1
        several = (feature == feature[index]).sum() > 1
        return f"feature {feature[index] + 1}" + (f", polygon {number}" if several else "")

    return rings_of(polygons, place)
