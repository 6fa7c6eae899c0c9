"""The command `fold`."""

from functools import partial
from io import BytesIO
from pathlib import Path

import click

from vexture.base.errors import ParameterError
from vexture.cli.messages import echo, one_line, say_notes
from vexture.cli.options import PATH, font_option

EXAMPLE = """\b
Example:
  vexture fold island.svg -o island.fold.ktx2 --amplitude 0.01 --picture island.png
"""


@click.command(epilog=EXAMPLE)
@click.argument("drawing", metavar="DRAWING", type=PATH)
@click.option("-o", "--output", metavar="NAME.fold.ktx2", required=True, type=PATH, help="File to write, or a folder.")
@click.option(
    "--amplitude", metavar="A", type=float, default=0.005, show_default=True, help="Largest shift, unit-square units."
)
@click.option("--period", metavar="SECONDS", type=float, default=8.0, show_default=True, help="Time between two waves.")
@click.option("--size", metavar="N", type=int, default=64, show_default=True, help="Texels each way, 8 to 256.")
@click.option("--picture", metavar="PNG", type=PATH, help="Also draw the motion as a picture.")
@font_option
def fold(
    drawing: Path,
    output: Path,
    amplitude: float,
    period: float,
    size: int,
    picture: Path | None,
    fonts: tuple[Path, ...] | None,
) -> None:
    """Make the outline of a drawing move to and fro, like water on a beach."""
    with one_line():
        import numpy as np

        from vexture.base.apart import apart
        from vexture.base.layout import PACKED_SUFFIX
        from vexture.conversion.reading import read_drawing
        from vexture.fold.layout import FOLD_SUFFIX
        from vexture.fold.shore import fold_of_shore
        from vexture.texture.files import file_name, write_together

        if picture is not None and picture.suffix.lower() != ".png":
            raise ParameterError(f"`picture` {picture}: pictures are PNG files; name one that ends in .png")
        if not output.is_dir() and output.suffix.lower() != PACKED_SUFFIX:
            raise ParameterError(f"`output` {output}: folds are KTX2 files; name one that ends in {FOLD_SUFFIX}")
        shape = apart(partial(read_drawing, fonts=fonts or (), for_outlines=True), drawing, name=str(drawing))
        result = fold_of_shore(shape, amplitude=amplitude, period=period, size=size)
        say_notes(drawing, (*shape.notes, *result.notes))
        target = output / (file_name(shape.name) + FOLD_SUFFIX) if output.is_dir() else output
        files = {target: result.to_ktx2()}
        if picture is not None:
            from vexture.fold.picture import fold_picture

            data = BytesIO()
            fold_picture(result, shape).save(data, format="PNG")
            files[picture] = data.getvalue()
        write_together(files)
        largest = float(np.hypot(result.displacement[..., 0], result.displacement[..., 1]).max())
        columns, rows = result.size
        echo(
            f"{target}: {columns} x {rows} texels, {len(files[target])} bytes, largest shift {largest:.3g}, "
            f"{result.cycle:g} s"
        )
