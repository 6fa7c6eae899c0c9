"""The command `convert`."""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from vexture.cli.messages import one_line, say
from vexture.cli.options import Tolerance
from vexture.encodings import DEFAULT
from vexture.errors import DeviceError, LimitError, VextureError
from vexture.settings import Settings

if TYPE_CHECKING:
    from vexture.drawing import Drawing

__all__ = ["convert"]

BELONGS_TO: Final = {
    "split": "packed",
    "capacity": "packed",
    "precision": "packed",
    "bits": "thesis",
    "strategy": "thesis",
}
"""Encoding of each option that means nothing in the others."""


@click.command()
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
    sources: tuple[Path, ...],
    output: Path | None,
    atlas: Path | None,
    encoding: str,
    bits: str | None,
    strategy: str | None,
    **parameters: Any,
) -> None:
    """Convert drawings (SVG, GeoJSON) and pictures to trace (PNG, JPEG, WebP, GIF, BMP) into textures.

    Of geographic data (GeoPackage, FlatGeobuf, shapefile; GeoTIFF, NetCDF) it takes where water is, of several times
    the first.
    """
    with one_line():
        asked = {name: value for name, value in parameters.items() if value is not None}
        if bits is not None:
            asked["bits"] = int(bits)
        if strategy is not None:
            asked["strategy"] = strategy
        _refuse_foreign(encoding, asked)
        if atlas is None:
            failed = _convert_each(sources, output or Path(), encoding, asked)
        elif output is not None:
            raise LimitError(f"--output {output} and --atlas {atlas}: an atlas is one file; leave --output out")
        elif encoding != DEFAULT:
            raise LimitError(f"--atlas {atlas}: the encoding {encoding} holds one shape; use the encoding {DEFAULT}")
        else:
            failed = _convert_together(sources, atlas, Settings(**asked))
    if failed:
        if len(sources) > 1:
            say(f"{failed} of {len(sources)} files failed{'' if atlas is None else f'; {atlas} is not written'}")
        sys.exit(1)


def _refuse_foreign(encoding: str, asked: dict[str, Any]) -> None:
    """Refuse options that belong to another encoding."""
    for name, owner in BELONGS_TO.items():
        if name in asked and owner != encoding:
            raise LimitError(
                f"--{name} {asked[name]} means nothing to the encoding {encoding}; "
                f"leave it out or use --encoding {owner}"
            )


def _convert_each(sources: tuple[Path, ...], output: Path, encoding: str, asked: dict[str, Any]) -> int:
    """Convert each file to files of its own, print a line for each, return how many failed."""
    from vexture.layout import PACKED_SUFFIX
    from vexture.pipeline import run

    is_file = encoding == DEFAULT and output.suffix.lower() == PACKED_SUFFIX and not output.is_dir()
    if is_file and len(sources) > 1:
        raise LimitError(f"--output {output}: one file for {len(sources)} drawings; use --atlas, or name a folder")
    folder = output.parent if is_file else output
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise DeviceError(f"{folder}: cannot be made ({error.strerror}); choose another folder with -o") from None
    written: dict[str, Path] = {}

    def convert_one(source: Path) -> str:
        conversion = run(source, encoding=encoding, **asked)
        name = conversion.texture.name
        if name in written:
            raise LimitError(
                f"{source}: {name} is already the name of what {written[name]} became; convert it to another folder"
            )
        saved = conversion.texture.save(output)
        files = saved if isinstance(saved, tuple) else (saved,)
        written[name] = source
        size = sum(file.stat().st_size for file in files)
        return _described(conversion.drawing, conversion.trees, size, conversion.seconds, conversion.rounding)

    return _work_through(sources, convert_one)


def _convert_together(sources: tuple[Path, ...], atlas: Path, settings: Settings) -> int:
    """Convert all files to one texture, written if none failed; print a line for each, return how many failed."""
    from vexture.layout import PACKED_SUFFIX
    from vexture.pipeline import Shapes, combine, shapes_of
    from vexture.texture.ktx2 import TEXEL_BYTES

    if atlas.suffix.lower() != PACKED_SUFFIX or atlas.is_dir():
        raise LimitError(f"--atlas {atlas}: a packed texture is a file whose name ends in {PACKED_SUFFIX}; name one")
    parts: list[Shapes] = []

    def convert_one(source: Path) -> str:
        part = shapes_of(source, settings)
        parts.append(part)
        texels = sum(len(tree.count) + len(tree.curves) for tree in part.trees)
        return _described(part.drawing, part.trees, TEXEL_BYTES * texels, part.seconds, part.rounding)

    failed = _work_through(sources, convert_one)
    if not failed:
        texture = combine(parts, atlas.stem)
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


def _described(drawing: "Drawing", trees: tuple[Any, ...], size: int, seconds: float, rounding: float) -> str:
    """One line about a source."""
    unresolved = sum(tree.unresolved for tree in trees)
    layers = f"{len(trees)} layers, " if len(trees) > 1 else ""
    line = (
        f"{drawing.name}: {drawing.segments} segments, {layers}{sum(len(tree.coverage) for tree in trees)} quads, "
        f"{sum(len(tree.curves) for tree in trees)} curves, {size} bytes, {1000 * seconds:.1f} ms, "
        f"distance {max(tree.deviation for tree in trees):.1e} + {rounding:.1e}"
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
