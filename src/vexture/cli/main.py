"""The command line: its commands, each in a module of its own."""

import signal
import sys
from importlib import import_module
from importlib.metadata import entry_points
from threading import Timer
from typing import Any, Final

import click

from vexture.cli.messages import say

__all__ = ["COMMANDS", "main"]

COMMANDS: Final = {
    name: f"vexture.cli.{name}"
    for name in ("convert", "render", "info", "view", "export", "serve", "push", "flood", "fold")
}
"""Module of each command; it is imported when the command is used or listed."""

PLUGINS: Final = "vexture.commands"
"""Entry points of other distributions that add commands."""

ELSEWHERE: Final = {"report": "the package vexture-evidence adds it: in a clone, pip install ./evidence"}
"""Commands of known distributions, and how to install these."""

INTERRUPTED: Final = 130
"""Exit code after Ctrl-C: 128 and the signal's number, as shells have it."""


class _Commands(click.Group):
    """The commands by name, and those that other distributions add."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return [*COMMANDS, *(point.name for point in entry_points(group=PLUGINS))]

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name in COMMANDS:
            command: click.Command = getattr(import_module(COMMANDS[cmd_name]), cmd_name)
            return command
        added = [point for point in entry_points(group=PLUGINS) if point.name == cmd_name]
        if not added and cmd_name in ELSEWHERE:
            ctx.fail(f"No such command {cmd_name!r}; {ELSEWHERE[cmd_name]}")
        return added[0].load() if added else None

    def invoke(self, ctx: click.Context) -> Any:
        """Run a command; Ctrl-C ends it in a line, also while modules are imported and kernels compiled."""
        again: list[Timer] = []

        def unraisable(error: "sys.UnraisableHookArgs") -> None:
            if error.exc_type is not KeyboardInterrupt:
                before(error)
                return  # else a callback of LLVM lost it, at which Numba may fail or go on
            again.append(Timer(0.1, signal.raise_signal, (signal.SIGINT,)))
            again[-1].start()

        before, sys.unraisablehook = sys.unraisablehook, unraisable
        try:
            try:
                return super().invoke(ctx)
            finally:
                sys.unraisablehook = before
                for timer in again:
                    timer.cancel()
        except (Exception, KeyboardInterrupt) as error:
            if not again and not isinstance(error, KeyboardInterrupt):
                raise
            say("interrupted")
            sys.exit(INTERRUPTED)


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(package_name="vexture")
def main() -> None:
    """Turn vector drawings into textures with random access on the GPU."""
