"""The command `gltf`."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from vexture.base.deadline import DEFAULT_SECONDS
from vexture.base.errors import ParameterError
from vexture.cli.convert import given_options, options_of_convert
from vexture.cli.messages import echo, one_line, say_notes
from vexture.cli.options import PATH, drawing_kind

if TYPE_CHECKING:
    from vexture.gltf.model import Model
    from vexture.texture.texture import Texture

EXAMPLE = """\b
Examples:
  vexture gltf van.glb --list
  vexture gltf van.glb --material Door --drawing logo.svg -o painted.glb
  vexture gltf van.glb --material Hood --drawing icons.ktx2 --root star --mode mix --color red -o van2.glb
"""


class NumberPair(click.ParamType):  # type: ignore[type-arg]
    """Two numbers separated by a comma, or one number for both."""

    name = "X,Y"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Parse the numbers."""
        if isinstance(value, tuple):
            return value
        try:
            parts = [float(part) for part in str(value).split(",")]
            x, y = parts * 2 if len(parts) == 1 else parts
        except ValueError:
            self.fail(f"{value!r} is not two numbers X,Y", param, ctx)
        return x, y


@options_of_convert(
    *("select", "names", "fonts", "page_colors", "images", "tolerance", "max_depth", "capacity", "precision"),
    *("restyle", "max_seconds", "strict", "quiet"),
)
@click.command(epilog=EXAMPLE)
@click.argument("model", metavar="MODEL", type=PATH)
@click.option("--list", "lists", is_flag=True, help="Print the places and names of the model's materials.")
@click.option(
    "--material",
    "materials",
    metavar="NAME",
    multiple=True,
    help="Name of the material that gets the drawing, or its place from 0; may be given several times.",
)
@click.option(
    "--drawing",
    "drawings",
    metavar="FILE",
    type=PATH,
    multiple=True,
    help="Drawing to convert, or a texture (.ktx2): one for each --material, or one for all.",
)
@click.option("-o", "--output", metavar="FILE.glb|.gltf", type=PATH, help="File to write.")
@click.option("--root", metavar="NAME", help="The shape or drawing, in a texture of several.")
@click.option(
    "--mode",
    type=click.Choice(["paint", "mix", "cut", "alpha"]),
    default="paint",
    show_default=True,
    help="paint: the drawing's colours. mix: --color where the drawing is. cut: nothing where it is not. alpha: the "
    "same with a soft edge.",
)
@click.option(
    "--wrap",
    type=click.Choice(["none", "clamp", "repeat"]),
    default="none",
    show_default=True,
    help="Beyond the unit square: nothing, the value at its border, or the drawing again.",
)
@click.option("--invert", is_flag=True, help="Exchange inside and outside; not in mode paint.")
@click.option(
    "--background", type=click.Choice(["own", "none"]), help="Mode paint: colour around the drawing.  [default: own]"
)
@click.option("--color", metavar="COLOR", help="Mode mix: a CSS colour.  [default: white]")
@click.option("--threshold", metavar="T", type=float, help="Mode cut: least coverage that is drawn.  [default: 0.5]")
@click.option("--tex-coord", metavar="N", type=click.IntRange(0, 1), help="Set of texture coordinates.  [default: 0]")
@click.option("--scale", type=NumberPair(), help="Of the texture coordinates: 4 makes the drawing a quarter as large.")
@click.option("--rotation", metavar="DEG", type=float, help="Turns the drawing counter-clockwise about the origin.")
@click.option("--offset", type=NumberPair(), help="Moves texture coordinates, after --scale and --rotation.")
def gltf(
    model: Path,
    lists: bool,
    materials: tuple[str, ...],
    drawings: tuple[Path, ...],
    output: Path | None,
    strict: bool,
    quiet: bool,
    **options: Any,
) -> None:
    """Put drawings on the materials of a model (glTF 2.0, .glb or .gltf).

    three.js shows them with the plugin of the npm entry vexture/gltf. Other programs show the original materials;
    everything else in the model stays as it is.
    """
    with one_line():
        from vexture.gltf.appearance import Appearance
        from vexture.gltf.model import read_model

        if lists:
            if materials or drawings or output:
                raise ParameterError("`list` only prints the materials; leave the other options out")
            for place, name in enumerate(read_model(model).materials):
                echo(f"{place} {name}".rstrip())
            return
        output = _output_of(materials, drawings, output)
        shown = {name: options.pop(name) for name in Appearance.__dataclass_fields__}
        shown = {name: value for name, value in shown.items() if value is not None}
        parameters = given_options(options)
        changed = read_model(model)
        for material in materials:
            changed.place_of(material)  # so that errors come before any conversion
        textures = [_texture_of(drawing, Appearance(**shown), parameters, strict, quiet) for drawing in drawings]
        for place, material in enumerate(materials):
            changed = changed.with_drawing(material, textures[min(place, len(textures) - 1)], **shown)
        _write(changed, output, materials, quiet)


def _output_of(materials: Sequence[str], drawings: Sequence[Path], output: Path | None) -> Path:
    """Return the file to write; raise a `ParameterError` if an option is missing."""
    from vexture.gltf.model import target_of

    for name, given in (("material", materials), ("drawing", drawings), ("output", output)):
        if not given:
            raise ParameterError(f"`{name}` is missing; give one, or `list` to print the materials")
    if len(drawings) not in (1, len(materials)):
        raise ParameterError(
            f"there are {len(drawings)} drawings for {len(materials)} materials; give a `drawing` for each "
            "`material`, or one for all"
        )
    assert output is not None
    return target_of(output)


def _texture_of(drawing: Path, appearance: Any, parameters: dict[str, Any], strict: bool, quiet: bool) -> "Texture":
    """Return the texture in a file, or convert the drawing in it."""
    from vexture.base.apart import apart
    from vexture.base.notes import check_losses
    from vexture.conversion.parameters import Parameters
    from vexture.conversion.pipeline import run
    from vexture.gltf.model import texture_of

    if drawing_kind(drawing) is None:
        without = {name: value for name, value in parameters.items() if (name, value) != ("tolerance", "auto")}
        return texture_of(drawing, appearance, without)
    limit = parameters.get("max_seconds", DEFAULT_SECONDS)
    whole = Parameters.from_mapping({"split": appearance.split, **parameters})
    done = apart(partial(run, drawing, whole), name=str(drawing), seconds=limit)
    check_losses(str(drawing), done.notes, is_empty=not done.drawing.paths, strict=strict)
    if not quiet:
        say_notes(drawing, done.notes)
    return done.texture


def _write(model: "Model", output: Path, materials: Sequence[str], quiet: bool) -> None:
    """Write the model, and print a line about it."""
    from vexture.texture.files import write_together

    files = model.files(output)
    write_together(files)
    if not quiet:
        names = ", ".join(repr(model.materials[model.place_of(one)] or one) for one in materials)
        sizes = ", ".join(f"{file.name} {len(content)} bytes" for file, content in files.items())
        echo(f"{output}: drawings on {names}; {sizes}")
