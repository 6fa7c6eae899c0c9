"""Credits in a file: its title, its origin, and the terms on which it may be shown."""

import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Final

from vexture.base.content import NETCDF, TIFF
from vexture_geo.base.gdal import open_raster
from vexture_geo.base.hdf5 import refuse_links_of_netcdf

MOST_LETTERS: Final = 600
"""Longest credit that is kept: attributes can hold the history of a run."""

NAMES: Final = {
    "title": ("title", "TIFFTAG_DOCUMENTNAME"),
    "source": ("source", "TIFFTAG_SOFTWARE"),
    "institution": ("institution", "TIFFTAG_ARTIST"),
    "references": ("references",),
    "licence": ("license", "licence", "rights", "TIFFTAG_COPYRIGHT"),
    "comment": ("comment", "TIFFTAG_IMAGEDESCRIPTION"),
}
"""Names of attributes in the CF conventions and ACDD, and of tags of TIFF."""

SYNTHETIC: Final = re.compile(r"\b(synthetic|invented|fictitious|fictional|made[- ]up)\b", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Credits:
    """Credits that a page shows for its data; empty where nothing is known.

    Examples
    --------
    >>> Credits(comment="A synthetic surge.").is_synthetic, Credits(source="SFINCS 2.1").is_synthetic
    (True, False)
    """

    title: str = ""
    source: str = ""
    institution: str = ""
    references: str = ""
    licence: str = ""
    comment: str = ""

    @property
    def is_synthetic(self) -> bool:
        """True if a credit says that the data are of no real event."""
        return any(SYNTHETIC.search(text) for text in asdict(self).values())

    def with_given(self, **given: str | None) -> "Credits":
        """Replace credits by those that are given."""
        return replace(self, **{name: text for name, text in given.items() if text is not None})

    def as_json(self) -> dict[str, Any]:
        """Return the credits as the page's JSON."""
        return {**asdict(self), "synthetic": self.is_synthetic}


def credits_of(path: Path) -> Credits:
    """Read credits in the global attributes of a NetCDF file or the tags of a GeoTIFF; other files have none."""
    with path.open("rb") as file:
        start = file.read(8)
    if start.startswith(NETCDF):
        return credits_among(_attributes(path))
    if start.startswith(TIFF):
        return credits_among(_tags(path))
    return Credits()


def _attributes(path: Path) -> Mapping[str, Any]:
    import netCDF4

    refuse_links_of_netcdf(path)
    with netCDF4.Dataset(path.absolute()) as file:
        return {name: file.getncattr(name) for name in file.ncattrs()}


def _tags(path: Path) -> Mapping[str, Any]:
    with open_raster(path) as raster:
        tags: Mapping[str, Any] = raster.tags()
        return tags


def credits_among(attributes: Mapping[Any, Any]) -> Credits:
    """Select credits among attributes, ignoring the case of their names."""
    texts = {str(name).lower(): _text(value) for name, value in attributes.items() if isinstance(value, str)}
    return Credits(
        **{
            name: next((texts[one.lower()] for one in names if texts.get(one.lower())), "")
            for name, names in NAMES.items()
        }
    )


def _text(value: str) -> str:
    """Put a text in one line, and shorten it."""
    line = " ".join(value.split())
    return line if len(line) <= MOST_LETTERS else line[: MOST_LETTERS - 1] + "…"
