"""Settings of GDAL: named formats, only the requested files and addresses, little memory, no messages.

Rasters whose metadata name other files are refused, and so are rasters beside files that GDAL would open and that lead
elsewhere.
"""

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from threading import RLock
from typing import TYPE_CHECKING, Final

from vexture.base.content import ESRI_GRID, NETCDF, TIFF, start_of
from vexture.base.errors import DeviceError, SourceError, printable, reason_of, shorten_text
from vexture_geo.base.damage import netcdf_error
from vexture_geo.base.file_references import refuse_files_of_system
from vexture_geo.base.hdf5 import refuse_links_of_netcdf
from vexture_geo.base.quiet_output import quiet_output

if TYPE_CHECKING:
    from rasterio import DatasetReader

CACHE: Final = 128 * 2**20
"""Bytes of the cache of blocks, which by default takes a twentieth of the memory. A row of blocks of a raster of 50,000
columns has 100 MB."""

GEOTIFF: Final = "GTiff"
GRIB_DRIVER: Final = "GRIB"
NETCDF_DRIVER: Final = "netCDF"
OTHERS: Final[Mapping[str, tuple[bytes, ...]]] = {
    "AAIGrid": ESRI_GRID,
    NETCDF_DRIVER: NETCDF,
}
"""Formats of rasters, none of which lists other files, and their first bytes in lower case."""

FLOATS: Final = ("EHdr", ".flt")
"""Format and suffix of a file of bare numbers; the .hdr beside it names no other files."""

VECTORS: Final = (
    *("ESRI Shapefile", "FlatGeobuf", "GML", "GPKG", "GPX", "GeoJSON", "KML", "LIBKML", "OpenFileGDB", "SQLite"),
    "TopoJSON",
)
"""Formats of features; GDAL is given only those that a file may have. It knows 60 more by words anywhere at the start
of a file: some are lists of other files, addresses or commands."""

OFFLINE: Final[Mapping[str, str]] = {
    "CPL_LOG": os.devnull,
    "CPL_VSIL_CURL_ALLOWED_EXTENSIONS": ".none",
    "GDAL_HTTP_PROXY": "127.0.0.1:9",  # no server answers here
    "GML_SKIP_RESOLVE_ELEMS": "ALL",
    "LIBKML_EXTERNAL_STYLE": "NO",
    "OGR_ARC_STEPSIZE": "0.5",  # degrees: chords deviate from the arc by less than 1e-5 of the radius
    "OGR_SQLITE_ALLOW_EXTERNAL_ACCESS": "NO",
    "OGR_SQLITE_LOAD_EXTENSIONS": "NO",
    "OSR_SET_FROM_USER_INPUT_ALLOW_FILE_ACCESS": "NO",
    "OSR_SET_FROM_USER_INPUT_ALLOW_NETWORK_ACCESS": "NO",
}
"""Options that silence GDAL, keep it from fetching anything should a link ever reach it, and refine arcs."""

DATASETS: Final = (".ovr", ".msk")
"""Suffixes of files beside a raster that GDAL opens as rasters of any format."""

IMAGINE: Final = b"EHFA_HEADER_TAG"
"""First bytes of an .aux that GDAL opens together with the files that it names."""

LARGEST_NOTE: Final = 16 * 2**20
"""Most bytes of an .aux.xml or .prj; GDAL writes some thousands."""

LINKS: Final = ("OVERVIEW_FILE", "X_DATASET", "Y_DATASET")
"""Metadata that name other files: of overviews, and of the places of pixels."""

IN_ADDRESSES: Final = "!;?#"
"""Characters at which pyogrio splits names of files."""

SYSTEMS: Final = ("crs", "srs", "spatial_ref", "proj", "wkt", "pe_string")
"""Words in the names of NetCDF attributes that describe a reference system."""

CHANGING: Final = RLock()
"""Lock held while GDAL knows fewer formats of features than usual."""

SHOWN: Final = 80
"""Characters of a link in a message."""


@contextmanager
def gdal(**options: str) -> Iterator[None]:
    """Read rasters within this context."""
    import rasterio

    with rasterio.Env(GDAL_CACHEMAX=CACHE, **OFFLINE, **options):
        yield


@contextmanager
def open_raster(source: str | os.PathLike[str] | bytes, *, others: bool = False) -> Iterator["DatasetReader"]:
    """Open a GeoTIFF or, with `others`, a grid of Esri (.asc, .flt) or of NetCDF, which refers to no other file.

    Raises a `SourceError` that names the link if it does, and rasterio's errors if it cannot be opened.
    """
    import rasterio
    from rasterio.io import MemoryFile

    start = start_of(source).lstrip().lower()
    known = (name for name, starts in OTHERS.items() if others and start.startswith(tuple(map(bytes.lower, starts))))
    driver = next(known, GEOTIFF)
    if others and driver == GEOTIFF and not start.startswith(tuple(map(bytes.lower, TIFF))):
        named = "" if isinstance(source, bytes) else Path(source).suffix.lower()
        driver = FLOATS[0] if named == FLOATS[1] else driver
    if not isinstance(source, bytes):
        path = Path(source).absolute()  # never an address, whatever its name
        refuse_links_beside(path)
        refuse_links_of_netcdf(path)
        if driver == NETCDF_DRIVER:
            _refuse_systems_of_netcdf(path)
    with ExitStack() as stack:
        stack.enter_context(gdal())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about a missing place or reference system, which the reader reports
            if isinstance(source, bytes):
                memory = stack.enter_context(MemoryFile(source))
                file = stack.enter_context(memory.open(driver=driver))
            else:
                file = stack.enter_context(rasterio.open(path, driver=driver))
        refuse_links_in(file)
        yield file


@contextmanager
def open_grib(content: bytes) -> Iterator["DatasetReader"]:
    """Open the content of a GRIB file with units as written, and without an index of its messages.

    Raises rasterio's errors if it cannot be opened.
    """
    from rasterio.io import MemoryFile

    with ExitStack() as stack:
        stack.enter_context(gdal(GRIB_NORMALIZE_UNITS="NO"))
        memory = stack.enter_context(MemoryFile(content))
        with quiet_output(), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about a missing place, which the reader reports
            file = stack.enter_context(memory.open(driver=GRIB_DRIVER, USE_IDX="NO"))
        refuse_links_in(file)
        yield file


def refuse_links_in(file: "DatasetReader") -> None:
    """Refuse an open raster whose metadata name another file, before that file is opened."""
    for domain in file.tag_namespaces():
        for name, value in file.tags(ns=domain).items():
            if name.upper() in LINKS:
                raise SourceError(f"{_link(name, value)}; write it again without: gdal_translate keeps none")
    if file.crs:
        refuse_files_of_system(file.crs.to_wkt())


def refuse_links_beside(path: Path) -> None:
    """Refuse a raster with a file beside it that GDAL would open and that can lead elsewhere."""
    try:
        around = sorted(path.parent.iterdir()) if path.parent.is_dir() else []
    except OSError as error:
        raise SourceError(
            f"its folder cannot be read ({error.strerror}); what is beside it can lead elsewhere"
        ) from None
    for beside in around:
        is_own = beside.name.lower().startswith(f"{path.stem.lower()}.") and beside.name != path.name
        if is_own and beside.is_file():
            why = _why_not(beside)
            if why:
                raise SourceError(f"{printable(beside.name)} beside it {why}; remove that file, or make it again")


def raster_errors() -> tuple[type[Exception], ...]:
    """Errors that rasterio raises for a damaged file; for a tag, it raises GDAL's own."""
    from rasterio._err import CPLE_BaseError
    from rasterio.errors import RasterioError

    return RasterioError, CPLE_BaseError, OSError


def _why_not(path: Path) -> str:
    """Explain why a file beside a raster is refused; an empty text if it leads nowhere."""
    import rasterio

    start, end = start_of(path), path.suffix.lower()
    if end in DATASETS:
        if not start.startswith(TIFF):
            return "is no TIFF, and can lead to other files"
        try:
            with gdal(GDAL_DISABLE_READDIR_ON_OPEN="EMPTY_DIR"), rasterio.open(path, driver=GEOTIFF) as file:
                refuse_links_in(file)
        except raster_errors():
            return "is damaged"
        except SourceError as error:
            return f"is not to be trusted ({error})".partition("; ")[0].removesuffix(")") + ")"
    elif end == ".aux" and start.startswith(IMAGINE):
        return "is of a format that names other files"
    elif path.name.lower().endswith((".aux.xml", ".prj")):
        with path.open("rb") as opened:
            content = opened.read(LARGEST_NOTE + 1)
        if len(content) > LARGEST_NOTE:
            return f"has more than {LARGEST_NOTE:,} bytes"
        try:
            if end == ".prj":
                refuse_files_of_system(content.decode(errors="replace"))
            else:
                _refuse_metadata(content)
        except SourceError as error:
            return f"is not to be trusted ({error})".partition("; ")[0].removesuffix(")") + ")"
    return ""


def _refuse_metadata(content: bytes) -> None:
    """Refuse an .aux.xml that names another file."""
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        root = etree.fromstring(content, parser)
    except etree.XMLSyntaxError as error:
        raise SourceError(f"it is no XML ({reason_of(error)})") from None
    for item in root.iter("{*}*"):
        key, text = str(item.get("key", "")), "".join(map(str, item.itertext()))
        if key.upper() in LINKS:
            raise SourceError(_link(key, text))
        if etree.QName(item).localname.upper() == "SRS":
            refuse_files_of_system(text)


def plain_place(source: str | os.PathLike[str] | bytes) -> str:
    """Absolute path of a file of features, in a form that pyogrio does not split as an address."""
    place = os.path.abspath(os.fsdecode(source))
    found = next((character for character in IN_ADDRESSES if character in place), None)
    if found:
        raise SourceError(f"the name of its place, {printable(place)!r}, has a {found}, as addresses have; rename it")
    return place


def _refuse_systems_of_netcdf(path: Path) -> None:
    """Refuse NetCDF with a reference system in any attribute that names a file, because GDAL reads all of them."""
    import netCDF4

    try:
        with netCDF4.Dataset(path) as file:
            left = [file]
            while left:
                one = left.pop()
                left += [*getattr(one, "groups", {}).values(), *getattr(one, "variables", {}).values()]
                for name in one.ncattrs():
                    if any(word in name.lower() for word in SYSTEMS):
                        refuse_files_of_system(str(one.getncattr(name)))
    except (OSError, RuntimeError, ValueError, AttributeError) as error:  # netCDF4 raises each of them
        raise netcdf_error(error, str(path)) from None


def _link(name: str, value: str) -> str:
    shown = printable(shorten_text(" ".join(value.split()), SHOWN))
    return f"its metadata name another file, {shown!r} ({name}), and no other file is read"


@contextmanager
def vector_formats(formats: Sequence[str]) -> Iterator[None]:
    """Restrict GDAL to some of the `VECTORS` formats within this context.

    The list belongs to pyogrio's GDAL and is restored afterwards, because other users of pyogrio may need more formats.
    """
    import pyogrio
    from pyogrio._ogr import _register_drivers  # no other way to restrict the formats that GDAL tries

    with CHANGING:
        before = {name: pyogrio.get_gdal_config_option(name) for name in ("GDAL_SKIP", *OFFLINE)}
        others = [name for name in pyogrio.list_drivers() if name not in formats or name not in VECTORS]
        try:
            pyogrio.set_gdal_config_options({"GDAL_SKIP": ",".join([*others, before["GDAL_SKIP"] or ""]), **OFFLINE})
            _register_drivers()
            if not set(pyogrio.list_drivers()) <= {*formats}:
                raise DeviceError("this pyogrio does not keep to some formats; install another: pip install -U pyogrio")
            yield
        finally:
            pyogrio.set_gdal_config_options(before)
            _register_drivers()
