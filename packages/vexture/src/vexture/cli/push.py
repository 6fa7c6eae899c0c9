"""The command `push`."""

from pathlib import Path

import click

from vexture.cli.messages import echo, one_line
from vexture.cli.options import PATH

EXAMPLE = """\b
Examples:
  vexture push duck.svg http://127.0.0.1:8000 --token-file token
  vexture push duck.svg http://127.0.0.1:8000/shapes/logo --token-file token
"""


@click.command(epilog=EXAMPLE)
@click.argument("file", metavar="FILE", type=PATH)
@click.argument("url", metavar="URL")
@click.option("--token-file", metavar="F", type=PATH, required=True, help="File with the token of the server.")
def push(file: Path, url: str, token_file: Path) -> None:
    """Publish a drawing, geographic data or a packed texture on a server.

    URL is the address of the server, or SERVER/shapes/NAME. Without a NAME, the shape is named after the file.
    """
    with one_line():
        from vexture.server.push import push as send
        from vexture.server.tokens import read_token

        manifest = send(file, url, read_token(token_file))
        echo(f"{manifest['name']}: {manifest['url']}, {manifest['bytes']} bytes, version {manifest['version']}")
