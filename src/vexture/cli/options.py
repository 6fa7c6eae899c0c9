"""Types of options, and options that several commands have."""

import sys
from collections.abc import Callable
from dataclasses import replace
from typing import IO, TYPE_CHECKING, Any, Final

import click

from vexture.settings import Settings

__all__ = [
    "STANDARD",
    "Colour",
    "Rectangle",
    "Sectioned",
    "Tolerance",
    "binary_output",
    "conversion_options",
    "standard_input",
    "viewer_settings",
]

if TYPE_CHECKING:
    ParamType = click.ParamType[Any]
else:  # generic since click 8.4
    ParamType = click.ParamType

STANDARD: Final = "-"
"""Name of standard input and output among files."""

RESEARCH: Final = ("encoding", "bits", "strategy")
"""Options that only those need who compare encodings."""


class Sectioned(click.Command):
    """A command whose help lists the options for research in a section of their own."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options in two sections."""
        rows: dict[bool, list[tuple[str, str]]] = {False: [], True: []}
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx)
            if record is not None:
                rows[parameter.name in RESEARCH].append(record)
        with formatter.section("Options"):
            formatter.write_dl(rows[False])
        if rows[True]:
            with formatter.section("Options for research: the encoding of the thesis that vexture began with"):
                formatter.write_dl(rows[True])


class Rectangle(ParamType):
    """Four numbers, separated by commas."""

    name = "X,Y,W,H"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the numbers."""
        try:
            x, y, w, h = (float(part) for part in str(value).split(","))
        except ValueError:
            self.fail(f"{value!r} is not four numbers X,Y,W,H", param, ctx)
        return x, y, w, h


class Colour(ParamType):
    """A CSS colour, or none."""

    name = "COLOR|none"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return red, green, blue and opacity, 0..1, premultiplied."""
        if isinstance(value, tuple):
            return value
        if value == "none":
            return 0.0, 0.0, 0.0, 0.0
        from vexture.svg.colors import parse_color

        found = parse_color(str(value))
        if found is None or isinstance(found, str):
            self.fail(f"{value!r} is neither a CSS colour, such as white or #f4f1e8, nor none", param, ctx)
        red, green, blue = found.rgb
        return red * found.alpha, green * found.alpha, blue * found.alpha, found.alpha


def standard_input() -> bytes:
    """All that standard input holds, up to the limit of a file."""
    from vexture.content import LARGEST_FILE

    return sys.stdin.buffer.read(LARGEST_FILE + 1)


def binary_output() -> IO[bytes]:
    """Standard output, for the bytes of a file."""
    return sys.stdout.buffer


class Tolerance(ParamType):
    """A number, or auto."""

    name = "T"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the number, or the word."""
        if value == "auto" or isinstance(value, float):
            return value
        try:
            return float(value)
        except ValueError:
            self.fail(f"{value!r} is neither a number nor auto", param, ctx)


def conversion_options(command: Callable[..., None]) -> Callable[..., None]:
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


def viewer_settings(tolerance: Any, precision: float | None, select: str | None) -> Settings:
    """Settings of the viewer, but for what the options say."""
    from vexture.live.documents import VIEWER_SETTINGS

    most = VIEWER_SETTINGS.precision if precision is None else precision
    return replace(VIEWER_SETTINGS, tolerance=tolerance, precision=most, select=select)
