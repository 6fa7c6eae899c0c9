"""What the command line says to people: one line for each thing."""

import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import click

from vexture.errors import VextureError

__all__ = ["one_line", "say"]


def say(message: str) -> None:
    """Print a line where errors go."""
    click.echo(f"vexture: {message}", err=True)


@contextmanager
def one_line() -> Iterator[None]:
    """Errors that are the user's to mend, and warnings, become one line each."""
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
