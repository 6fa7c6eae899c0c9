"""The command `restyle`."""

from pathlib import Path

import click

from vexture.base.errors import ParameterError, format_count
from vexture.base.layout import PACKED_SUFFIX
from vexture.cli.messages import echo, one_line
from vexture.cli.options import PATH

EXAMPLE = """\b
Example:
  vexture convert map.geojson --split faces --restyle
  vexture restyle map.ktx2 Delft=crimson Leiden=#0066cc -o elections.ktx2
"""


@click.command(epilog=EXAMPLE)
@click.argument("texture", metavar="TEXTURE", type=PATH)
@click.argument("paints", metavar="NAME=COLOUR...", nargs=-1, required=True)
@click.option(
    "-o",
    "--output",
    metavar="FILE.ktx2",
    required=True,
    type=PATH,
    help="File to write, or another folder.",
)
@click.option("--root", metavar="NAME", help="The drawing, in a texture of several.")
def restyle(texture: Path, paints: tuple[str, ...], output: Path, root: str | None) -> None:
    """Change the colours of elements in a planar map.

    A colour is a CSS colour, or none. Make the texture with --split faces --restyle; vexture info lists its elements.
    """
    with one_line():
        from vexture.texture.load import load

        for text in paints:
            if "=" not in text:
                raise ParameterError(f"{text!r} names no colour; give NAME=COLOUR")
        place = output / texture.name if output.is_dir() else output
        if place.suffix.lower() != PACKED_SUFFIX:
            raise ParameterError(f"`output` {output}: textures are KTX2 files; name one that ends in {PACKED_SUFFIX}")
        if place != output and place.exists() and place.samefile(texture):
            raise ParameterError(f"`output` {output}: it holds {texture.name} itself; name a file, or another folder")
        colours = {name: colour for name, _, colour in (text.rpartition("=") for text in paints)}
        target = load(texture).with_paints(colours, root=root).save(place)
        echo(f"{target}: {format_count(len(colours), 'element')} in other colours, {target.stat().st_size} bytes")
