"""The command `flood`."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import click

from vexture.base.errors import ParameterError
from vexture.base.tolerance import HMIN
from vexture.cli.messages import echo, one_line, print_message
from vexture.cli.options import PATH, refuse_stream
from vexture_geo.flood.options import DEPTHS, PERIOD, FloodOptions, bounds_of, depths_of
from vexture_geo.flood.video_options import FPS, SIZE, STEP_SECONDS, VideoOptions, size_of

CLASSES = ",".join(f"{depth:g}" for depth in DEPTHS[1:])

STAYS = {
    "token_file": "takes no uploads",
    "follow": "shows one state of a run",
    "keep": "takes no water to keep",
}
"""Reasons why options need a server."""

EXAMPLE = """\b
Examples:
  vexture flood --extent depth.nc --time-dim time --ground aerial.tif -o flood.html
  vexture flood --extent flood.gpkg --serve --token-file token
  vexture flood --follow run_map.nc --serve --keep water
"""


@click.command(epilog=EXAMPLE)
@click.option("--extent", metavar="FILE", type=PATH, help="Where water is: polygons, or depths.")
@click.option("--follow", metavar="FILE", type=PATH, help="With --serve: NetCDF that a model writes, step by step.")
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
@click.option("--workers", metavar="N", type=int, help="Processes that convert the steps.  [default: one a core]")
@click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler whose workers convert the steps.")
@click.option("-o", "--output", metavar="PAGE.html", type=PATH, help="Write one page with everything in it.")
@click.option("--video", metavar="FILE", type=PATH, help="Write all steps as a video (.webm, .mp4) or a GIF.")
@click.option("--size", metavar="WxH", help=f"With --video: its pixels.  [default: {SIZE[0]}x{SIZE[1]}]")
@click.option("--view", metavar="NAME", help="With --video: a view of the page.  [default: Overview]")
@click.option(
    "--colours", "--colors", metavar="NAME",
    help="With --video: of the water by its depth, smooth, greatest, hazard or arrival.  [default: water]",
)  # fmt: skip
@click.option("--plain", is_flag=True, help="With --video: without title, time, legend, scale and source.")
@click.option("--step-seconds", metavar="S", type=float, help=f"With --video: of each step.  [default: {STEP_SECONDS}]")
@click.option(
    "--fps", metavar="N", type=float, help=f"With --video: frames a second.  [default: {FPS:g}; a GIF 1 a step]"
)
@click.option("--serve", "serving", is_flag=True, help="Show the page on a server, until Ctrl-C.")
@click.option("--token-file", metavar="F", type=PATH, help="With --serve: token of those who may push newer water.")
@click.option(
    "--keep", metavar="DIR", type=PATH, help="With --serve: keep what is pushed or followed for the next start."
)
@click.option("--host", default="127.0.0.1", show_default=True, help="With --serve: address to listen on.")
@click.option("--port", type=int, default=8000, show_default=True, help="With --serve: port to listen on; 0 takes any.")
def flood(
    extent: Path | None,
    follow: Path | None,
    output: Path | None,
    video: Path | None,
    size: str | None,
    view: str | None,
    colours: str | None,
    plain: bool,
    step_seconds: float | None,
    fps: float | None,
    serving: bool,
    token_file: Path | None,
    keep: Path | None,
    host: str,
    port: int,
    bounds: str | None,
    depths: str | None,
    workers: int | None,
    **parameters: Any,
) -> None:
    """Show a flood as animated water, on one page or on a server.

    The extent is a file of wet areas, in any format that vexture map reads except TopoJSON, or of depths: GeoTIFF,
    Esri grid (.asc, .flt), GRIB, or NetCDF with rows and columns, a curvilinear grid or a mesh (UGRID: D-Flow FM,
    ADCIRC, SCHISM).
    """
    from vexture_geo.base.crs import gis_packages

    with one_line(), gis_packages():
        if (output is None and video is None) == (not serving):
            places = "-o PAGE.html for one page, --video FILE, or --serve for a server"
            both = "either files (-o, --video) or --serve" if serving else places
            raise ParameterError(f"vexture flood needs to know where to show it; give {both}")
        pictured: dict[str, Any] = {"view": view, "colours": colours, "plain": plain or None}
        filmed = _video(video, size, **pictured, step_seconds=step_seconds, fps=fps)
        if (extent is None) == (follow is None):
            raise ParameterError("vexture flood shows one file; give either `extent` FILE or `follow` FILE")
        for option, value in {"token_file": token_file, "follow": follow, "keep": keep}.items():
            if value is not None and not serving:
                raise ParameterError(f"`{option}` {value}: one page {STAYS[option]}; use it with `serve`")
        if follow is not None and parameters["layer"] is not None:
            raise ParameterError(f"`layer` {parameters['layer']!r}: it is for polygons, and `follow` reads depths")
        classes = DEPTHS if depths is None else depths_of(depths)
        box = None if bounds is None else bounds_of(bounds)
        source = follow if extent is None else extent
        assert source is not None
        refuse_stream(source, "the extent")
        many = (os.cpu_count() or 1) if workers is None else workers
        options = FloodOptions(source, bounds=box, depths=classes, workers=many, **parameters)
        from vexture_geo.flood.server import ReadyFlood, ServerOptions, export, serve

        if not serving:
            made, sizes = export(options, output, filmed, print_message, _track_frames)
            for path, written in sizes.items():
                echo(f"{path}: {made.summary}, {written} bytes")
            return

        def show(address: str, flood: ReadyFlood) -> None:
            echo(f"vexture: {address} shows {flood.summary}; Ctrl-C ends it")

        if follow is not None:
            from vexture_geo.depth.appended_steps import share_files

            share_files()
        serve(options, ServerOptions(host, port, token_file, follow is not None, keep), report=print_message, show=show)


def _video(path: Path | None, size: str | None, **given: Any) -> VideoOptions | None:
    """Return the requested video; refuse its options without one."""
    given = {"size": None if size is None else size_of(size), **given}
    chosen = {name: value for name, value in given.items() if value is not None}
    if path is None:
        if chosen:
            raise ParameterError(f"`{next(iter(chosen))}` is for a video; give `video` FILE, too")
        return None
    return VideoOptions(path, **chosen)


def _track_frames(numbers: Sequence[int]) -> Iterator[int]:
    """Iterate over the frames of a video, and show progress on a terminal."""
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as progress:
        yield from progress.track(numbers, description="filming")
