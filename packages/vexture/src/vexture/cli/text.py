"""The command `text`."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from vexture.base.deadline import DEFAULT_SECONDS
from vexture.base.errors import SourceError
from vexture.cli.convert import check_places, given_options, options_of_convert
from vexture.cli.messages import one_line
from vexture.cli.options import PATH, STANDARD, Colour, face_options, standard_input
from vexture.cli.result import NORMAL, QUIET, VERBOSE, ConversionResult, facts_of, say_outcome, shape_facts, written
from vexture.texture.registry import DEFAULT

if TYPE_CHECKING:
    from vexture.drawing.paint import Paint

EXAMPLE = """\b
Examples:
  vexture text Harbour --font Lobster.ttf -o word.ktx2
  vexture text "two lines\\nin the middle" --align center --weight 700 -o lines.ktx2
"""

STYLED = ("family", "weight", "style", "stretch", "features", "direction", "language", "align", "line_height", "name")
"""Options that set parameters of `vexture.text`."""


@options_of_convert(
    *("split", "silhouette", "restyle", "tolerance", "max_depth", "capacity", "precision", "deflate", "max_seconds"),
    *("strict", "as_json", "quiet", "verbose"),
)
@click.command(epilog=EXAMPLE)
@click.argument("text", metavar="TEXT")
@click.option(
    "-o",
    "--output",
    metavar="DIR|FILE.ktx2|-",
    type=PATH,
    help="Folder to write to, or the file; - is standard output.  [default: .]",
)
@click.option(
    "--font",
    metavar="FILE|DIR",
    type=PATH,
    multiple=True,
    help="A font, or a folder of fonts; may be given several times. They come before the default font and those "
    "of the system.",
)
@click.option("--family", metavar="NAME", multiple=True, help="Family of the fonts; several in order of preference.")
@face_options
@click.option(
    "--features",
    metavar="TAG",
    multiple=True,
    help="OpenType feature, such as smcp, -liga or salt=2; may be given several times.",
)
@click.option(
    "--direction",
    type=click.Choice(["auto", "ltr", "rtl"]),
    default="auto",
    show_default=True,
    help="Direction of the whole text; auto follows its first letter.",
)
@click.option("--language", metavar="TAG", help="Language of the text, such as nl or zh-Hant.")
@click.option(
    "--align",
    type=click.Choice(["start", "center", "end"]),
    default="start",
    show_default=True,
    help="Alignment of lines.",
)
@click.option("--line-height", metavar="EM", type=float, help="Distance of baselines.  [default: the font's]")
@click.option("--color", type=Colour(), help="A CSS colour, which the texture then has.  [default: none of its own]")
@click.option("--name", help="Name of the shape.  [default: the text, or its start]")
def text(
    text: str,
    output: Path | None,
    font: tuple[Path, ...],
    color: tuple[float, float, float, float] | None,
    strict: bool,
    as_json: bool,
    quiet: bool,
    verbose: bool,
    **options: Any,
) -> None:
    r"""Convert a word or lines of text into a texture.

    In TEXT, \n starts a new line; - reads standard input. Letters of any script are shaped and kerned. The colours
    of a colour font (COLR) become a planar map.
    """
    with one_line():
        from vexture.base.apart import apart

        to_pipe = output == Path(STANDARD)
        level = QUIET if quiet else VERBOSE if verbose else NORMAL
        check_places((), output, None, DEFAULT, to_pipe)
        styled = {name: options.pop(name) for name in STYLED}
        stored = {name: value for name in ("deflate",) if (value := options.pop(name)) is not None}
        parameters = given_options(options)
        if color is not None:
            parameters.setdefault("split", "faces")
        words = standard_input().decode("utf-8", "replace").rstrip("\n") if text == STANDARD else text
        styled |= {"font": font, "paint": paint_of(color)}
        given = (words.replace("\\n", "\n"), styled, parameters, stored, strict)
        outcome = apart(_convert_text, *given, name="the text", seconds=parameters.get("max_seconds", DEFAULT_SECONDS))
        outcome = written(outcome, output or Path(), {})
        say_outcome(outcome, level, quiet=as_json, to_pipe=to_pipe)
        if as_json:
            import json

            click.echo(json.dumps([facts_of(outcome)], indent=2), err=to_pipe)
    if outcome.error:
        sys.exit(1)


def _convert_text(
    words: str, styled: dict[str, Any], parameters: dict[str, Any], stored: dict[str, Any], strict: bool
) -> ConversionResult:
    """Convert a text into a texture; the fonts may be untrusted."""
    from vexture.base.deadline import within
    from vexture.base.notes import check_losses, line_of
    from vexture.conversion.parameters import Parameters
    from vexture.conversion.pipeline import run
    from vexture.fonts.text import TextOptions, text_drawing

    with within(parameters.get("max_seconds", DEFAULT_SECONDS)):
        drawing = text_drawing(words, TextOptions(**styled))
        if not drawing.paths:
            raise SourceError(f"{drawing.name}: nothing of the text is painted; give characters that a font has")
        parameters.setdefault("split", "auto" if drawing.is_coloured else None)  # otherwise programs set the colour
        done = run(drawing, Parameters.from_mapping(parameters))
    check_losses(drawing.name, done.notes, is_empty=False, strict=strict)
    files = done.texture.files(**stored)
    facts = shape_facts(done) | {"bytes": sum(map(len, files.values()))}
    return ConversionResult(drawing.name, facts, files, warning=line_of(drawing.name, done.notes))


def paint_of(color: tuple[float, float, float, float] | None) -> "Paint":
    """Return the paint of a premultiplied colour; black if there is no colour."""
    from vexture.drawing.paint import BLACK, Paint

    if color is None:
        return BLACK
    red, green, blue, opacity = color
    return Paint((red / opacity, green / opacity, blue / opacity), opacity) if opacity else Paint(opacity=0.0)
