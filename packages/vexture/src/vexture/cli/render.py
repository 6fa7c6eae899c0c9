"""The command `render`."""

from functools import partial
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from vexture.base.deadline import DEFAULT_SECONDS, within
from vexture.base.errors import DeviceError, ParameterError
from vexture.cli.messages import one_line, say_notes
from vexture.cli.options import (
    PATH,
    STANDARD,
    Colour,
    RectangleArgument,
    as_given,
    check_output,
    drawing_kind,
    font_option,
    images_options,
    page_color_option,
    read_stream,
    shown_name,
    strict_option,
    write_output,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from vexture.conversion.images import Shown

DEFAULT_SIZE: Final = 512

EXAMPLE = """\b
Examples:
  vexture render logo.svg -o logo.png                              in its colours on white
  vexture render logo.ktx2 -o logo.png --width 800 --height 200
  vexture render logo.ktx2 -o bill.png --view 0.5,0.5,0.25,0.25    the lower left of the upper right quarter
  vexture render icons.ktx2 -o duck.png --root duck --background none
"""


@click.command(epilog=EXAMPLE)
@click.argument("source", metavar="SOURCE_OR_TEXTURE", type=PATH)
@click.option("-o", "--output", metavar="PNG|-", required=True, type=PATH, help="File to write; - is standard output.")
@click.option("--size", metavar="N", type=int, help=f"Longer side in pixels.  [default: {DEFAULT_SIZE}]")
@click.option(
    "--width", metavar="W", type=int, help="Width in pixels; the height follows from the view, so from the drawing."
)
@click.option(
    "--height", metavar="H", type=int, help="Height in pixels; the width follows from the view, so from the drawing."
)
@click.option("--background", type=Colour(), default="white", show_default=True, help="Colour below the drawing.")
@click.option("--silhouette", is_flag=True, help="Draw the covered part of each pixel in black, without colours.")
@click.option(
    "--view",
    type=RectangleArgument(),
    help="Part of the unit square, y up.  [default: the drawing's box, which is as wide or as high as the square; "
    "of a texture, all of it]",
)
@click.option("--rotate", metavar="DEG", type=float, default=0.0, help="Turn the picture counter-clockwise.")
@click.option("--root", metavar="NAME_OR_INDEX", help="Shape of a texture, or drawing of an atlas.")
@click.option("--select", metavar="SELECTOR", help="Draw only the elements of an SVG that a CSS selector matches.")
@font_option
@page_color_option
@images_options
@strict_option
@click.option(
    "--max-seconds",
    metavar="S",
    type=float,
    default=DEFAULT_SECONDS,
    help=f"Most seconds for reading a drawing, and for drawing it.  [default: {DEFAULT_SECONDS:g}]",
)
@click.option(
    "--renderer",
    type=click.Choice(["cpu", "gpu", "exact"]),
    default="cpu",
    show_default=True,
    help="The texture in Python; the texture by the shader; the drawing itself, exactly; minutes for "
    "gradients that repeat within a pixel.",
)
def render(
    source: Path,
    output: Path,
    size: int | None,
    width: int | None,
    height: int | None,
    background: tuple[float, float, float, float],
    view: tuple[float, float, float, float] | None,
    rotate: float,
    root: str | None,
    select: str | None,
    fonts: tuple[Path, ...] | None,
    images: str | None,
    page_colors: dict[str, str] | None,
    strict: bool,
    max_seconds: float,
    **options: Any,
) -> None:
    """Render a drawing, a picture or a texture to a PNG, in its colours.

    SOURCE_OR_TEXTURE may be - for standard input.
    """
    with one_line():
        from vexture.renderers.view import window

        check_output(output)
        if output != Path(STANDARD) and output.suffix.lower() != ".png":
            raise ParameterError(f"`output` {output}: pictures are PNG files; name one that ends in .png")
        _check_sides(size, width, height)
        seen = None if view is None else window(*view, rotate)  # checked before anything is read
        given = {"select": select, "fonts": fonts, "images": images, "page_colors": page_colors}
        reading = {name: value for name, value in given.items() if value is not None}
        shown = _read_or_load(source, reading, strict=strict, max_seconds=max_seconds)
        view = view or _box_of(shown)
        pixels = _pixels(size, width, height, view)
        with within(max_seconds):
            picture = _picture(shown, pixels, seen or window(*view, rotate), root=_root_of(shown, root), **options)
        _write_png(_over(picture, background), output)


def _check_sides(size: int | None, width: int | None, height: int | None) -> None:
    """Refuse impossible sizes of a picture, and sizes that contradict each other."""
    from vexture.renderers.view import SIZE_LIMIT

    if size is not None and (width is not None or height is not None):
        raise ParameterError(f"`size` {size} sets the longer side; leave it out beside `width` or `height`")
    for name, side in (("size", size), ("width", width), ("height", height)):
        if side is not None and not 1 <= side <= SIZE_LIMIT:
            raise ParameterError(f"`{name}` is {side}; it must be 1 to {SIZE_LIMIT}")


def _box_of(subject: "Shown") -> tuple[float, float, float, float]:
    """Return the part of the unit square that a drawing's box fills; all of it for a texture, which has no box."""
    from vexture.drawing.drawing import Drawing

    width, height = subject.sides if isinstance(subject, Drawing) else (1.0, 1.0)
    return (1.0 - width) / 2, (1.0 - height) / 2, width, height


def _pixels(
    size: int | None, width: int | None, height: int | None, view: tuple[float, float, float, float]
) -> tuple[int, int]:
    """Return the width and height of the picture; a missing one follows from the view."""
    _, _, w, h = view
    ratio = w / h if w > 0.0 and h > 0.0 else 1.0
    if width is None and height is None:
        side = DEFAULT_SIZE if size is None else size
        width, height = (side, None) if ratio >= 1.0 else (None, side)
    if width is None:
        assert height is not None
        return max(round(height * ratio), 1), height
    return width, height if height is not None else max(round(width / ratio), 1)


def _picture(
    subject: "Shown", pixels: tuple[int, int], view: Any, *, silhouette: bool, **options: Any
) -> "NDArray[Any]":
    """Render a picture as premultiplied RGBA."""
    import numpy as np

    from vexture.conversion.images import coverage
    from vexture.conversion.images import render as picture_of

    if not silhouette:
        return picture_of(subject, pixels, view, **options)
    covered = coverage(subject, pixels, view, **options)
    return np.stack([np.zeros_like(covered)] * 3 + [covered], axis=2)


def _over(picture: "NDArray[Any]", background: tuple[float, float, float, float]) -> "NDArray[np.uint8]":
    """Put a picture on a background; return bytes: RGB if the background is opaque, else RGBA, not premultiplied."""
    import numpy as np

    whole = picture + (1.0 - picture[..., 3:]) * np.array(background, np.float32)
    if background[3] >= 1.0:
        return np.rint(255.0 * whole[..., :3]).astype(np.uint8)
    alpha = whole[..., 3:]
    straight = np.divide(whole[..., :3], alpha, out=np.zeros_like(whole[..., :3]), where=alpha > 0.0)
    return np.rint(255.0 * np.concatenate([straight.clip(0.0, 1.0), alpha], axis=2)).astype(np.uint8)


def _root_of(subject: "Shown", root: str | None) -> str | int | None:
    """Return a shape's name, or its index if no shape has that name."""
    from vexture.texture.select_root import drawing_of
    from vexture.texture.texture import Texture

    if root is None:
        return None
    if not isinstance(subject, Texture):
        raise ParameterError(f"`root` {root} chooses a shape of a texture; leave it out, or use `select` for an SVG")
    names = {part for one in subject.roots for part in (one.name, drawing_of(one))}
    return int(root) if root not in names and root.isdecimal() else root


def _read_or_load(path: Path, reading: dict[str, Any], *, strict: bool, max_seconds: float) -> "Shown":
    """Read a drawing with parameters, or load a texture by one of its files or by the common part of their names."""
    from vexture.base.apart import apart
    from vexture.base.content import FileKind, kind_of, start_of
    from vexture.base.notes import check_losses
    from vexture.conversion.reading import read_drawing
    from vexture.texture.load import load_any, texture_from

    data, name = read_stream(path), shown_name(path)
    kind = drawing_kind(path) if data is None else kind_of(start_of(data))
    if kind not in (None, FileKind.TEXTURE):
        given = path if data is None else data
        drawing = apart(partial(read_drawing, name=name, **reading), given, name=name, seconds=max_seconds)
        check_losses(name, drawing.notes, is_empty=not drawing.paths, strict=strict)
        say_notes(name, drawing.notes)
        return drawing
    for option, value in reading.items():
        typed = as_given(option, value)
        raise ParameterError(f"{name}: `{option}`{typed} is for a drawing; give it to vexture convert")
    return load_any(path) if data is None else texture_from(data, name)


def _write_png(image: "NDArray[np.uint8]", output: Path) -> None:
    """Write a picture (height, width, 3 or 4) as PNG."""
    from PIL import Image

    from vexture.texture.files import write_together

    data = BytesIO()
    Image.fromarray(image).save(data, format="PNG")
    if output == Path(STANDARD):
        write_output(data.getvalue())
        return
    if not output.resolve().parent.is_dir():
        raise DeviceError(f"{output}: cannot be written (there is no such folder); choose another file with -o")
    write_together({output: data.getvalue()})
