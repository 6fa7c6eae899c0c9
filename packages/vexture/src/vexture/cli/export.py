"""The command `export`."""

from pathlib import Path
from typing import Any

import click

from vexture.base.errors import format_count
from vexture.cli.messages import echo, one_line, print_message
from vexture.cli.options import PATH, conversion_options, strict_option, viewer_parameters

EXAMPLE = """\b
Example:
  vexture export logo.svg badge.svg -o logos.html --title 'Our logos'
"""


@click.command(epilog=EXAMPLE)
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=PATH)
@click.option("-o", "--output", metavar="PAGE.html", required=True, type=PATH, help="File to write.")
@click.option("--title", metavar="TEXT", help="Title of the page.  [default: the names of the files]")
@strict_option
@conversion_options
def export(files: tuple[Path, ...], output: Path, title: str | None, strict: bool, **conversion: Any) -> None:
    """Write a self-contained web page that shows drawings."""
    with one_line():
        from vexture.pages.view import export as write

        size = write(files, output, title, viewer_parameters(**conversion), print_message, strict=strict)
        echo(f"{output}: {format_count(len(files), 'file')}, {size} bytes")
