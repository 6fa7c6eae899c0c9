"""Vector files of geographic data as rings.

GDAL reads all formats but GeoJSON. It gets a file only if the first bytes are those of a supported format, and only
in memory, so that it opens, fetches and writes nothing else, whatever the file refers to.
"""

import os
import warnings
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from io import BytesIO
from pathlib import Path
from threading import Lock
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.content import (
    FLATGEOBUF,
    LARGEST_FILE,
    SHAPEFILE,
    SQLITE,
    ZIP,
    FileKind,
    decompressed,
    kind_of,
    read_bytes,
    start_of,
)
from vexture.errors import LimitError, ParameterError, SourceError, reason_of
from vexture.geo.curves import straightened
from vexture.geo.damage import refuse_cut
from vexture.geo.gdal import vector_formats
from vexture.geo.geojson import UNLOCATED, areas_of
from vexture.geo.geopackage import refuse_links_of_geopackage
from vexture.geo.named import refuse_files_of_system
from vexture.geo.rings import Rings, rings_of
from vexture.notes import Notes

__all__ = [
    "DAMAGED",
    "check_memory",
    "chosen_layer",
    "gdal_errors",
    "gdal_reason",
    "is_memory",
    "parsed_wkb",
    "parts_of",
    "read_areas",
    "refuse_links_of_flatgeobuf",
    "refuse_links_of_shapefile",
    "whole_shapefile",
    "zipped_shapefiles",
]

PARTS: Final = (".shp", ".shx", ".dbf", ".prj", ".cpg")
"""Files of one shapefile, of which the first two are required."""

SIZE_OF_HEADER: Final = slice(8, 12)
HEADER_START: Final = 12
FLATGEOBUF_HEADER: Final = 16 * 2**20
"""Where a FlatGeobuf says the size of its header, where that starts, and more bytes than GDAL takes."""

AREAL: Final = ("Polygon", "Surface", "Unknown", "GeometryCollection", "Triangle", "TIN")
"""Words in the geometry types of layers that may hold polygons."""

QUIET: Final = Lock()
"""Held while Python's warnings are silenced: the filter is common to all threads."""

DAMAGED: Final = "feature whose geometry is damaged, or has a line or ring of too few points"

NO_MEMORY: Final = "bad_alloc"
"""What GEOS and GDAL say where there is none."""

MOST_NAMED: Final = 12
"""Layers that a message names."""


def read_areas(
    source: str | os.PathLike[str] | bytes, file_name: str, layer: str | None, notes: Notes
) -> tuple[Rings, str | None]:
    """Polygons of a vector file, in its own coordinates, and the reference system that it names.

    `LimitError` if it has several layers and `layer` is None, `ParameterError` if it has no such layer.
    """
    content = decompressed(source) if isinstance(source, bytes) else read_bytes(source)
    kind = kind_of(start_of(content), file_name)
    if kind is FileKind.TEXTURE:
        raise SourceError("is a texture already; give the data that it was made from")
    if kind is FileKind.GEOJSON:
        if layer is not None:
            raise ParameterError(f"GeoJSON has no layers, so none {layer!r}; leave `layer` out")
        return _geojson(content, notes)
    if content.startswith(SHAPEFILE):
        if isinstance(source, bytes):
            raise SourceError("a shapefile is several files; give them together as a .zip")
        content = whole_shapefile(Path(source))
    elif content.startswith(ZIP):
        content = zipped_shapefiles(content)
    elif content.startswith(SQLITE):
        import_module("pyogrio")  # who lacks it is told so first
        refuse_links_of_geopackage(content)
    elif content.startswith(FLATGEOBUF):
        refuse_links_of_flatgeobuf(content)
    else:
        raise SourceError("none of GeoJSON, GeoPackage, FlatGeobuf and shapefile; convert it to one of them")
    return _gdal(content, layer, notes)


def _geojson(content: bytes, notes: Notes) -> tuple[Rings, str | None]:
    areas, crs = areas_of(content, notes)
    rings = [ring for area in areas for ring in area.rings]
    owner = np.repeat(np.arange(len(areas)), [len(area.rings) for area in areas]).astype(np.intp)
    ends = np.cumsum([len(ring) for ring in rings]).astype(np.intp)
    points = np.concatenate(rings) if rings else np.empty((0, 2))
    return Rings(points, ends, owner, lambda index: areas[index].where), crs


def whole_shapefile(path: Path) -> bytes:
    """Content of a ``.shp`` and of the files beside it, in one zip; equal files give equal bytes."""
    try:
        beside = {each.name.lower(): each for each in path.parent.iterdir()}
    except OSError as error:
        raise SourceError(f"its folder cannot be read: {error.strerror}; the files beside it are needed") from None
    found = {part: beside.get(path.stem.lower() + part) for part in PARTS} | {".shp": path}
    return _zipped({f"{path.stem}{part}": read_bytes(each) for part, each in found.items() if each is not None})


def refuse_links_of_shapefile(path: Path) -> None:
    """Raise a `SourceError` if the .prj beside a ``.shp`` names a file or an address."""
    for beside in path.parent.iterdir():
        if beside.name.lower() == f"{path.stem.lower()}.prj":
            refuse_files_of_system(read_bytes(beside).decode(errors="replace"))


def refuse_links_of_flatgeobuf(source: str | os.PathLike[str] | bytes) -> None:
    """Raise a `SourceError` if the reference system in the header of a FlatGeobuf names a file or an address."""
    if isinstance(source, bytes):
        start = source[:FLATGEOBUF_HEADER]
    else:
        with Path(source).open("rb") as file:
            start = file.read(FLATGEOBUF_HEADER)
    header = start[: HEADER_START + int.from_bytes(start[SIZE_OF_HEADER], "little")]
    refuse_files_of_system(header.decode("latin-1"))


def zipped_shapefiles(content: bytes) -> bytes:
    """The shapefiles of a zip as one zip of their files only."""
    return _zipped(_members(content))


def _members(content: bytes) -> dict[str, bytes]:
    """Files of the shapefiles in a zip, by name."""
    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            infos = [info for info in archive.infolist() if Path(info.filename).suffix.lower() in PARTS]
            if sum(info.file_size for info in infos) > LARGEST_FILE:
                raise SourceError(f"its shapefiles are larger than {LARGEST_FILE:,} bytes; split them")
            return {Path(info.filename).name: archive.read(info) for info in infos}
    except (zipfile.BadZipFile, zlib.error, RuntimeError, NotImplementedError, EOFError, OSError, ValueError) as error:
        raise SourceError(f"the zip is damaged or encrypted ({reason_of(error)}); zip the shapefile again") from None


def _zipped(files: dict[str, bytes]) -> bytes:
    """Files of shapefiles in one zip."""
    named = {Path(name).stem + Path(name).suffix.lower(): content for name, content in files.items()}
    stems = [Path(name).stem for name in named if name.endswith(".shp")]
    if not stems:
        raise SourceError("the zip holds no shapefile (.shp); zip the .shp, .shx, .dbf and .prj together")
    for stem in stems:
        if f"{stem}.shx" not in named:
            raise SourceError(f"the shapefile {stem}.shp lacks its {stem}.shx; keep its files together")
        for name in (f"{stem}.shp", f"{stem}.shx"):
            refuse_cut(name, named[name], len(named[name]))
        refuse_files_of_system(named.get(f"{stem}.prj", b"").decode(errors="replace"))
    packed = BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name, content in named.items():
            archive.writestr(zipfile.ZipInfo(name), content)  # without a time: equal files give equal bytes
    return packed.getvalue()


def _gdal(content: bytes, layer: str | None, notes: Notes) -> tuple[Rings, str | None]:
    """Polygons that GDAL reads."""
    from pyogrio import list_layers, raw

    with gdal_errors():
        name = chosen_layer([(str(each), str(kind)) for each, kind in list_layers(content)], layer)
        meta, _, shapes, _ = raw.read(content, layer=name, columns=[], force_2d=True)
    if shapes is None:
        raise SourceError(f"its layer {name!r} has no geometries; choose another by `layer`")
    return _parsed(shapes, notes), meta["crs"]


@contextmanager
def gdal_errors() -> Iterator[None]:
    """Let GDAL read features, silence its warnings, and turn what it raises into a `SourceError`."""
    with QUIET, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # warnings of GDAL; invalid geometries are found later
        try:
            with vector_formats():
                yield
        except ParameterError:  # of `layer`; it is a ValueError too
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


def gdal_reason(error: Exception) -> str:
    """What GDAL says, without its internals."""
    text = " ".join(str(error).split()).rpartition("Raw error: ")[2]
    if isinstance(error, NameError):
        return "its reference system is damaged"
    if "sqlite3" in text:  # followed by the query
        return "its database is damaged"
    start = text.find("/vsi")
    if start >= 0:  # the name of a file in memory
        text = "the file" + text[start:].partition("'")[2] if "'" in text[start:] else "damaged"
    return text[:160]


def chosen_layer(layers: list[tuple[str, str]], wanted: str | None, *, any_kind: bool = False) -> str:
    """Name of the layer to read: one that may hold polygons, unless `any_kind`."""
    names = [name for name, _ in layers]
    areal = [name for name, kind in layers if any_kind or any(word in kind for word in AREAL)]
    if wanted is None:
        if len(areal) == 1 or len(names) == 1:
            return (areal or names)[0]
        if not names:
            raise SourceError("it has no layers; save it again")
        raise LimitError(f"it has {len(areal or names)} layers; choose one by `layer`: {_named(areal or names)}")
    if wanted not in names:
        raise ParameterError(f"it has no layer {wanted!r}; its layers are: {_named(names)}")
    return wanted


def _named(layers: list[str]) -> str:
    return ", ".join(layers[:MOST_NAMED]) + (", ..." if len(layers) > MOST_NAMED else "")


def parsed_wkb(shapes: NDArray[Any], notes: Notes) -> tuple[NDArray[Any], NDArray[np.intp], NDArray[np.intp]]:
    """Geometries of WKB as shapely's, and the place of each; what has none is noted and left out.

    The places of damaged ones, which are left out as well, come last.

    Raises a `SourceError` if none is sound.
    """
    import shapely

    given = np.array([shape is not None and shape != b"" for shape in shapes], np.bool_)  # as GDAL says that
    for _ in range(int((~given).sum())):
        notes.left_out(UNLOCATED)
    feature = np.flatnonzero(given)
    shapes = straightened(shapes)
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
    """Raise a `MemoryError` if that is why a geometry was not read, and not because it is damaged."""
    import shapely

    try:
        shapely.from_wkb(shape)  # which fails again only if it is damaged
    except shapely.errors.GEOSException as error:
        if not is_memory(error):
            return
    raise MemoryError


def is_memory(error: Exception) -> bool:
    """Whether GEOS had not enough memory."""
    return NO_MEMORY in str(error)


def parts_of(whole: NDArray[Any]) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """Points, lines and polygons of geometries, and the place of the geometry of each."""
    import shapely

    parts, owner = shapely.get_parts(whole, return_index=True)
    while (shapely.get_type_id(parts) > shapely.GeometryType.POLYGON).any():  # collections in collections
        parts, inner = shapely.get_parts(parts, return_index=True)
        owner = owner[inner]
    return parts, owner


def _parsed(shapes: NDArray[Any], notes: Notes) -> Rings:
    """Polygons of geometries in WKB."""
    import shapely

    whole, feature, _ = parsed_wkb(shapes, notes)
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
