"""Types of options, and options that several commands share."""

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from vexture.base.errors import DeviceError, ParameterError, SourceError
from vexture.cli.messages import IMAGE_FLAGS

if TYPE_CHECKING:
    from vexture.base.content import FileKind
    from vexture.conversion.parameters import Parameters

    ParamType = click.ParamType[Any]
else:  # generic since click 8.4
    ParamType = click.ParamType


class PathArgument(click.Path):
    """A path; an empty one, as from an unset shell variable, is refused because it would mean the folder "."."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path."""
        if value == "":
            named = f" of {param.opts[-1]}" if param is not None and param.opts[-1].startswith("-") else ""
            raise click.ClickException(f"the name of a file{named} is empty; give one")
        return super().convert(value, param, ctx)


PATH: Final[Any] = PathArgument(path_type=Path)

STANDARD: Final = "-"
"""File name that stands for standard input and output."""

RESEARCH: Final = ("encoding", "bits", "strategy")
"""Options for comparing encodings."""


class Sectioned(click.Command):
    """A command whose help lists the research options in a section of their own."""

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


class RectangleArgument(ParamType):
    """Four numbers separated by commas."""

    name = "X,Y,W,H"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Parse the numbers."""
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
        from vexture.drawing.colors import parse_color

        found = parse_color(str(value))
        if found is None or isinstance(found, str):
            self.fail(f"{value!r} is neither a CSS colour, such as white or #f4f1e8, nor none", param, ctx)
        red, green, blue = found.rgb
        return red * found.alpha, green * found.alpha, blue * found.alpha, found.alpha


def standard_input() -> bytes:
    """Read all of standard input, up to the limit for files."""
    from vexture.base.content import LARGEST_FILE

    if sys.stdin is None:
        raise SourceError("standard input: it is closed; give a file")
    return sys.stdin.buffer.read(LARGEST_FILE + 1)


def read_stream(path: Path) -> bytes | None:
    """Read standard input or a named pipe, which can be read only once; return None for a file."""
    from vexture.base.content import about, is_stream, read_bytes

    if path == Path(STANDARD):
        return standard_input()
    if not is_stream(path):
        return None
    with about(str(path)):
        return read_bytes(path)


def refuse_stream(path: Path, subject: str) -> None:
    """Raise a `SourceError` if a source that is read several times is a pipe."""
    from vexture.base.content import is_stream

    if is_stream(path):
        raise SourceError(f"{path}: {subject} is read several times, and a pipe only once; save it as a file")


def shown_name(path: Path) -> str:
    """Return the name of a source for messages."""
    return "standard input" if path == Path(STANDARD) else str(path)


def check_output(output: Path | None) -> None:
    """Raise a `DeviceError` if the output is standard output and that is closed."""
    if output == Path(STANDARD) and sys.stdout is None:
        raise DeviceError("standard output is closed; name a file with -o")


def write_output(data: bytes) -> None:
    """Write to standard output."""
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()  # an error belongs to this command, not to the exit of Python


def drawing_kind(path: Path) -> "FileKind | None":
    """Return the kind of a file that is not a texture; None for anything else."""
    from vexture.base.content import FileKind, kind_of, start_of
    from vexture.texture.registry import owner_of

    if not path.is_file() or owner_of(path) is not None:
        return None
    kind = kind_of(start_of(path), path)
    return None if kind is FileKind.TEXTURE else kind


class Tolerance(ParamType):
    """A number, or auto."""

    name = "T"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Parse the number, or the word."""
        if value == "auto" or isinstance(value, float):
            return value
        try:
            return float(value)
        except ValueError:
            self.fail(f"{value!r} is neither a number nor auto", param, ctx)


tolerance_option = click.option(
    "--tolerance",
    type=Tolerance(),
    default="auto",
    show_default=True,
    help="Largest distance from the drawing's outline, in unit-square units: the drawing's longer side is 1. "
    "auto is 2e-5, or 0 with a precision; 0 merges nothing.",
)


font_option = click.option(
    "--font",
    "fonts",
    metavar="FILE|DIR",
    type=PATH,
    multiple=True,
    callback=lambda _context, _parameter, given: given or None,
    help="A font, or a folder of fonts, for the texts of an SVG; may be given several times. They come before the "
    "fonts of the system.",
)


strict_option = click.option(
    "--strict",
    is_flag=True,
    help="Fail, and write nothing, where anything of a drawing is left out, simplified or invalid; remarks do no harm.",
)


def images_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the flags for the treatment of pictures to a command."""
    trace = click.option(
        IMAGE_FLAGS["trace"],
        "images",
        flag_value="trace",
        default=None,
        help="Trace a picture, and the pictures in an SVG and in files beside it or below, instead of drawing them.",
    )
    leave_out = click.option(
        IMAGE_FLAGS["none"], "images", flag_value="none", default=None, help="Leave out the pictures in an SVG."
    )
    return trace(leave_out(command))


class NamedColour(ParamType):
    """A name and a CSS colour."""

    name = "NAME=COLOR"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Split the name from the colour, which the reader checks."""
        if isinstance(value, tuple):
            return value
        name, equals, colour = str(value).rpartition("=")
        if not equals:
            self.fail(f"{value!r} names no colour; give NAME=COLOR, such as currentColor=teal", param, ctx)
        return name.strip(), colour.strip()


page_color_option = click.option(
    "--color",
    "--page-color",
    "page_colors",
    type=NamedColour(),
    multiple=True,
    callback=lambda _context, _parameter, given: dict(given) or None,
    help="A colour that the page around an SVG would give it: of currentColor, context-fill, context-stroke, or a "
    "custom property such as --primary; may be given several times.",
)


def as_given(name: str, value: Any) -> str:
    """Format the value of an option for a message, as the user typed it; of several values, only the first.

    Examples
    --------
    >>> as_given("page_colors", {"--primary": "teal", "currentColor": "red"}), as_given("restyle", True)
    (' --primary=teal', '')
    """
    if value is True:
        return ""
    if name == "page_colors":
        value = "=".join(next(iter(value.items())))
    elif name == "fonts":
        value = value[0]
    return f" {value}"


SILHOUETTE_HELP: Final = "the covered area of a drawing, without colours."


def split_of(split: str | None, silhouette: bool | None) -> dict[str, str | None]:
    """Return the parameter `split` according to two options, if one of them is set."""
    if not silhouette:
        return {} if split is None else {"split": split}
    if split is not None:
        raise ParameterError(f"`split` {split} and `silhouette` exclude each other; leave one out")
    return {"split": None}


def conversion_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options for the viewer's conversions to a command."""
    precision = click.option("--precision", metavar="P", type=float, help="Largest shift by rounding.  [default: 1e-7]")
    select = click.option("--select", metavar="SELECTOR", help="Show only the elements that a CSS selector matches.")
    split = click.option(
        "--split", type=click.Choice(["paint"]), help="paint: show each colour as a layer, one over the other."
    )
    silhouette = click.option("--silhouette", is_flag=True, help=f"Show {SILHOUETTE_HELP}")
    for option in (tolerance_option, precision, images_options, page_color_option, font_option, select):
        command = option(command)
    return split(silhouette(command))


def viewer_parameters(
    tolerance: Any,
    precision: float | None,
    select: str | None,
    split: str | None,
    silhouette: bool,
    fonts: tuple[Path, ...] | None,
    images: str | None,
    page_colors: dict[str, str] | None,
) -> "Parameters":
    """Return the viewer's parameters, changed by the options that are set."""
    from vexture.server.publish_file import VIEWER_PARAMETERS

    values: dict[str, Any] = {"tolerance": tolerance, "select": select, "fonts": fonts, "page_colors": page_colors}
    values |= {"images": images or "draw", **split_of(split, silhouette)}
    if precision is not None:
        values["precision"] = precision
    return replace(VIEWER_PARAMETERS, **values)


def face_options(command: Any) -> Any:
    """Add the options that choose a face to a command."""
    stretch = click.option(
        "--stretch", metavar="PERCENT", type=float, default=100.0, show_default=True, help="Width of the letters."
    )
    style = click.option(
        "--style",
        type=click.Choice(["normal", "italic", "oblique"]),
        default="normal",
        show_default=True,
        help="Slope of the letters.",
    )
    weight = click.option(
        "--weight", metavar="W", type=float, default=400, show_default=True, help="Weight, 1 to 1000; 700 is bold."
    )
    return weight(style(stretch(command)))
