"""The command line: arguments and messages only."""

import json
import os
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from vexture.errors import DeviceError, LimitError, VextureError

if TYPE_CHECKING:
    from vexture.drawing import Drawing
    from vexture.encoding import ThesisTexture
    from vexture.pipeline import Conversion

__all__ = ["main"]

DEFAULT_SIZE = 512


class _Tolerance(click.ParamType[Any]):
    """A number, or auto."""

    name = "T"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value == "auto" or isinstance(value, float):
            return value
        try:
            return float(value)
        except ValueError:
            self.fail(f"{value!r} is neither a number nor auto", param, ctx)


class _View(click.ParamType[Any]):
    """Four numbers, separated by commas."""

    name = "X,Y,W,H"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        try:
            x, y, w, h = (float(part) for part in str(value).split(","))
        except ValueError:
            self.fail(f"{value!r} is not four numbers X,Y,W,H", param, ctx)
        return x, y, w, h


def _say(message: str) -> None:
    click.echo(f"vexture: {message}", err=True)


@contextmanager
def _one_line() -> Iterator[None]:
    """Errors that are the user's to mend, and warnings, become one line each."""
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_args, **_kwargs: _say(f"warning: {message}")
        warnings.simplefilter("always")
        try:
            yield
        except VextureError as error:
            _say(str(error))
            sys.exit(1)
        except MemoryError:
            _say("out of memory; use a smaller drawing or a smaller --size")
            sys.exit(1)


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(package_name="vexture")
def main() -> None:
    """Turn vector drawings into textures that a GPU reads at random."""


@main.command()
@click.argument("sources", metavar="SOURCE...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("-o", "--output", metavar="DIR", default=".", type=click.Path(path_type=Path), help="Folder to write to.")
@click.option("--encoding", type=click.Choice(["thesis"]), default="thesis", show_default=True)
@click.option("--bits", type=click.Choice(["8", "16"]), default="16", show_default=True, help="Bits per channel.")
@click.option(
    "--strategy",
    type=click.Choice(["direct", "sampled"]),
    default="direct",
    show_default=True,
    help="Take leaves from the drawing's own cubics, or sample and fit as the thesis does.",
)
@click.option(
    "--tolerance",
    type=_Tolerance(),
    default="auto",
    show_default=True,
    help="Largest distance from the drawing's outline, in drawing sizes.",
)
@click.option("--max-depth", metavar="D", type=int, default=None, help="Divide no further than this.  [default: 10]")
def convert(sources: tuple[Path, ...], output: Path, bits: str, **parameters: Any) -> None:
    """Convert SVG drawings into pairs of texture files."""
    with _one_line():
        try:
            output.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise DeviceError(f"{output}: cannot be made ({error.strerror}); choose another folder with -o") from None
        written: dict[Path, Path] = {}
        failed = 0

        def convert_one(source: Path) -> str | None:
            nonlocal failed
            try:
                return _convert_one(source, output, written, bits=int(bits), **parameters)
            except VextureError as error:
                failed += 1
                _say(str(error))
                return None

        for line in _with_progress(sources, convert_one):
            if line:
                click.echo(line)
    if failed:
        if len(sources) > 1:
            _say(f"{failed} of {len(sources)} files failed")
        sys.exit(1)


def _convert_one(source: Path, output: Path, written: dict[Path, Path], **parameters: Any) -> str:
    """Convert one file and describe the result."""
    from vexture.encoding import target_of
    from vexture.pipeline import run

    conversion = run(source, **parameters)
    first = target_of(output, conversion.texture.name)[0]
    if first in written:
        raise LimitError(f"{source}: {first} is already what {written[first]} became; convert it to another folder")
    files = conversion.texture.save(output)
    written[first] = source
    return _describe(conversion, sum(file.stat().st_size for file in files))


def _describe(conversion: "Conversion", size: int) -> str:
    """One line about a shape."""
    from vexture.encoding import quantisation_step

    tree, texture = conversion.tree, conversion.texture
    line = (
        f"{texture.name}: {conversion.drawing.segments} segments, {len(tree.kind)} quads, {len(tree.curves)} curves, "
        f"{size} bytes, {1000 * conversion.seconds:.1f} ms, distance {tree.deviation:.1e} "
        f"+ {tree.widest_leaf * quantisation_step(texture.bits):.1e}"
    )
    return line + (f", {tree.unresolved} cells at the depth limit" if tree.unresolved else "")


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
@click.option("--renderer", type=click.Choice(["exact", "cpu", "gpu"]), default="gpu", show_default=True)
@click.option("--view", type=_View(), default="0,0,1,1", show_default=True, help="Part of the unit square, y up.")
@click.option("--rotate", metavar="DEG", type=float, default=0.0, help="Turn the picture counter-clockwise.")
def render(
    source: Path, output: Path, size: int, renderer: str, view: tuple[float, float, float, float], rotate: float
) -> None:
    """Render a drawing or a texture as a PNG: the shape black on white."""
    with _one_line():
        from vexture.pipeline import render as render_image
        from vexture.render.view import window

        shape = _shape_of(source)
        _, _, w, h = view
        longer = max(w, h)
        ratio = (w / longer, h / longer) if longer > 0.0 else (1.0, 1.0)
        pixels = tuple(max(round(size * side), min(size, 1)) for side in ratio)
        to_unit = window((pixels[0], pixels[1]), *view, rotate)
        image = render_image(shape, (pixels[0], pixels[1]), to_unit, renderer)
        _write_png(image, output)


def _shape_of(path: Path) -> "Drawing | ThesisTexture":
    """Read a drawing, or load a texture by either of its files or their common stem."""
    if path.is_file() and path.suffix.lower() != ".png":
        from vexture.sources.svg import read_svg

        return read_svg(path)
    from vexture.encoding import load

    return load(path)


def _write_png(image: Any, output: Path) -> None:
    """Write coverage as black on white, by a temporary name."""
    import numpy as np
    from PIL import Image

    if not output.name:
        raise DeviceError(f"{str(output)!r} is no file to write to; name one with -o")
    partial = output.with_name(f".{output.name}.{os.getpid()}.part")
    try:
        Image.fromarray(np.rint(255.0 * (1.0 - image)).astype(np.uint8)).save(partial, format="PNG")
        partial.replace(output)
    except OSError as error:
        with suppress(OSError):
            partial.unlink()
        raise DeviceError(f"{output}: cannot be written ({error.strerror}); choose another file with -o") from None


@main.command()
@click.argument("texture", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def info(texture: Path, as_json: bool) -> None:
    """Describe a texture."""
    with _one_line():
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
