"""The command `render`."""

import os
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from vexture.cli.messages import one_line
from vexture.errors import DeviceError, LimitError

if TYPE_CHECKING:
    from vexture.images import Shown

__all__ = ["render"]

DEFAULT_SIZE = 512


class _View(click.ParamType[Any]):
    """Four numbers, separated by commas."""

    name = "X,Y,W,H"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        try:
            x, y, w, h = (float(part) for part in str(value).split(","))
        except ValueError:
            self.fail(f"{value!r} is not four numbers X,Y,W,H", param, ctx)
        return x, y, w, h


@click.command()
@click.argument("source", metavar="SOURCE_OR_TEXTURE", type=click.Path(path_type=Path))
@click.option("-o", "--output", metavar="PNG", required=True, type=click.Path(path_type=Path), help="File to write.")
@click.option("--size", metavar="N", type=int, default=DEFAULT_SIZE, show_default=True, help="Longer side in pixels.")
@click.option(
    "--renderer",
    type=click.Choice(["exact", "cpu", "gpu"]),
    default="cpu",
    show_default=True,
    help="The drawing itself, exactly; its texture by Python; its texture by the shader.",
)
@click.option(
    "--quality",
    type=click.Choice(["fast", "exact"]),
    default="exact",
    show_default=True,
    help="How closely pixels that are turned or tilted are computed.",
)
@click.option("--view", type=_View(), default="0,0,1,1", show_default=True, help="Part of the unit square, y up.")
@click.option("--rotate", metavar="DEG", type=float, default=0.0, help="Turn the picture counter-clockwise.")
@click.option("--root", metavar="NAME_OR_INDEX", help="Shape of a texture, or drawing of an atlas of layers.")
@click.option("--silhouette", is_flag=True, help="Draw the covered part of each pixel in black, without colours.")
@click.option("--select", metavar="SELECTOR", help="Draw only the elements of an SVG that a CSS selector matches.")
def render(
    source: Path,
    output: Path,
    size: int,
    view: tuple[float, float, float, float],
    rotate: float,
    root: str | None,
    silhouette: bool,
    select: str | None,
    **options: Any,
) -> None:
    """Draw a drawing, a picture as it is traced, or a texture as a PNG, in its colours on white."""
    with one_line():
        from vexture.images import coverage
        from vexture.images import render as picture_of
        from vexture.renderers.view import window

        shown = _shown(source, select)
        _, _, w, h = view
        longer = max(w, h)
        ratio = (w / longer, h / longer) if longer > 0.0 else (1.0, 1.0)
        width, height = (max(round(size * side), min(size, 1)) for side in ratio)
        shape = _root_of(shown, root)
        where = (width, height), window(*view, rotate)
        if silhouette:
            image = 1.0 - coverage(shown, *where, root=shape, **options)
        else:
            picture = picture_of(shown, *where, root=shape, **options)
            image = picture[..., :3] + (1.0 - picture[..., 3:])
        _write_png(image, output)


def _root_of(shown: "Shown", root: str | None) -> str | int | None:
    """Shape that the option means: a name, or if none has that name a place."""
    from vexture.texture.texture import Texture

    if root is None:
        return None
    if not isinstance(shown, Texture):
        raise LimitError(f"--root {root} chooses a shape of a texture; leave it out, or use --select for an SVG")
    names = {part for one in shown.roots for part in (one.name, one.name.rpartition("/")[0])}
    return int(root) if root not in names and root.isdecimal() else root


def _shown(path: Path, select: str | None) -> "Shown":
    """Read a drawing, or load a texture by one of its files or what their names have in common."""
    from vexture.encodings import owner_of
    from vexture.layout import PACKED_SUFFIX
    from vexture.texture.load import load_any

    is_texture = path.name.lower().endswith(PACKED_SUFFIX) or owner_of(path) is not None
    if path.is_file() and not is_texture:
        from vexture.reading import read_drawing

        return read_drawing(path, select)
    if select is not None:
        raise LimitError(f"{path}: --select {select} needs the drawing; give it to vexture convert")
    return load_any(path)


def _write_png(image: Any, output: Path) -> None:
    """Write a picture of values 0..1, by a temporary name."""
    import numpy as np
    from PIL import Image

    if output.suffix.lower() != ".png":
        raise LimitError(f"--output {output}: pictures are PNG files; name one that ends in .png")
    output = output.resolve()  # a link is not replaced, but what it stands for
    if output.exists() and not output.is_file():
        raise DeviceError(f"{output}: cannot be written (not a regular file); choose another file with -o")
    partial = output.with_name(f".{output.name}.{os.getpid()}.part")
    try:
        Image.fromarray(np.rint(255.0 * image).astype(np.uint8)).save(partial, format="PNG")
        partial.replace(output)
    except OSError as error:
        with suppress(OSError):
            partial.unlink()
        raise DeviceError(f"{output}: cannot be written ({error.strerror}); choose another file with -o") from None
