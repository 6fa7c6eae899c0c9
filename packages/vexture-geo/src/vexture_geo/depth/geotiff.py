"""Read depths from a GeoTIFF, or from a grid of Esri."""

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from vexture.base.content import TIFF, start_of
from vexture.base.errors import ParameterError, SourceError, reason_of
from vexture.base.notes import Notes
from vexture_geo.base.gdal import open_raster, raster_errors
from vexture_geo.base.lengths import NO_UNIT, metres_in
from vexture_geo.base.time_texts import rising_moments
from vexture_geo.depth.esri_grids import refuse_other_count, refuse_other_size
from vexture_geo.depth.implicit_no_data import codes_of_integers, without_undeclared
from vexture_geo.depth.series import Lattice, Meaning, Reading, Series, Values
from vexture_geo.depth.variables import list_names

if TYPE_CHECKING:
    from rasterio import DatasetReader

FLOATS: Final = ".flt"
"""Suffix of grids of floats."""


@contextmanager
def open_geotiff(
    source: bytes | str | os.PathLike[str], time_dim: str | None, variable: str | None, notes: Notes
) -> Iterator[Series]:
    """Open a GeoTIFF: its first band, or every band as a step if `time_dim` is given, whatever its value.

    The times of steps are read from the descriptions of their bands, if all of these are times.

    `variable` chooses a band by its number, counted from 1, or by its description; `ParameterError` if there is none.
    """
    is_floats = not isinstance(source, bytes) and Path(source).suffix.lower() == FLOATS
    if is_floats and not start_of(source).startswith(TIFF):
        refuse_other_size(Path(os.fspath(source)))  # type: ignore[arg-type]
    with ExitStack() as stack:
        try:
            file = stack.enter_context(open_raster(source, others=True))
        except raster_errors() as error:
            what = "GeoTIFF" if start_of(source).startswith(TIFF) else "a grid of Esri"
            if is_floats:
                raise SourceError(
                    f"it cannot be read as {what}; its header, a .hdr of its name, must be beside it"
                ) from None
            raise SourceError(f"it cannot be read as {what} ({reason_of(error)}); write it again") from None
        refuse_other_count(source, file)
        try:
            series = _series(file, time_dim, variable, notes)
        except raster_errors() as error:
            raise SourceError(f"its tags cannot be read ({reason_of(error)}); write the file again") from None
        yield series


def _series(file: "DatasetReader", time_dim: str | None, variable: str | None, notes: Notes) -> Series:
    """Make the series of an open file."""
    if file.transform.is_identity or file.transform.determinant == 0.0:
        raise SourceError("it does not say where it is (no geotransform); write it with one")
    bands = list(range(1, file.count + 1))
    names = [file.descriptions[band - 1] or f"band {band}" for band in bands]
    if variable is not None:
        chosen = [b for b, name in zip(bands, names, strict=True) if variable in (str(b), name)]
        if not chosen:
            raise ParameterError(f"there is no band {variable!r}; it has {', '.join(names[:8])}")
        bands = chosen
    elif time_dim is None:
        if len(bands) > 1:
            notes.remark(
                f"it has {len(bands)} bands, of which the first is read; `variable` chooses another, `time_dim` makes "
                "them times"
            )
        bands = bands[:1]
    a, b, c, d, e, f = file.transform[:6]
    affine = np.array([[a, b, c], [d, e, f]], np.float64)
    lattice = Lattice(np.arange(file.width) + 0.5, np.arange(file.height) + 0.5, affine)

    metres = _metres(file, bands)

    def read(step: int, rows: slice, columns: slice) -> Reading:
        return Reading(metres * _band(file, bands[step], rows, columns, metres, notes))

    crs = file.crs.to_wkt() if file.crs else None
    return Series(lattice, crs, names[bands[0] - 1], _times(file, bands, notes), read, _meaning(file, bands))


def _times(file: "DatasetReader", bands: Sequence[int], notes: Notes) -> tuple[datetime | None, ...]:
    """Read the times of bands from their descriptions."""
    texts = [file.descriptions[band - 1] or "" for band in bands]
    times = rising_moments(texts) if len(bands) > 1 else None
    if times is None and len(bands) > 1 and any(texts):
        notes.remark(
            f"its steps are numbered: descriptions of its bands ({list_names(texts)}) are no rising times; write "
            "2026-01-01T06:00 or the like"
        )
    return times or (None,) * len(bands)


def _meaning(file: "DatasetReader", bands: Sequence[int]) -> Meaning:
    """Determine the meaning of the numbers of bands."""
    from rasterio.enums import ColorInterp

    is_picture = {ColorInterp.red, ColorInterp.green, ColorInterp.blue} <= set(file.colorinterp)
    has_table = any(file.colorinterp[band - 1] == ColorInterp.palette for band in bands)
    packed = [(file.scales[band - 1], file.offsets[band - 1]) for band in bands]
    whole = all(np.dtype(file.dtypes[band - 1]).kind in "iu" for band in bands) and set(packed) == {(1.0, 0.0)}
    units = {(file.units[band - 1] or "").strip().lower() for band in bands}
    return Meaning((), not units <= NO_UNIT, whole, whole and (is_picture or has_table))


def _metres(file: "DatasetReader", bands: Sequence[int]) -> float:
    """Length of the unit of bands in metres; 1 if the file states none."""
    units = {(file.units[band - 1] or "").strip() for band in bands}
    found = {metres_in(unit) for unit in units}
    if len(found) > 1:
        raise SourceError(f"its bands are in several units ({', '.join(map(repr, sorted(units)))}); write one for all")
    (metres,) = found
    if metres is None:
        raise SourceError(f"its values are in {units.pop()!r}, no unit of length that is known; write depths in metres")
    return metres


def _band(file: "DatasetReader", band: int, rows: slice, columns: slice, metres: float, notes: Notes) -> Values:
    """Read a band, whose unit has a length of `metres`, in metres."""
    from rasterio.windows import Window

    stride = rows.step
    shape = (len(range(rows.start, rows.stop, stride)), len(range(columns.start, columns.stop, stride)))
    corner = (columns.start - stride // 2, rows.start - stride // 2)
    window = Window(*corner, shape[1] * stride, shape[0] * stride)  # type: ignore[no-untyped-call,unused-ignore]
    try:
        read: Any = file.read(band, window=window, out_shape=shape, masked=True)
        scale, offset = file.scales[band - 1], file.offsets[band - 1]
    except raster_errors() as error:
        raise SourceError(f"band {band} cannot be read ({reason_of(error)}); write the file again") from None
    with np.errstate(invalid="ignore", over="ignore"):  # values that are not finite are no depths
        values: Values = read.filled(0).astype(np.float64) * scale + offset
    values[np.ma.getmaskarray(read)] = np.nan
    codes = () if file.nodatavals[band - 1] is not None else codes_of_integers(file.dtypes[band - 1], scale, offset)
    return without_undeclared(values, codes, metres, f"band {band}", notes, are_depths=True)
