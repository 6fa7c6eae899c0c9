"""The command line; each command has a module of its own."""

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from threading import Timer, current_thread, main_thread
from types import FrameType
from typing import TYPE_CHECKING, Any, Final

import click

from vexture.base.errors import printable
from vexture.cli.interrupt import INTERRUPTED, at_once
from vexture.cli.messages import print_message

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

SUMMARIES: Final = {
    "convert": "Convert drawings into textures.",
    "text": "Convert a word or lines of text into a texture.",
    "font": "Convert the characters of a font into one texture, with a shape for each and metrics as JSON.",
    "render": "Render a drawing, a picture or a texture to a PNG, in its colours.",
    "info": "Describe a texture or a pyramid of tiles (a PMTiles file or a folder).",
    "restyle": "Change the colours of elements in a planar map.",
    "view": "Show drawings or packed textures in the browser until you press Ctrl-C.",
    "export": "Write a self-contained web page that shows drawings.",
    "serve": "Serve a folder of shapes, and accept new ones from clients with a token.",
    "push": "Publish a drawing, geographic data or a packed texture on a server.",
    "fold": "Make the outline of a drawing move to and fro, like water on a beach.",
    "gltf": "Put drawings on the materials of a model (glTF 2.0, .glb or .gltf).",
}
"""Commands in the order of the help, each with its first sentence, so that the help need not import them."""

COMMANDS: Final = {name: f"vexture.cli.{name}" for name in SUMMARIES}
"""Module of each command, which is imported only when the command runs."""

PLUGINS: Final = "vexture.commands"
"""Group of entry points by which other distributions add commands."""

ELSEWHERE: Final = {
    "flood": "the package vexture-geo adds it: pip install 'vexture[geo]'",
    "map": "the package vexture-geo adds it: pip install 'vexture[map]'",
    "tiles": "the package vexture-geo adds it: pip install 'vexture[map]'",
    "report": "the package vexture-evidence adds it: in a clone, pip install ./packages/vexture "
    "./packages/vexture-geo ./packages/vexture-evidence",
}
"""Commands of known distributions, with instructions to install them."""

ADDED_SUMMARIES: Final = {
    "flood": "Show a flood as animated water, on one page or on a server.",
    "map": "Convert geographic data into one texture and a table of attributes.",
    "tiles": "Make a pyramid of tiles from polygons: one PMTiles file, or a folder with a TileJSON.",
}
"""First sentences of the commands of vexture-geo, so that the help need not import these either."""


class _Commands(click.Group):
    """The commands, with those that other distributions add."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return [*COMMANDS, *_plugin_commands(ctx)]

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name in COMMANDS:
            command: click.Command = getattr(import_module(COMMANDS[cmd_name]), cmd_name)
            return command
        added = _plugin_commands(ctx).get(cmd_name)
        if added is None and cmd_name in ELSEWHERE:
            ctx.fail(f"No such command {cmd_name!r}; {ELSEWHERE[cmd_name]}")
        return None if added is None else added.load()

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands without importing their modules, which would take longer than the rest of the help."""
        listed = {name: click.Command(name, help=line) for name, line in SUMMARIES.items()}
        for name, point in _plugin_commands(ctx).items():
            line = ADDED_SUMMARIES.get(name)
            listed[name] = point.load() if line is None else click.Command(name, help=line)
        _Listed(commands=listed).format_commands(ctx, formatter)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        with _printable_errors():
            return super().parse_args(ctx, args)

    def invoke(self, ctx: click.Context) -> Any:
        """Run a command; Ctrl-C ends it with one line, even while modules are imported or kernels are compiled."""
        before = signal.getsignal(signal.SIGINT)
        ours = current_thread() is main_thread() and before in (signal.default_int_handler, at_once)
        if ours:
            signal.signal(signal.SIGINT, _on_ctrl_c)
        try:
            with _printable_errors():
                return super().invoke(ctx)
        except KeyboardInterrupt:
            print_message("interrupted")
            sys.exit(INTERRUPTED)
        finally:
            if ours:
                signal.signal(signal.SIGINT, before)


class _Listed(click.Group):
    """A group that lists its commands in the order in which they were added."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return [*self.commands]


def _plugin_commands(ctx: click.Context) -> "dict[str, EntryPoint]":
    """Return the commands of other distributions by name; the installed ones are searched only once."""
    if PLUGINS not in ctx.meta:
        from importlib.metadata import entry_points

        ctx.meta[PLUGINS] = {point.name: point for point in entry_points(group=PLUGINS)}
    found: dict[str, EntryPoint] = ctx.meta[PLUGINS]
    return found


@contextmanager
def _printable_errors() -> Iterator[None]:
    """Make errors printable, so that an argument such as a file name cannot control the terminal through them."""
    try:
        yield
    except click.ClickException as error:
        error.message = printable(error.message)  # type: ignore[misc]  # mypy reads a class attribute as final
        raise


def _on_ctrl_c(number: int, frame: FrameType | None) -> None:
    """Raise a `KeyboardInterrupt`, later if LLVM or Numba run: within their calls it would get lost or crash them."""
    places = set()
    while frame is not None:
        places |= {frame.f_globals.get("__name__", "").partition(".")[0], frame.f_code.co_name}
        frame = frame.f_back
    if "llvmlite" in places or ("numba" in places and "_compile_for_args" not in places):
        again = Timer(0.05, signal.raise_signal, (number,))
        again.daemon = True
        again.start()
        return
    raise KeyboardInterrupt


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(package_name="vexture")
def main() -> None:
    """Turn vector drawings into textures with random access on the GPU."""
