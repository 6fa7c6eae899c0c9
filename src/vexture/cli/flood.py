"""The command `flood`."""

from pathlib import Path
from typing import Any

import click

from vexture.cli.messages import one_line, say
from vexture.cli.options import PATH
from vexture.errors import ParameterError
from vexture.flood.options import DEPTHS, PERIOD, FloodOptions, bounds_of, depths_of
from vexture.tolerance import HMIN

__all__ = ["flood"]

CLASSES = ",".join(f"{depth:g}" for depth in DEPTHS[1:])

EXAMPLE = """\b
Examples:
  vexture flood --extent depth.nc --time-dim time --ground aerial.tif -o flood.html
  vexture flood --extent flood.gpkg --serve --token-file token
"""


@click.command(epilog=EXAMPLE)
@click.option("--extent", metavar="FILE", required=True, type=PATH, help="Where water is: polygons, or depths.")
@click.option("--crs", metavar="EPSG:N", help="Reference system of the extent, if its file does not say it.")
@click.option("--bounds", metavar="W,S,E,N", help="Box to show, in units of the extent.  [default: all of the extent]")
@click.option("--time-dim", metavar="NAME", help="Dimension of time: show each of its steps.")
@click.option("--hmin", metavar="M", type=float, default=HMIN, show_default=True, help="Depth from which it is wet.")
@click.option("--variable", metavar="NAME", help="Variable that holds depths, if there are several.")
@click.option("--layer", metavar="NAME", help="Layer of polygons, if there are several.")
@click.option("--ground", metavar="IMAGE", type=PATH, help="Picture of the ground: a GeoTIFF, or one of --bounds.")
@click.option("--relief", metavar="FILE", type=PATH, help="Heights of the ground in metres, as GeoTIFF.")
@click.option(
    "--amplitude", metavar="M", type=float, help="How far waves run up the beach.  [default: 0.2% of the box]"
)
@click.option("--period", metavar="S", type=float, default=PERIOD, show_default=True, help="Seconds between waves.")
@click.option("--title", metavar="TEXT", help="Title of the page.  [default: the file's own, or its name]")
@click.option("--source", metavar="TEXT", help="Where the data are from.  [default: what the file says]")
@click.option("--licence", "--license", metavar="TEXT", help="Terms of the data.  [default: what the file says]")
@click.option("--depths", metavar="M,M,...", help=f"Classes of the map of depths.  [default: {CLASSES}]")
@click.option("-o", "--output", metavar="PAGE.html", type=PATH, help="Write one page with everything in it.")
@click.option("--serve", "serving", is_flag=True, help="Show the page on a server, until Ctrl-C.")
@click.option("--token-file", metavar="F", type=PATH, help="With --serve: token of those who may push newer water.")
@click.option("--host", default="127.0.0.1", show_default=True, help="With --serve: address to listen on.")
@click.option("--port", type=int, default=8000, show_default=True, help="With --serve: port to listen on; 0 takes any.")
def flood(
    output: Path | None,
    serving: bool,
    token_file: Path | None,
    host: str,
    port: int,
    bounds: str | None,
    depths: str | None,
    **parameters: Any,
) -> None:
    """Show a flood as a living sea, on one page or on a server.

    The extent is GeoJSON, GeoPackage, FlatGeobuf or a shapefile of wet places, or GeoTIFF or NetCDF of depths: on rows
    and columns, a curvilinear grid, or a mesh (UGRID).
    """
    from vexture.geo.crs import gis_packages

    with one_line(), gis_packages():
        if (output is None) == (not serving):
            both = "either -o PAGE.html or --serve" if serving else "-o PAGE.html for one page, or --serve for a server"
            raise ParameterError(f"vexture flood needs to know where to show it; give {both}")
        if token_file is not None and not serving:
            raise ParameterError(f"`token_file` {token_file}: one page takes no uploads; use it with `serve`")
        classes = DEPTHS if depths is None else depths_of(depths)
        asked = FloodOptions(bounds=None if bounds is None else bounds_of(bounds), depths=classes, **parameters)
        from vexture.live.flood import Made, export, serve

        if output is not None:
            made, size = export(asked, output, say)
            click.echo(f"{output}: {made.described}, {size} bytes")
            return

        def show(where: str, made: Made) -> None:
            click.echo(f"vexture: {where} shows {made.described}; Ctrl-C ends it")

        serve(asked, token_file, host, port, say=say, show=show)
