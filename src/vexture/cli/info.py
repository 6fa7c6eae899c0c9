"""The command `info`."""

import json
from pathlib import Path

import click

from vexture.cli.messages import one_line
from vexture.cli.options import PATH, STANDARD, drawing_kind, standard_input
from vexture.errors import FormatError

__all__ = ["info"]

EXAMPLE = """\b
Examples:
  vexture info logo.ktx2
  vexture info logo.ktx2 --json | jq .texels
"""


@click.command(epilog=EXAMPLE)
@click.argument("texture", metavar="TEXTURE|-", type=PATH)
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def info(texture: Path, as_json: bool) -> None:
    """Describe a texture."""
    with one_line():
        from vexture.content import start_of
        from vexture.texture.load import load_any, texture_from

        if texture == Path(STANDARD):
            facts = texture_from(standard_input(), "standard input").info()
        else:
            if drawing_kind(texture) is not None:
                what = "it is not a texture" if start_of(texture) else "it is empty"
                raise FormatError(f"{texture}: {what}; give a texture, which vexture convert makes from a drawing")
            facts = load_any(texture).info()
        if as_json:
            click.echo(json.dumps(facts, indent=2))
            return
        for key, value in facts.items():
            for line in value if isinstance(value, list) and key == "roots" else [value]:
                text = ", ".join(f"{name} {count}" for name, count in line.items()) if isinstance(line, dict) else line
                click.echo(f"{key:<12}{text}")
