"""Results of the commands that convert: files and messages for each source."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vexture.base.errors import VextureError, format_count
from vexture.base.layout import PACKED_SUFFIX
from vexture.cli.messages import as_options, echo, note_facts, print_message
from vexture.cli.options import STANDARD, write_output
from vexture.texture.registry import DEFAULT

if TYPE_CHECKING:
    from vexture.conversion.pipeline import Conversion

QUIET, NORMAL, VERBOSE = -1, 0, 1


@dataclass(frozen=True, slots=True)
class ConversionResult:
    """Result of one source: the contents of its files, its trees if it goes into an atlas, or an error."""

    source: Path | str
    facts: dict[str, Any]
    files: dict[str, bytes] | None = None
    trees: "Conversion[Any] | None" = None
    warning: str = ""
    error: str = ""


def shape_facts(done: "Conversion[Any]") -> dict[str, Any]:
    """Return the facts of a conversion as JSON values."""
    shapes = [
        {"quads": len(tree.coverage), "curves": len(tree.curves), "unresolved": int(tree.unresolved)}
        for tree in done.trees
    ]
    return {
        "name": done.drawing.name,
        "segments": done.drawing.segments,
        "layers": len(shapes),
        "quads": sum(shape["quads"] for shape in shapes),
        "curves": sum(shape["curves"] for shape in shapes),
        "milliseconds": round(1000.0 * done.seconds, 1),
        "deviation": max(float(tree.deviation) for tree in done.trees),
        "rounding": done.rounding,
        "unresolved": sum(shape["unresolved"] for shape in shapes),
        "shapes": shapes,
        "notes": note_facts(done.notes),
    }


def is_texture_file(output: Path, encoding: str) -> bool:
    """Return whether an output path is a file, not a folder."""
    return encoding == DEFAULT and output.suffix.lower() == PACKED_SUFFIX and not output.is_dir()


def written(outcome: ConversionResult, output: Path, owners: dict[str, Path | str]) -> ConversionResult:
    """Write the files of a result; return the result with the files' names, or with an error."""
    from vexture.texture.files import file_name, write_together

    assert outcome.files is not None
    if output == Path(STANDARD):
        write_output(next(iter(outcome.files.values())))
        return outcome
    if is_texture_file(output, DEFAULT if len(outcome.files) == 1 else ""):
        places = {output: next(iter(outcome.files.values()))}
    else:
        stem = file_name(outcome.facts["name"])
        places = {output / (stem + suffix): data for suffix, data in outcome.files.items()}
    first = str(next(iter(places)))
    if first in owners:
        error = f"{outcome.source}: {first} is already what {owners[first]} became; convert it to another folder"
        return replace(outcome, error=error)
    try:
        write_together(places)
    except VextureError as error:
        return replace(outcome, error=str(error))
    owners[first] = outcome.source
    return replace(outcome, facts=outcome.facts | {"files": [str(place) for place in places]})


def say_outcome(outcome: ConversionResult, level: int, *, quiet: bool, to_pipe: bool) -> None:
    """Print the result of one source."""
    if outcome.error:
        print_message(outcome.error)
        return
    if level > QUIET and outcome.warning:
        print_message(f"warning: {outcome.warning}")
    if level > QUIET and not quiet:
        echo(line_of_facts(outcome.facts), err=to_pipe)
    if level == VERBOSE and not quiet:
        for place, shape in enumerate(outcome.facts["shapes"]):
            parts = ", ".join(format_count(shape[name], name[:-1]) for name in ("quads", "curves"))
            echo(f"  shape {place}: {parts}", err=to_pipe)
        for file in outcome.facts.get("files", ()):
            echo(f"  {file}", err=to_pipe)


def line_of_facts(facts: dict[str, Any]) -> str:
    """Return the facts of a source as one line of text."""
    named = [name for name in ("segments", "layers", "quads", "curves", "bytes") if name != "layers" or facts[name] > 1]
    counts = ", ".join(format_count(facts[name], name.removesuffix("s")) for name in named)
    line = (
        f"{facts['name']}: {counts}, {facts['milliseconds']:.1f} ms, "
        f"distance {facts['deviation']:.1e} + {facts['rounding']:.1e}"
    )
    return line + (f", {format_count(facts['unresolved'], 'cell')} at the depth limit" if facts["unresolved"] else "")


def facts_of(outcome: ConversionResult) -> dict[str, Any]:
    """Return the facts of a source as JSON values, including its error or warning."""
    facts: dict[str, Any] = {"source": str(outcome.source)}
    if outcome.error:
        return facts | {"error": as_options(outcome.error)}
    return facts | outcome.facts | ({"warning": as_options(outcome.warning)} if outcome.warning else {})
