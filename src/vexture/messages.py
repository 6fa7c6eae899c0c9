"""What the command line says to people: one line for each thing."""

import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import click

from vexture.errors import DeviceError, VextureError
from vexture.notes import Note, line_of

__all__ = ["one_line", "say", "say_notes", "with_servers"]

SERVERS = ("sse_starlette", "starlette", "uvicorn", "watchfiles")


def say(message: str) -> None:
    """Print a line where errors go."""
    click.echo(f"vexture: {message}", err=True)


def say_notes(source: object, notes: Sequence[Note]) -> None:
    """Print in a line what was noticed about a source, if anything was."""
    if line := line_of(str(source), notes):
        say(f"warning: {line}")


@contextmanager
def one_line() -> Iterator[None]:
    """Errors that are the user's to mend, and warnings of libraries, become one line each."""
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_args, **_kwargs: say(f"warning: {message}")
        warnings.simplefilter("always")
        try:
            yield
        except VextureError as error:
            say(str(error))
            sys.exit(1)
        except OSError as error:
            say(f"{error.filename or 'the output'}: {error.strerror}; choose another file")
            sys.exit(1)
        except MemoryError:
            say("out of memory; use a smaller drawing or a smaller --size")
            sys.exit(1)


@contextmanager
def with_servers(command: str) -> Iterator[None]:
    """Say what to install where the packages of servers are missing."""
    try:
        yield
    except ModuleNotFoundError as error:
        if (error.name or "").split(".")[0] not in SERVERS:
            raise
        raise DeviceError(f"vexture {command} needs the package {error.name}: pip install 'vexture[live]'") from None
