"""What the commands share: errors and warnings as one line each, and what arguments may be."""

import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import click

from vexture.errors import VextureError

__all__ = ["Tolerance", "one_line", "say"]


class Tolerance(click.ParamType[Any]):
    """A number, or auto."""

    name = "T"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the number, or the word."""
        if value == "auto" or isinstance(value, float):
            return value
        try:
            return float(value)
        except ValueError:
            self.fail(f"{value!r} is neither a number nor auto", param, ctx)


def say(message: str) -> None:
    """Tell the user one line, beside the output."""
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
