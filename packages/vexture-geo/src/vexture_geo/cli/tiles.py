"""The command `tiles`."""

import os
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from vexture.base.errors import format_count
from vexture.cli.interrupt import INTERRUPTED
from vexture.cli.messages import echo, one_line, print_message, say_notes
from vexture.cli.options import PATH, refuse_stream
from vexture_geo.cli.colour_options import colour_options, columns_of, refuse_idle_colours, scale_of

if TYPE_CHECKING:
    from vexture_geo.tiles.build import Report
    from vexture_geo.tiles.options import TileOptions

EXAMPLE = """\b
Examples:
  vexture tiles land.gpkg -o land.pmtiles
  vexture tiles parcels.fgb --id parcel --color value --max-zoom 14 -o parcels.pmtiles
  vexture tiles parcels.fgb -o parcels --scheduler tcp://10.0.0.7:8786
"""


@click.command(epilog=EXAMPLE)
@click.argument("source", metavar="SOURCE", type=PATH)
@click.option("-o", "--output", metavar="FILE.pmtiles|DIR", type=PATH, required=True, help="File or folder to write.")
@click.option("--max-zoom", metavar="Z", type=int, default=12, show_default=True, help="Largest zoom of exact views.")
@click.option("--min-zoom", metavar="Z", type=int, default=0, show_default=True, help="Smallest zoom of tiles.")
@click.option("--step", metavar="N", type=int, default=2, show_default=True, help="Zooms between levels: 2 or 3.")
@click.option("--layer", metavar="NAME", help="Layer of polygons, if there are several.")
@click.option("--where", metavar="CONDITION", help="Only features for which this holds, such as \"kind = 'forest'\".")
@click.option("--id", metavar="COLUMN", help="Column with the ids of features.  [default: their numbers]")
@click.option("--source-crs", "source_crs", metavar="EPSG:N", help="Reference system of a source that does not say it.")
@click.option("--crs", "source_crs", metavar="EPSG:N", hidden=True)  # former name
@click.option("--columns", metavar="A,B,...", help="Attributes to keep in the table.  [default: all]")
@click.option("--color", "--colour", metavar="COLUMN", help="Attribute that colours show.")
@colour_options
@click.option("--order", metavar="COLUMN", help="Which polygons are above.  [default: the smaller ones]")
@click.option("--fill", metavar="COLOR", help="One colour of all.  [default: grey]")
@click.option("--name", metavar="TEXT", default="", help="Name of the map.  [default: the output's name]")
@click.option("--attribution", metavar="TEXT", default="", help="Where the data are from.")
@click.option("--processes", metavar="N", type=int, help="Processes that share the work.  [default: one a core]")
@click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler whose workers do the work.")
@click.option("-q", "--quiet", is_flag=True, help="Print errors only.")
def tiles(source: Path, output: Path, **options: Any) -> None:
    """Make a pyramid of tiles from polygons: one PMTiles file, or a folder with a TileJSON.

    Each tile is a texture that stays sharp far beyond its own zoom. Tiles hold polygons only; use `vexture map` for
    lines and points. A table of attributes is written next to the file, or into the folder. If the command is
    interrupted or killed, run it again to continue.
    """
    with one_line():
        from vexture_geo.tiles.build import describe_unfinished, make_tiles

        quiet = options.pop("quiet")
        refuse_stream(source, "source")
        tile_options = _parse_options(options)
        try:
            with ExitStack() as opened:
                made = make_tiles(source, output, tile_options, _progress(opened, quiet))
        except KeyboardInterrupt:
            print_message(f"interrupted; {describe_unfinished(output)}")
            sys.exit(INTERRUPTED)
        if not quiet:
            say_notes(source, made.notes)
            found = f"{format_count(made.features, 'feature')}, {format_count(made.tiles, 'tile')}"
            echo(f"{output}: {found}, {made.contents} of them different, {made.bytes} bytes")


def _parse_options(options: dict[str, Any]) -> "TileOptions":
    """Convert the options of the command to those of a pyramid."""
    from vexture_geo.tiles.attributes import TileStyle
    from vexture_geo.tiles.options import TileOptions

    names = ("color", "scale", "classes", "palette", "no_data", "fill", "columns", "order", "table")
    given = {name: options.pop(name) for name in names}
    if given["color"] is None:
        refuse_idle_colours(given)
    scale, columns = scale_of(given["color"], given), columns_of(given["columns"])
    style = TileStyle(scale, given["fill"], columns, given["order"], given["table"])
    processes = options.pop("processes")
    processes = os.cpu_count() or 1 if processes is None else processes
    return TileOptions(style=style, processes=processes, **options)


def _progress(opened: ExitStack, quiet: bool) -> "Report":
    """Return a callback that shows progress on a terminal."""
    if quiet or not sys.stderr.isatty():
        return lambda *_: None
    from rich.console import Console
    from rich.progress import Progress

    progress = opened.enter_context(Progress(console=Console(stderr=True), transient=True))
    task = progress.add_task("tiles", total=None)

    def update(stage: str, number: int, count: int) -> None:
        progress.update(task, description=stage, completed=number, total=count or None)

    return update
