"""The commands `view` and `export`."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from vexture.arguments import Tolerance
from vexture.messages import one_line, say
from vexture.settings import Settings

__all__ = ["export", "view"]


def _conversion(command: Callable[..., None]) -> Callable[..., None]:
    """Options of how the viewer converts."""
    for option in (
        click.option("--select", metavar="SELECTOR", help="Show only the elements that a CSS selector matches."),
        click.option("--precision", metavar="P", type=float, help="Largest shift by rounding.  [default: 1e-7]"),
        click.option(
            "--tolerance",
            type=Tolerance(),
            default="auto",
            show_default=True,
            help="Largest distance from the drawing's outline, in drawing sizes; auto is 0.",
        ),
    ):
        command = option(command)
    return command


def _settings(tolerance: Any, precision: float | None, select: str | None) -> Settings:
    from vexture.live.documents import VIEWER_SETTINGS

    most = VIEWER_SETTINGS.precision if precision is None else precision
    return replace(VIEWER_SETTINGS, tolerance=tolerance, precision=most, select=select)


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("--watch", "watching", is_flag=True, help="Show files anew whenever they are saved.")
@click.option("--port", metavar="P", type=int, default=0, help="Port to listen on.  [default: any that is free]")
@click.option("--host", metavar="HOST", default="127.0.0.1", show_default=True, help="Address to listen on.")
@click.option("--no-open", "opening", is_flag=True, flag_value=False, default=True, help="Open no browser.")
@_conversion
def view(files: tuple[Path, ...], watching: bool, port: int, host: str, opening: bool, **conversion: Any) -> None:
    """Show drawings or packed textures in the browser, until Ctrl-C."""
    with one_line():
        from vexture.live.viewing import view as serve

        def show(where: str, shapes: int) -> None:
            click.echo(f"vexture: {where} shows {shapes} shape{'s' * (shapes != 1)}; Ctrl-C ends it")

        serve(
            files,
            _settings(**conversion),
            host=host,
            port=port,
            watching=watching,
            opening=opening,
            say=say,
            show=show,
        )


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "-o", "--output", metavar="PAGE.html", required=True, type=click.Path(path_type=Path), help="File to write."
)
@click.option("--title", metavar="TEXT", help="Title of the page.  [default: the names of the files]")
@_conversion
def export(files: tuple[Path, ...], output: Path, title: str | None, **conversion: Any) -> None:
    """Write one page that shows drawings, with everything in it."""
    with one_line():
        from vexture.live.viewing import export as write

        size = write(files, output, title, _settings(**conversion), say)
        click.echo(f"{output}: {len(files)} file{'s' * (len(files) > 1)}, {size} bytes")
