"""The command `info`."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from vexture.base.errors import FormatError
from vexture.cli.messages import echo, one_line
from vexture.cli.options import PATH, drawing_kind, read_stream, shown_name

MOST_NAMED = 8
"""Most elements of a shape that the text output names."""

EXAMPLE = """\b
Examples:
  vexture info logo.ktx2
  vexture info logo.ktx2 --json | jq .texels
  vexture info parcels.pmtiles
"""


@click.command(epilog=EXAMPLE)
@click.argument("texture", metavar="TEXTURE|TILES|-", type=PATH)
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def info(texture: Path, as_json: bool) -> None:
    """Describe a texture or a pyramid of tiles (a PMTiles file or a folder)."""
    with one_line():
        from vexture.base.content import start_of
        from vexture.conversion.extensions import find_geographic_reader
        from vexture.texture.load import load_any, texture_from

        reader, tiles = find_geographic_reader(), None
        if (data := read_stream(texture)) is not None:
            facts = texture_from(data, shown_name(texture)).info()
        elif reader is not None and (tiles := reader.describe_tiles(texture)) is not None:
            facts = tiles[0]
        else:
            if drawing_kind(texture) is not None:
                what = "it is not a texture" if start_of(texture) else "it is empty"
                raise FormatError(f"{texture}: {what}; give a texture, which vexture convert makes from a drawing")
            facts = load_any(texture).info()
        if as_json:
            click.echo(json.dumps(facts, indent=2))
            return
        for line in tiles[1] if tiles is not None else _lines(facts):
            echo(line)


def _lines(facts: dict[str, Any]) -> Iterator[str]:
    """Yield the facts as text: one per line, two lines for each shape, without facts that are missing."""
    for name, value in facts.items():
        if name == "bytes":
            yield f"{'memory':<12}{value} bytes on the GPU"
        elif name != "roots":
            yield from (f"{name:<12}{_text(name, value)}" for _ in range(value is not None))
    for root in facts.get("roots", ()):
        known = [f"{name} {_text(name, value)}" for name, value in root.items() if value is not None]
        place = [*root].index("transform")
        yield f"{'shape':<12}{', '.join(known[:place])}"
        yield f"{'':<12}{', '.join(known[place:])}"


def _text(name: str, value: Any) -> str:
    """Format a value: numbers with at most six digits, colours as in CSS, transforms as two sums."""
    if name == "paint":
        from vexture.drawing.paint import Paint

        return f"{Paint(tuple(value['color'])).hex} at opacity {value['opacity']:.6g}"
    if name == "transform":
        parts = (zip(row, ("u", "v", ""), strict=True) for row in value)
        sums = (" ".join(f"{'-+'[k > 0]} {abs(k):.6g}{of}" for k, of in part if k) for part in parts)
        return "x = {}, y = {}".format(*(text.removeprefix("+ ") or "0" for text in sums))
    if name == "elements":
        more = f" and {len(value) - MOST_NAMED} more" if len(value) > MOST_NAMED else ""
        return f"{len(value)} ({', '.join(value[:MOST_NAMED])}{more})"
    if isinstance(value, dict):
        return ", ".join(f"{kind} {count}" for kind, count in value.items())
    return f"{value:.6g}" if isinstance(value, float) else str(value)
