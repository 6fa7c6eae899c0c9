"""The command `convert`."""

import json
import logging
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from copy import copy
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from vexture.base.deadline import DEFAULT_SECONDS
from vexture.base.errors import EXPECTED, ParameterError, SourceError, VextureError, format_count
from vexture.base.layout import PACKED_SUFFIX
from vexture.cli.messages import echo, one_line, print_message
from vexture.cli.options import (
    PATH,
    SILHOUETTE_HELP,
    STANDARD,
    Sectioned,
    as_given,
    check_output,
    font_option,
    images_options,
    page_color_option,
    read_stream,
    shown_name,
    split_of,
    strict_option,
    tolerance_option,
    write_output,
)
from vexture.cli.result import (
    NORMAL,
    QUIET,
    VERBOSE,
    ConversionResult,
    facts_of,
    is_texture_file,
    say_outcome,
    shape_facts,
    written,
)
from vexture.texture.registry import DEFAULT, REGISTERED

if TYPE_CHECKING:
    from vexture.conversion.pipeline import Conversion
    from vexture.drawing.drawing import Drawing

BELONGS_TO: Final = {
    "split": DEFAULT,
    "restyle": DEFAULT,
    "names": DEFAULT,
    "snap": DEFAULT,
    "fonts": DEFAULT,
    "images": DEFAULT,
    "page_colors": DEFAULT,
    "capacity": DEFAULT,
    "precision": DEFAULT,
    "deflate": DEFAULT,
    "bits": "thesis",
    "strategy": "thesis",
}
"""Encoding that each option belongs to."""

FILE_SUFFIXES: Final = (PACKED_SUFFIX, ".svg", ".png", ".jpg", ".jpeg", ".webp", ".gif", ".bmp")
"""Suffixes of files; a folder with such a name would be a mistake."""

EXAMPLE = """\b
Examples:
  vexture convert logo.svg                              logo.ktx2, in its colours
  vexture convert logo.svg --silhouette                 its covered area, without colours
  vexture convert icons/*.svg --atlas icons.ktx2 -j 4   one texture of all icons
  cat logo.svg | vexture convert - -o - > logo.ktx2     from and to a pipe
"""


@click.command(cls=Sectioned, epilog=EXAMPLE)
@click.argument("sources", metavar="SOURCE...", nargs=-1, required=True, type=PATH)
@click.option(
    "-o",
    "--output",
    metavar="DIR|FILE.ktx2|-",
    type=PATH,
    help="Folder to write to, or the file for one drawing; - is standard output.  [default: .]",
)
@click.option(
    "--atlas",
    metavar="FILE.ktx2|-",
    type=PATH,
    help="Write one texture of all files, a shape for each, or of a sprite for each symbol.",
)
@click.option(
    "--split",
    type=click.Choice(["auto", "faces", "paint"]),
    help="faces: make the drawing, in its colours, one planar map, without seams between colours. paint: make each "
    "colour a shape of its own, in painting order. auto: faces, or of a drawing of one colour the silhouette.  "
    "[default: auto]",
)
@click.option("--silhouette", is_flag=True, default=None, help=f"Convert {SILHOUETTE_HELP}")
@click.option("--restyle", is_flag=True, default=None, help="A planar map whose elements can get other colours later.")
@click.option("--select", metavar="SELECTOR", help="Convert only the elements that a CSS selector matches.")
@click.option(
    "--names",
    metavar="NAME",
    help="Name elements by a property of GeoJSON, or by an attribute of SVG or title, rather than by id.",
)
@click.option(
    "--snap",
    metavar="D",
    type=float,
    help="Make borders of a map's polygons one where they differ by no more than D, in parts of the drawing's longer "
    "side; 0 leaves them.  [default: 3e-6]",
)
@font_option
@page_color_option
@images_options
@tolerance_option
@click.option("--max-depth", metavar="D", type=int, help="Divide cells no further than this depth.  [default: 16]")
@click.option("--capacity", metavar="N", type=int, help="Pieces in a leaf, 1 to 15.  [default: 8, in colours 12]")
@click.option("--precision", metavar="P", type=float, help="Largest shift by rounding, in unit-square units.")
@click.option(
    "--no-deflate",
    "deflate",
    flag_value=False,
    default=None,
    help="Do not compress the file, for a server that compresses its answers.",
)
@click.option(
    "--max-seconds", metavar="S", type=float, help=f"Most seconds for one source.  [default: {DEFAULT_SECONDS:g}]"
)
@click.option(
    "-j", "--jobs", metavar="N", type=click.IntRange(1), default=1, show_default=True, help="Processes to use."
)
@strict_option
@click.option("--json", "as_json", is_flag=True, help="Print a JSON list with the facts of each source.")
@click.option("-q", "--quiet", is_flag=True, help="Print errors only.")
@click.option("-v", "--verbose", is_flag=True, help="Print each shape, too.")
@click.option(
    "--encoding", type=click.Choice([DEFAULT, *REGISTERED]), default=DEFAULT, show_default=True, help="Encoding to use."
)
@click.option("--bits", type=click.Choice(["8", "16"]), help="thesis: bits per channel.  [default: 16]")
@click.option(
    "--strategy",
    type=click.Choice(["direct", "sampled"]),
    help="thesis: leaves from the drawing's own cubics, or sampled and fitted.  [default: direct]",
)
def convert(
    sources: tuple[Path, ...],
    output: Path | None,
    atlas: Path | None,
    encoding: str,
    jobs: int,
    strict: bool,
    as_json: bool,
    quiet: bool,
    verbose: bool,
    **options: Any,
) -> None:
    """Convert drawings into textures.

    A source is an SVG, GeoJSON, a picture (PNG, JPEG, WebP, GIF, BMP), geographic data (polygons in any
    format that vexture map reads; depths in GeoTIFF, Esri grid, NetCDF or GRIB, at the first time step), a folder for
    the SVGs in it, or - for standard input.
    """
    with one_line():
        parameters = _encoding_parameters(encoding, options)
        sources = drawings_in(sources)
        to_pipe = Path(STANDARD) in (output, atlas)
        level = QUIET if quiet else VERBOSE if verbose else NORMAL
        check_places(sources, output, atlas, encoding, to_pipe)
        stored = {name: parameters.pop(name) for name in ("deflate",) if name in parameters}
        work = partial(_convert_one, encoding=encoding, parameters=parameters, stored=stored)
        work = partial(work, for_atlas=atlas is not None, strict=strict, quiet=quiet)
        outcomes: list[ConversionResult] = []
        owners: dict[str, Path | str] = {}
        for found in _outcomes(work, sources, jobs, level, parameters.get("max_seconds", DEFAULT_SECONDS)):
            outcome = found if atlas or found.error else written(found, output or Path(), owners)
            say_outcome(outcome, level, quiet=as_json, to_pipe=to_pipe)
            outcomes.append(outcome)
        failed = sum(bool(outcome.error) for outcome in outcomes)
        if atlas is not None and not failed:
            _write_atlas(outcomes, atlas, stored, silent=as_json or level == QUIET, to_pipe=to_pipe)
        if as_json:
            click.echo(json.dumps([facts_of(outcome) for outcome in outcomes], indent=2), err=to_pipe)
    if failed:
        if len(sources) > 1:
            print_message(
                f"{failed} of {len(sources)} files failed{'' if atlas is None else f'; {atlas} is not written'}"
            )
        sys.exit(1)


def _encoding_parameters(encoding: str, options: dict[str, Any]) -> dict[str, Any]:
    """Return the parameters of the conversion that are set; raise a `ParameterError` for those of another encoding."""
    parameters = given_options(options)
    for name, owner in BELONGS_TO.items():
        if name in parameters and owner != encoding:
            value = parameters[name]
            option = f"`no_{name}`" if value is False else f"`{name}`{as_given(name, value)}"
            raise ParameterError(
                f"{option} means nothing to the encoding {encoding}; leave it out or use `encoding` {owner}"
            )
    if encoding != DEFAULT:
        parameters.pop("split", None)  # other encodings convert only silhouettes
    if "bits" in parameters:
        parameters["bits"] = int(parameters["bits"])
    return parameters


def given_options(options: dict[str, Any]) -> dict[str, Any]:
    """Return the parameters that are set by options."""
    parameters = {name: value for name, value in options.items() if value is not None}
    return parameters | split_of(parameters.get("split"), parameters.pop("silhouette", None))


def options_of_convert(*names: str) -> Callable[[click.Command], click.Command]:
    """Append some of the options of `convert` to a command, without flags that the command has already."""

    def with_options(command: click.Command) -> click.Command:
        taken = {flag for option in command.params for flag in option.opts}
        for name in names:
            for known in convert.params:  # several flags may set one parameter
                if known.name == name:
                    option = copy(known)
                    option.opts = [flag for flag in option.opts if flag not in taken]
                    command.params.append(option)
        return command

    return with_options


def drawings_in(sources: tuple[Path, ...]) -> tuple[Path, ...]:
    """Replace each folder by its SVG files, sorted by name; keep a folder without any, whose conversion fails."""
    files = list[Path]()
    for source in sources:
        if not source.is_dir():
            files.append(source)
            continue
        files += sorted(file for file in source.iterdir() if _is_drawing(file)) or [source]
    return tuple(files)


def _is_drawing(file: Path) -> bool:
    """Return whether a file in a folder has an SVG suffix and is not hidden."""
    return file.suffix.lower() in (".svg", ".svgz") and not file.name.startswith(".") and file.is_file()


def check_places(
    sources: tuple[Path, ...], output: Path | None, atlas: Path | None, encoding: str, to_pipe: bool
) -> None:
    """Refuse outputs that cannot be written, before anything is converted."""
    from vexture.texture.files import writable

    check_output(Path(STANDARD) if to_pipe else output)
    if sources.count(Path(STANDARD)) > 1:
        raise ParameterError(f"{STANDARD}: standard input can be read once; give {STANDARD} once")
    if atlas is not None:
        if output is not None:
            raise ParameterError(f"`output` {output} and `atlas` {atlas}: an atlas is one file; leave `output` out")
        if encoding != DEFAULT:
            raise ParameterError(
                f"`atlas` {atlas}: the encoding {encoding} holds one shape; use the encoding {DEFAULT}"
            )
        if not to_pipe and (atlas.suffix.lower() != PACKED_SUFFIX or atlas.is_dir()):
            raise ParameterError(f"`atlas` {atlas}: a texture is a file whose name ends in {PACKED_SUFFIX}; name one")
        return
    if to_pipe and encoding != DEFAULT:
        raise ParameterError(f"`output` -: the encoding {encoding} writes several files; name a folder")
    if to_pipe and len(sources) > 1:
        raise ParameterError("`output` -: standard output takes one texture; use `atlas` - or name a folder")
    place = output or Path()
    is_file = to_pipe or is_texture_file(place, encoding)
    if is_file and len(sources) > 1:
        raise ParameterError(f"`output` {output}: one file for {len(sources)} drawings; use `atlas`, or name a folder")
    if not is_file and place.suffix.lower() in FILE_SUFFIXES and not place.is_dir():
        remedy = f"FILE{PACKED_SUFFIX} or a folder" if encoding == DEFAULT else "a folder, for several files"
        raise ParameterError(f"`output` {output}: the encoding {encoding} writes no such file; name {remedy}")
    writable(place.parent if is_file else place)


def _convert_one(
    source: Path,
    content: bytes | None,
    encoding: str,
    parameters: dict[str, Any],
    stored: dict[str, Any],
    for_atlas: bool,
    strict: bool,
    quiet: bool,
) -> list[ConversionResult]:
    """Convert one source, in this process or another; return an error as a result.

    In an atlas, a sprite has one result for each symbol. `stored` are the parameters of the texture's `files`.
    """
    from vexture.base.notes import check_losses, line_of
    from vexture.conversion.parameters import READING, Parameters
    from vexture.conversion.pipeline import parts_of, run, run_encoding
    from vexture.conversion.reading import read_drawing

    if quiet:  # kernels log that they are being compiled
        logging.getLogger("vexture").setLevel(logging.ERROR)
    try:
        if source.is_dir():
            raise SourceError(f"{source}: the folder holds no SVG file; name a folder that does, or files")
        if for_atlas:
            whole = source if content is None else content
            parts = [*parts_of(whole, Parameters(**parameters), shown_name(source))]
            for part in parts:
                check_losses(part.source, part.notes, is_empty=not part.drawing.paths, strict=strict)
            return [_for_atlas(source, part) for part in parts]
        given: Drawing | Path = source
        if content is not None:
            parameters = dict(parameters)
            reading: dict[str, Any] = {name: parameters.pop(name) for name in READING if name in parameters}
            outlines = encoding != DEFAULT or parameters.get("split", "") is None
            given = read_drawing(content, name=shown_name(source), for_outlines=outlines, **reading)
        if encoding == DEFAULT:
            done: Conversion[Any] = run(given, Parameters.from_mapping(parameters))
        else:
            done = run_encoding(given, encoding, **parameters)
        files = done.texture.files(**stored)
        check_losses(str(source), done.notes, is_empty=not done.drawing.paths, strict=strict)
    except EXPECTED as error:
        return [ConversionResult(source, {}, error=str(error))]
    facts = shape_facts(done) | {"bytes": sum(map(len, files.values()))}
    return [ConversionResult(source, facts, files, warning=line_of(str(source), done.notes))]


def _for_atlas(source: Path, part: "Conversion[Any]") -> ConversionResult:
    """Return the result of a drawing whose trees become part of an atlas."""
    from vexture.base.notes import line_of
    from vexture.texture.ktx2 import TEXEL_BYTES

    size = TEXEL_BYTES * sum(tree.texels for tree in part.trees)
    return ConversionResult(source, shape_facts(part) | {"bytes": size}, None, part, line_of(part.source, part.notes))


def _outcomes(
    work: Any, sources: tuple[Path, ...], jobs: int, level: int, max_seconds: float
) -> Iterator[ConversionResult]:
    """Yield results from worker processes in the order of the sources; with several, a terminal shows progress."""
    from vexture.base.apart import each_apart

    tasks = [(source, read_stream(source)) for source in sources]
    results: Iterable[Any] = each_apart(work, tasks, [shown_name(source) for source in sources], max_seconds, jobs)
    with ExitStack() as opened:
        if len(tasks) > 1 and level > QUIET and sys.stderr.isatty():
            from rich.console import Console
            from rich.progress import Progress

            progress = opened.enter_context(Progress(console=Console(stderr=True), transient=True))
            results = progress.track(results, total=len(tasks), description="converting")
        for source, result in zip(sources, results, strict=True):
            if isinstance(result, VextureError):
                yield ConversionResult(source, {}, error=str(result))
            else:
                yield from result


def _write_atlas(
    outcomes: list[ConversionResult], atlas: Path, stored: dict[str, Any], *, silent: bool, to_pipe: bool
) -> None:
    """Write one texture with all shapes."""
    from vexture.conversion.pipeline import combine

    parts = [outcome.trees for outcome in outcomes if outcome.trees is not None]
    texture = combine(parts, "atlas" if to_pipe else atlas.stem)
    data = texture.to_ktx2(**stored)
    if to_pipe:
        write_output(data)
    else:
        texture.save(atlas, **stored)
    if not silent:
        echo(f"{atlas}: {format_count(len(texture.roots), 'shape')}, {len(data)} bytes", err=to_pipe)
