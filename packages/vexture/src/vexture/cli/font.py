"""The command `font`."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import click

from vexture.base.deadline import DEFAULT_SECONDS
from vexture.base.errors import ParameterError, format_count
from vexture.base.layout import PACKED_SUFFIX
from vexture.base.notes import Note
from vexture.cli.convert import check_places, given_options, options_of_convert
from vexture.cli.messages import echo, one_line, say_notes
from vexture.cli.options import PATH, face_options
from vexture.cli.result import is_texture_file
from vexture.texture.registry import DEFAULT

EXAMPLE = """\b
Examples:
  vexture font Lato.ttf -o lato.ktx2                       ASCII, and its metrics in lato.json
  vexture font Lato.ttf --range U+0020-00FF --chars "€…" -o lato.ktx2
"""


@options_of_convert("tolerance", "max_depth", "capacity", "precision", "deflate", "max_seconds", "strict", "quiet")
@click.command(epilog=EXAMPLE)
@click.argument("font", metavar="[FONT]", required=False, type=PATH)
@click.option("-o", "--output", metavar="FILE.ktx2", required=True, type=PATH, help="File to write, or a folder.")
@click.option("--chars", metavar="TEXT", help="Characters to convert.  [default: those of ASCII]")
@click.option("--chars-file", metavar="FILE", type=PATH, help="A text in UTF-8 whose characters to convert.")
@click.option(
    "--range",
    "ranges",
    metavar="U+A-B",
    multiple=True,
    help="Characters of a range that the font has, such as U+0400-04FF; may be given several times.",
)
@face_options
@click.option("--name", help="Name of the texture.  [default: the family]")
def font(
    font: Path | None,
    output: Path,
    chars: str | None,
    chars_file: Path | None,
    ranges: tuple[str, ...],
    weight: float,
    style: str,
    stretch: float,
    name: str | None,
    strict: bool,
    quiet: bool,
    **options: Any,
) -> None:
    """Convert the characters of a font into one texture, with a shape for each and metrics as JSON.

    FONT is a file, or a folder of the faces of a font; by default Noto Sans.
    """
    with one_line():
        from vexture.base.apart import apart
        from vexture.texture.files import write_together

        check_places((), output, None, DEFAULT, False)
        asked = (chars or "") + ("" if chars_file is None else read_text(chars_file))
        styled = (weight, style, stretch, name)
        wanted = None if chars is None and chars_file is None and not ranges else asked
        parameters = given_options(options)
        stored = {name: parameters.pop(name) for name in ("deflate",) if name in parameters}
        given = (wanted, [code for text in ranges for code in codes_of(text)], parameters, stored)
        about, seconds = str(font or "the font"), parameters.get("max_seconds", DEFAULT_SECONDS)
        made = apart(_convert_font, styled, *given, font, output, strict, name=about, seconds=seconds)
        write_together(made.files)
        if not quiet:
            say_notes(made.about, made.notes)
            target, metrics = made.files
            counts = f"{format_count(made.characters, 'character')}, {format_count(made.shapes, 'shape')}"
            echo(f"{target}: {counts}, {len(made.files[target])} bytes; {metrics}")


class FontFiles(NamedTuple):
    """The files of a font's texture, with its notes."""

    about: str
    files: dict[Path, bytes]
    characters: int
    shapes: int
    notes: Sequence[Note]


def _convert_font(
    styled: tuple[Any, ...],
    characters: str | None,
    ranged: list[int],
    parameters: dict[str, Any],
    stored: dict[str, Any],
    font: Path | None,
    output: Path,
    strict: bool,
) -> FontFiles:
    """Convert a font into its files; the font may be untrusted."""
    from vexture.base.notes import check_losses
    from vexture.conversion.glyph_atlas import PRINTABLE, made_atlas
    from vexture.fonts.text import TextOptions
    from vexture.texture.files import file_name

    weight, style, stretch, name = styled
    options = TextOptions(font or (), (), weight, style, stretch, name=name)
    result = made_atlas(options, PRINTABLE if characters is None else characters, ranged, **parameters)
    about = str(font or result.texture.name)
    check_losses(about, result.notes, is_empty=False, strict=strict)
    place = output if is_texture_file(output, DEFAULT) else output / (file_name(result.texture.name) + PACKED_SUFFIX)
    return FontFiles(
        about, result.files(place, **stored), len(result.metrics["glyphs"]), len(result.texture.roots), result.notes
    )


def read_text(file: Path) -> str:
    """Read the printable characters of a file, and so no line breaks."""
    from vexture.base.content import about, read_bytes

    with about(str(file)):
        try:
            return "".join(character for character in read_bytes(file).decode("utf-8-sig") if character.isprintable())
        except UnicodeDecodeError:
            raise ParameterError("is no text in UTF-8; save it as one") from None


def codes_of(text: str) -> range:
    """Return the characters of a range such as U+0400-04FF.

    Examples
    --------
    >>> codes_of("U+41-5A"), codes_of("U+20AC")
    (range(65, 91), range(8364, 8365))
    """
    first, _, last = text.upper().removeprefix("U+").partition("-")
    try:
        low, high = int(first, 16), int(last.removeprefix("U+") or first, 16)
    except ValueError:
        low, high = 1, 0
    if not low <= high <= LAST_CHARACTER:
        raise ParameterError(f"`range` {text!r} is no range of characters; write one as U+0400-04FF")
    return range(low, high + 1)


LAST_CHARACTER = 0x10FFFF
