"""Detect unsupported formats of flood models by their first bytes or their structure, and say how to convert them.

All formats except those of MIKE are mesh layers of QGIS, whose tool writes a GeoTIFF; mikeio reads those of MIKE.
"""

import os
from pathlib import Path
from typing import Any, Final

from vexture.base.content import NETCDF
from vexture.base.errors import SourceError

QGIS: Final = (
    'add it to QGIS as a mesh layer, and write the depth as GeoTIFF by the tool "Rasterize mesh dataset" of Processing'
)
RAS_MAPPER: Final = "write the depth as GeoTIFF: a stored map of RAS Mapper, with the parameter Depth"
MIKEIO: Final[dict[str, str]] = {
    ".dfs0": "it is of points, and has no area; give the .dfs2 or .dfsu of the run",
    ".dfsu": "bring it onto a grid by mikeio (interp_like, with its get_overset_grid), and write that by to_xarray()"
    ".to_netcdf()",
}
"""Remedies for files of MIKE by suffix, because their first bytes are alike."""

DFS2: Final = "write it as NetCDF by mikeio: mikeio.read(IN).to_xarray().to_netcdf(OUT)"

RECORD: Final = (80).to_bytes(4, "big"), (80).to_bytes(4, "little")
"""First bytes of Selafin: the length of its title, as a Fortran record."""

TITLE: Final = slice(76, 84)
"""Position of the name of Selafin, at the end of the title."""

SMS: Final = (3000).to_bytes(4, "little"), (3000).to_bytes(4, "big")
"""First bytes of a binary .dat of SMS, which TUFLOW writes."""

SMS_TEXTS: Final = (b"MESH2D", b"DATASET", b"SCALAR\n", b"SCALAR\r", b"VECTOR\n", b"VECTOR\r")


def refuse_foreign(start: bytes, file_name: str) -> None:
    """Raise a `SourceError` that names the format of a flood model, by a file's first bytes.

    Examples
    --------
    >>> refuse_foreign(b"DHI_DFS_", "a.dfs2")  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    vexture.base.errors.SourceError: it is a .dfs2 of MIKE, which is not read; write it as NetCDF by mikeio: ...
    """
    suffix = Path(file_name).suffix.lower()
    if start.startswith(b"DHI_DFS_"):
        raise _foreign(f"a {suffix if suffix.startswith('.dfs') else '.dfs'} of MIKE", MIKEIO.get(suffix, DFS2))
    if start.startswith(RECORD) and start[TITLE].strip() in (b"SERAFIN", b"SERAFIND", b"SELAFIN"):
        raise _foreign("Selafin of TELEMAC", QGIS)
    if start.startswith(SMS_TEXTS) or (suffix == ".dat" and start.startswith(SMS)):
        raise _foreign("a mesh or a dataset of SMS, as TUFLOW writes", f"{QGIS}, with the .2dm beside it")


def refuse_foreign_hdf5(place: str | os.PathLike[str]) -> None:
    """Raise a `SourceError` that names the model if an HDF5 file is one of HEC-RAS or TUFLOW rather than NetCDF."""
    import h5py

    try:
        with Path(place).open("rb") as opened:
            if opened.read(len(NETCDF[-1])) != NETCDF[-1]:
                return
        with h5py.File(place) as file:
            kind, named = _text(file.attrs.get("File Type")), file.get("File Type")
            if isinstance(named, h5py.Dataset) and named.size == 1:
                kind = _text(named[()])
    except Exception:  # h5py raises any type of exception for a damaged file; its reader reports it
        return
    if kind.startswith("HEC-RAS"):
        raise _foreign(f"HDF of HEC-RAS ({kind})", RAS_MAPPER)
    if kind.lower() == "xmdf":
        raise _foreign("XMDF, as TUFLOW writes", f"{QGIS}, with the .2dm beside it")


def refuse_foreign_dataset(dataset: Any) -> None:
    """Raise a `SourceError` that names the model if an open dataset has a mesh by an unsupported convention."""
    names = set(map(str, dataset.variables))
    if {"volumes", "elevation", "x", "y"} <= names and names & {"stage", "stage_c"}:
        raise _foreign("an .sww of ANUGA", QGIS)
    if "threedicore_version" in dataset.attrs or {"Mesh2DContour_x", "Mesh2D_s1"} <= names:
        raise _foreign("a result of 3Di", "write the depth as GeoTIFF by threedidepth, or by the QGIS plug-in of 3Di")


def _foreign(description: str, remedy: str) -> SourceError:
    return SourceError(f"it is {description}, which is not read; {remedy}")


def _text(value: Any) -> str:
    """Text of an attribute or value of HDF5; empty for other types."""
    one = value.flat[0] if hasattr(value, "flat") and getattr(value, "size", 0) == 1 else value
    return one.decode(errors="replace").strip("\0 ") if isinstance(one, bytes) else one if isinstance(one, str) else ""
