"""The command line: arguments and messages only."""

import json
import sys
from collections.abc import Callable, Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from vexture.arguments import Tolerance
from vexture.cli_flood import flood
from vexture.cli_fold import fold
from vexture.cli_live import push, serve
from vexture.cli_report import report
from vexture.cli_view import export, view
from vexture.errors import DeviceError, LimitError, VextureError
from vexture.messages import one_line, say, say_notes
from vexture.settings import Settings

if TYPE_CHECKING:
    from vexture.drawing import Drawing
    from vexture.encoding import PackedTexture, ThesisTexture
    from vexture.quadtree.tree import CellTree, PackedTree

__all__ = ["main"]

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


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(package_name="vexture")
def main() -> None:
    """Turn vector drawings into textures that a GPU reads at random."""


@main.command()
@click.argument("sources", metavar="SOURCE...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    metavar="DIR|FILE.ktx2",
    type=click.Path(path_type=Path),
    help="Folder to write to, or the file for one drawing.  [default: .]",
)
@click.option(
    "--atlas",
    metavar="FILE.ktx2",
    type=click.Path(path_type=Path),
    help="Write one texture of all the drawings instead, each a shape of its file's name.",
)
@click.option(
    "--encoding",
    type=click.Choice(["packed", "thesis"]),
    default="packed",
    show_default=True,
    help="Several exact pieces in a leaf, one file; or the thesis's one curve, a pair of images.",
)
@click.option("--split", type=click.Choice(["paint"]), help="Make each colour a shape of its own, in painting order.")
@click.option("--select", metavar="SELECTOR", help="Convert only the elements that a CSS selector matches.")
@click.option(
    "--tolerance",
    type=Tolerance(),
    default="auto",
    show_default=True,
    help="Largest distance from the drawing's outline, in drawing sizes; for packed, auto is 0.",
)
@click.option("--max-depth", metavar="D", type=int, help="Divide no further.  [default: 16; for thesis 10]")
@click.option("--capacity", metavar="N", type=int, help="Pieces in a leaf, 1 to 15 (packed).  [default: 4]")
@click.option("--precision", metavar="P", type=float, help="Largest shift by rounding, in drawing sizes (packed).")
@click.option("--bits", type=click.Choice(["8", "16"]), help="Bits per channel (thesis).  [default: 16]")
@click.option(
    "--strategy",
    type=click.Choice(["direct", "sampled"]),
    help="Take leaves from the drawing's own cubics, or sample and fit (thesis).  [default: direct]",
)
def convert(
    sources: tuple[Path, ...], output: Path | None, atlas: Path | None, bits: str | None, **parameters: Any
) -> None:
    """Convert drawings (SVG, GeoJSON) and pictures to trace (PNG, JPEG, WebP, GIF, BMP) into textures.

    Of geographic data (GeoPackage, FlatGeobuf, shapefile; GeoTIFF, NetCDF) it takes where water is, of several times
    the first.
    """
    with one_line():
        settings = Settings(bits=None if bits is None else int(bits), **parameters)
        if atlas is None:
            failed = _convert_each(sources, output or Path(), settings)
        elif output is not None:
            raise LimitError(f"--output {output} and --atlas {atlas}: an atlas is one file; leave --output out")
        else:
            failed = _convert_together(sources, atlas, settings)
    if failed:
        if len(sources) > 1:
            say(f"{failed} of {len(sources)} files failed{'' if atlas is None else f'; {atlas} is not written'}")
        sys.exit(1)


def _convert_each(sources: tuple[Path, ...], output: Path, settings: Settings) -> int:
    """Convert each file to files of its own, print a line for each, return how many failed."""
    from vexture.encoding.files import packed_target, target_of
    from vexture.encoding.layout import PACKED_SUFFIX
    from vexture.pipeline import run

    is_file = settings.encoding == "packed" and output.suffix.lower() == PACKED_SUFFIX and not output.is_dir()
    if is_file and len(sources) > 1:
        raise LimitError(f"--output {output}: one file for {len(sources)} drawings; use --atlas, or name a folder")
    folder = output.parent if is_file else output
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise DeviceError(f"{folder}: cannot be made ({error.strerror}); choose another folder with -o") from None
    written: dict[Path, Path] = {}

    def convert_one(source: Path) -> str:
        conversion = run(source, **asdict(settings))
        say_notes(source, conversion.drawing.notes)
        name = conversion.texture.name
        first = packed_target(output, name) if settings.encoding == "packed" else target_of(output, name)[0]
        if first in written:
            raise LimitError(f"{source}: {first} is already what {written[first]} became; convert it to another folder")
        saved = conversion.texture.save(output)
        files = saved if isinstance(saved, tuple) else (saved,)
        written[first] = source
        size = sum(file.stat().st_size for file in files)
        return _described(conversion.drawing, conversion.trees, size, conversion.seconds, settings)

    return _work_through(sources, convert_one)


def _convert_together(sources: tuple[Path, ...], atlas: Path, settings: Settings) -> int:
    """Convert all files to one texture, written if none failed; print a line for each, return how many failed."""
    from vexture.encoding.ktx2 import TEXEL_BYTES
    from vexture.encoding.layout import PACKED_SUFFIX
    from vexture.pipeline import Shapes, join, shapes_of

    if settings.encoding != "packed":
        raise LimitError(f"--atlas {atlas}: the encoding {settings.encoding} holds one shape; use the encoding packed")
    if atlas.suffix.lower() != PACKED_SUFFIX or atlas.is_dir():
        raise LimitError(f"--atlas {atlas}: a packed texture is a file whose name ends in {PACKED_SUFFIX}; name one")
    parts: list[Shapes] = []

    def convert_one(source: Path) -> str:
        part = shapes_of(source, settings)
        say_notes(source, part.drawing.notes)
        parts.append(part)
        texels = sum(len(tree.count) + len(tree.curves) for tree in part.trees)
        return _described(part.drawing, part.trees, TEXEL_BYTES * texels, part.seconds, settings)

    failed = _work_through(sources, convert_one)
    if not failed:
        texture = join(parts, atlas.stem)
        texture.save(atlas)
        click.echo(f"{atlas}: {len(texture.roots)} shapes, {atlas.stat().st_size} bytes")
    return failed


def _work_through(sources: tuple[Path, ...], work: Callable[[Path], str]) -> int:
    """Print what becomes of each file, or in one line why nothing does; return how many failed."""
    failed = 0

    def attempt(source: Path) -> str | None:
        nonlocal failed
        try:
            return work(source)
        except VextureError as error:
            failed += 1
            say(str(error))
            return None

    for line in _with_progress(sources, attempt):
        if line:
            click.echo(line)
    return failed


def _described(
    drawing: "Drawing",
    trees: "tuple[PackedTree, ...] | tuple[CellTree, ...]",
    size: int,
    seconds: float,
    settings: Settings,
) -> str:
    """One line about a source."""
    from vexture.encoding import quantisation_step
    from vexture.quadtree.build_packed import largest_shift

    if settings.encoding == "packed":
        shift = largest_shift(settings.precision)
    else:
        shift = max(tree.widest_leaf for tree in trees) * quantisation_step(settings.bits or 16)
    unresolved = sum(tree.unresolved for tree in trees)
    layers = f"{len(trees)} layers, " if len(trees) > 1 else ""
    line = (
        f"{drawing.name}: {drawing.segments} segments, {layers}{sum(len(tree.coverage) for tree in trees)} quads, "
        f"{sum(len(tree.curves) for tree in trees)} curves, {size} bytes, {1000 * seconds:.1f} ms, "
        f"distance {max(tree.deviation for tree in trees):.1e} + {shift:.1e}"
    )
    return line + (f", {unresolved} cells at the depth limit" if unresolved else "")


def _with_progress(items: tuple[Path, ...], work: Callable[[Path], str | None]) -> Iterator[str | None]:
    """Results one by one, behind a progress bar if there are many and someone watches."""
    if len(items) < 2 or not sys.stderr.isatty():
        yield from map(work, items)
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as progress:
        for item in progress.track(items, description="converting"):
            yield work(item)


@main.command()
@click.argument("source", metavar="SOURCE_OR_TEXTURE", type=click.Path(path_type=Path))
@click.option("-o", "--output", metavar="PNG", required=True, type=click.Path(path_type=Path), help="File to write.")
@click.option("--size", metavar="N", type=int, default=DEFAULT_SIZE, show_default=True, help="Longer side in pixels.")
@click.option(
    "--renderer",
    type=click.Choice(["exact", "cpu", "gpu"]),
    default="gpu",
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
@click.option("--split", type=click.Choice(["paint"]), help="Draw a drawing in its flat colours.")
@click.option("--select", metavar="SELECTOR", help="Draw only the elements of an SVG that a CSS selector matches.")
def render(
    source: Path,
    output: Path,
    size: int,
    view: tuple[float, float, float, float],
    rotate: float,
    split: str | None,
    select: str | None,
    **options: Any,
) -> None:
    """Draw a drawing, a picture as it is traced, or a texture as a PNG.

    A texture that was split by paint is drawn in its colours, else a shape is black; on white.
    """
    with one_line():
        from vexture.pictures import on_white
        from vexture.render.view import window

        shape = _shape_of(source, split, select)
        _, _, w, h = view
        longer = max(w, h)
        ratio = (w / longer, h / longer) if longer > 0.0 else (1.0, 1.0)
        width, height = (max(round(size * side), min(size, 1)) for side in ratio)
        to_unit = window((width, height), *view, rotate)
        _write_png(on_white(shape, (width, height), to_unit, split=split, **options), output)


def _shape_of(path: Path, split: str | None, select: str | None) -> "Drawing | PackedTexture | ThesisTexture":
    """Read a drawing, or load a texture by one of its files or its stem."""
    from vexture.content import FileKind, kind_of, start_of
    from vexture.encoding import load
    from vexture.encoding.layout import CURVES_SUFFIX, QUADS_SUFFIX
    from vexture.sources.images import is_texture_image

    is_image = path.name.lower().endswith((QUADS_SUFFIX, CURVES_SUFFIX)) or is_texture_image(path)
    if path.is_file() and not is_image and kind_of(start_of(path), path) is not FileKind.TEXTURE:
        from vexture.sources.reading import read_drawing

        drawing = read_drawing(path, select=select)
        say_notes(path, drawing.notes)
        return drawing

    texture = load(path)
    for option, value in (("split", split), ("select", select)):
        if value is not None:
            raise LimitError(f"{path}: --{option} {value} needs the drawing; give it to vexture convert")
    return texture


def _write_png(image: Any, output: Path) -> None:
    """Write a picture of values 0..1."""
    from io import BytesIO

    import numpy as np
    from PIL import Image

    from vexture.encoding.files import write_together

    if output.suffix.lower() != ".png":
        raise LimitError(f"--output {output}: pictures are PNG files; name one that ends in .png")
    if not output.resolve().parent.is_dir():
        raise DeviceError(f"{output}: cannot be written (there is no such folder); choose another file with -o")
    data = BytesIO()
    Image.fromarray(np.rint(255.0 * image).astype(np.uint8)).save(data, format="PNG")
    write_together({output: data.getvalue()})


@main.command()
@click.argument("texture", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def info(texture: Path, as_json: bool) -> None:
    """Describe a texture."""
    with one_line():
        from vexture.encoding import info as describe
        from vexture.encoding import load

        facts = describe(load(texture))
        if as_json:
            click.echo(json.dumps(facts, indent=2))
            return
        for key, value in facts.items():
            for line in value if isinstance(value, list) and key == "roots" else [value]:
                text = ", ".join(f"{name} {count}" for name, count in line.items()) if isinstance(line, dict) else line
                click.echo(f"{key:<12}{text}")


main.add_command(serve)
main.add_command(push)
main.add_command(view)
main.add_command(export)
main.add_command(flood)
main.add_command(fold)
main.add_command(report)
