"""The command `serve`."""

from pathlib import Path

import click

from vexture.cli.messages import as_options, echo, one_line
from vexture.cli.options import PATH, font_option
from vexture.server.limits import Limits

DEFAULTS = Limits()

EXAMPLE = """\b
Examples:
  openssl rand -hex 32 > token
  vexture serve shapes --token-file token
"""


@click.command(epilog=EXAMPLE)
@click.argument("folder", metavar="DIR", type=PATH)
@click.option("--token-file", metavar="F", type=PATH, help="File with the token of those who may publish; else nobody.")
@click.option("--host", default="127.0.0.1", show_default=True, help="Address to listen on.")
@click.option("--port", type=int, default=8000, show_default=True, help="Port to listen on; 0 takes any.")
@click.option("--max-bytes", type=int, default=DEFAULTS.max_bytes, show_default=True, help="Largest upload.")
@click.option("--max-total", type=int, default=DEFAULTS.max_total, show_default=True, help="Bytes of all shapes.")
@click.option("--max-shapes", type=int, default=DEFAULTS.max_shapes, show_default=True, help="Number of shapes.")
@click.option("--rate", type=float, default=DEFAULTS.rate, show_default=True, help="Uploads a second from one address.")
@click.option("--precision", metavar="P", type=float, help="Largest shift by rounding, for views from nearby.")
@font_option
def serve(
    folder: Path,
    token_file: Path | None,
    host: str,
    port: int,
    max_bytes: int,
    max_total: int,
    max_shapes: int,
    rate: float,
    precision: float | None,
    fonts: tuple[Path, ...] | None,
) -> None:
    """Serve a folder of shapes, and accept new ones from clients with a token.

    DIR is created if it does not exist. Shapes that are pushed are kept in .vexture inside it.
    """
    with one_line():
        from vexture.server.packages import check_packages

        check_packages()
        from vexture.pages.serve import serve as run

        limits = Limits(max_bytes=max_bytes, max_total=max_total, max_shapes=max_shapes, rate=rate)
        run(folder, token_file, host, port, limits, precision, fonts, lambda line: echo(as_options(line)))
