"""The command `view`."""

from pathlib import Path
from typing import Any

import click

from vexture.base.errors import format_count
from vexture.cli.messages import echo, one_line, print_message
from vexture.cli.options import PATH, conversion_options, viewer_parameters

EXAMPLE = """\b
Examples:
  vexture view logo.svg --watch           shows every save of the drawing
  vexture view logo.svg map.geojson icons.ktx2
"""


@click.command(epilog=EXAMPLE)
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=PATH)
@click.option("--watch", "watching", is_flag=True, help="Show files again whenever they are saved.")
@click.option("--port", metavar="P", type=int, default=0, help="Port to listen on.  [default: any that is free]")
@click.option("--host", metavar="HOST", default="127.0.0.1", show_default=True, help="Address to listen on.")
@click.option("--no-open", "opening", is_flag=True, flag_value=False, default=True, help="Do not open a browser.")
@conversion_options
def view(files: tuple[Path, ...], watching: bool, port: int, host: str, opening: bool, **conversion: Any) -> None:
    """Show drawings or packed textures in the browser until you press Ctrl-C.

    The page shows a texture made for deep zoom; it also reports the smaller size that `vexture convert` writes.
    """
    with one_line():
        from vexture.pages.view import view as serve
        from vexture.server.packages import check_packages

        check_packages()

        def show(url: str, shapes: int) -> None:
            echo(f"vexture: {url} shows {format_count(shapes, 'shape')}; Ctrl-C ends it")

        serve(
            files,
            viewer_parameters(**conversion),
            host=host,
            port=port,
            watching=watching,
            opening=opening,
            report=print_message,
            show=show,
        )
