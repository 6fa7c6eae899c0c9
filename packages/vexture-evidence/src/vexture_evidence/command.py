"""The command `report`."""

import time
from pathlib import Path

import click

from vexture.cli.messages import one_line, print_message

EXAMPLE = """\b
Examples:
  vexture report -o report              the example drawings, from a clone of the repository
  vexture report logo.svg -o report
"""


@click.command(epilog=EXAMPLE)
@click.argument("sources", metavar="[SOURCE]...", nargs=-1, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    metavar="FOLDER",
    required=True,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for the page, its pictures and its JSON file.",
)
def report(sources: tuple[Path, ...], output: Path) -> None:
    """Measure drawings, or the examples, and write one page of tables and figures.

    The page reproduces the evaluation of the thesis that vexture began with, and compares vexture with other methods.
    """
    with one_line():
        from vexture_evidence.report.assemble import assemble

        start = time.perf_counter()
        made = assemble(sources, output, report=print_message)
        click.echo(f"{made}: {time.perf_counter() - start:.0f} s")
