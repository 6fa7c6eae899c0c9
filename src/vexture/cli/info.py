"""The command `info`."""

import json
from pathlib import Path

import click

from vexture.cli.messages import one_line

__all__ = ["info"]


@click.command()
@click.argument("texture", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def info(texture: Path, as_json: bool) -> None:
    """Describe a texture."""
    with one_line():
        from vexture.texture.load import load_any

        facts = load_any(texture).info()
        if as_json:
            click.echo(json.dumps(facts, indent=2))
            return
        for key, value in facts.items():
            for line in value if isinstance(value, list) and key == "roots" else [value]:
                text = ", ".join(f"{name} {count}" for name, count in line.items()) if isinstance(line, dict) else line
                click.echo(f"{key:<12}{text}")
