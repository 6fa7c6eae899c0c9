"""Page of a flood for a notebook or a program: `flood_page` makes what `vexture flood -o` writes."""

import html
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Unpack

from vexture.base.errors import ParameterError
from vexture_geo.flood.bundle import FLOOD
from vexture_geo.flood.options import DEPTHS, FloodOptions, FloodParameters, classes_of

if TYPE_CHECKING:
    from xarray import DataArray, Dataset

    from vexture_geo.base.extent import Extent
    from vexture_geo.flood.credits import Credits

HEIGHT: Final = 600
"""Height of the page in a notebook, in pixels."""

UNNAMED: Final = "flood"
"""Title of a flood that no file and no option names."""

READING: Final = ("bounds", "time_dim", "variable", "layer")
"""Parameters of the reader, which an extent that has been read cannot use."""

FRAME: Final = (
    '<iframe srcdoc="{page}" title="{title}" allow="fullscreen; clipboard-write" '
    'style="width: 100%; height: {height}px; border: 0"></iframe>'
)


@dataclass(frozen=True, slots=True, eq=False)
class FloodPage:
    """A self-contained page that shows a flood; a notebook shows it as the value of a cell.

    Parameters
    ----------
    html : str
        HTML of the page.
    title : str
        Title of the page.
    described : str
        Summary in one line.
    height : int
        Height in a notebook, in pixels.
    """

    html: str = field(repr=False)
    title: str
    described: str
    height: int = HEIGHT

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the page as one HTML file that opens in any browser.

        Raises
        ------
        ParameterError
            If the name does not end in .html.
        DeviceError
            If the file cannot be written.
        """
        from vexture.pages.page import check_output
        from vexture.texture.files import write_together

        check_output(Path(path), FLOOD)
        write_together({Path(path): self.html.encode()})

    def _repr_html_(self) -> str:
        """Frame the page within a notebook's page; notebooks call this method."""
        page, title = (html.escape(text, quote=True) for text in (self.html, self.title))
        return FRAME.format(page=page, title=title, height=self.height)


def flood_page(
    source: "str | os.PathLike[str] | Dataset | DataArray | Extent",
    /,
    *,
    height: int = HEIGHT,
    ground: str | os.PathLike[str] | None = None,
    relief: str | os.PathLike[str] | None = None,
    depths: Sequence[float] = DEPTHS,
    **options: Unpack[FloodParameters],
) -> FloodPage:
    """Show a flood as animated water: the page of `vexture flood`, in a notebook or as a file.

    Needs ``vexture[gis]`` for anything but GeoJSON.

    Parameters
    ----------
    source : path, Dataset, DataArray or Extent
        Wet places: a file that `vexture.read_extent` reads; depths in xarray, which are read one step at a time; or an
        extent that has been read.
    height : int
        Height in a notebook, in pixels.
    ground : path, optional
        Picture of the ground: a GeoTIFF, or a PNG, JPEG or WebP that shows exactly `bounds`.
    relief : path, optional
        Heights of the ground in metres, as GeoTIFF.
    depths : sequence of float
        Depths in metres at which the classes of the map begin.
    **options
        Options of the command: `bounds`, `crs`, `time_dim`, `hmin`, `variable` and `layer` of `vexture.read_extent`;
        the waves' `amplitude` in metres and `period` in seconds; `title`, `source` and `licence`, texts that replace
        those in the data.

    Returns
    -------
    FloodPage
        A notebook shows it; `save` writes it.

    Raises
    ------
    SourceError
        If the data cannot be read.
    LimitError
        If they exceed a limit, or have several layers or variables and none is chosen.
    ParameterError
        If an option is out of range, or does not fit the data.
    DeviceError
        If a package is missing, or the pages are not built.
    TypeError
        If there is no such option.

    Warns
    -----
    SourceWarning
        One warning with all that was left out or chosen while reading.

    Examples
    --------
    >>> lake = Path(getfixture("tmp_path"), "lake.geojson")
    >>> _ = lake.write_text('{"type": "Polygon", "coordinates": [[[4, 52], [4.01, 52], [4.01, 52.01], [4, 52.01]]]}')
    >>> flood_page(lake, title="A lake").title
    'A lake'
    """
    from vexture.pages.page import built
    from vexture_geo.base.datasets import is_dataset
    from vexture_geo.base.extent import Extent
    from vexture_geo.flood.credits import Credits
    from vexture_geo.flood.server import make_flood, page_of

    if not height > 0:
        raise ParameterError(f"`height` is {height}; it is a number of pixels above 0")
    for name, value in options.items():
        if name not in FloodParameters.__annotations__:
            raise TypeError(f"`{name}` is {value!r:.80}, but a flood has no such parameter; leave it out")
    named = Path(UNNAMED) if isinstance(source, Extent) or is_dataset(source) else Path(source)
    picture, heights = (None if path is None else Path(path) for path in (ground, relief))
    flood_options = FloodOptions(extent=named, ground=picture, relief=heights, depths=classes_of(depths), **options)
    built(FLOOD.script, FLOOD.package)
    if isinstance(source, Extent):
        for name in READING:
            if (value := options.get(name)) is not None:
                raise ParameterError(
                    f"`{name}` is {value!r}, but the extent has been read; give it to vexture.read_extent"
                )
        given = source, Credits()
    else:
        given = _read(source, flood_options)
    made = make_flood(flood_options, lambda _: None, source=given)  # the notes are on the page
    return FloodPage(page_of(made).decode(), made.flood.title, made.summary, height)


def _read(source: Any, options: FloodOptions) -> "tuple[Extent, Credits]":
    """Read a source as an extent, with its credits."""
    from vexture_geo.flood.credits import credits_among, credits_of
    from vexture_geo.readers import read_extent

    extent = read_extent(source, bounds=options.bounds, crs=options.crs, hmin=options.hmin, **options.reading)
    return extent, credits_among(source.attrs) if hasattr(source, "attrs") else credits_of(options.extent)
