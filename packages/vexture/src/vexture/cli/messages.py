"""Messages of the command line, one line each."""

import errno
import re
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import click

from vexture.base.errors import EXPECTED, printable, reason_of

if TYPE_CHECKING:
    from vexture.base.notes import Note

PARAMETER = re.compile(r"`([a-z_]+)`")
"""Pattern of a parameter in a message of the library."""

NAMED_OTHERWISE = {"fonts": "font", "page_colors": "color", "characters": "chars"}
"""Parameters whose options have other names: options that are given once per entry of a list, and shortened ones."""


IMAGE_FLAGS = {"trace": "--trace-images", "none": "--no-images"}
"""Flags for the values of the parameter `images`."""

IMAGES = re.compile(rf"`images` '?({'|'.join(IMAGE_FLAGS)})'?")
"""Pattern of that parameter with its value in a message of the library."""

OF_FLOODS = frozenset({"layer", "time_dim", "variable"})
"""Parameters of the flood commands: other commands read depths and areas, too, but have no options for these."""


def print_message(message: str) -> None:
    """Print a line to standard error."""
    echo(f"vexture: {as_options(message)}", err=True)


def echo(line: str, *, err: bool = False) -> None:
    """Print a line in which names from untrusted files cannot control the terminal."""
    click.echo(printable(line), err=err)


def as_options(message: str) -> str:
    """Replace the parameters in backticks in a message of the library by the options that set them."""
    message = IMAGES.sub(lambda found: IMAGE_FLAGS[found[1]], message)
    return PARAMETER.sub(lambda found: option_of(found[1]), message)


def option_of(parameter: str) -> str:
    """Return the option for a parameter of the library: that of the running command, or else the usual one."""
    context = click.get_current_context(silent=True)
    options = {} if context is None else {option.name: option for option in context.command.params}
    if parameter in options and parameter in NAMED_OTHERWISE:
        return next(flag for flag in options[parameter].opts if flag.startswith("--"))
    usual = "--" + NAMED_OTHERWISE.get(parameter, parameter).replace("_", "-")
    return f"{usual} of vexture flood" if options and parameter in OF_FLOODS - options.keys() else usual


def note_facts(notes: Sequence["Note"]) -> list[dict[str, Any]]:
    """Return notes as JSON values, with option names in place of parameters."""
    return [note.facts() | {"message": as_options(note.message)} for note in notes]


def say_notes(source: object, notes: Sequence["Note"]) -> None:
    """Print the notes about a source as one line, if there are any."""
    from vexture.base.notes import line_of  # the list of the commands does not wait for it

    if line := line_of(str(source), notes):
        print_message(f"warning: {line}")


@contextmanager
def one_line() -> Iterator[None]:
    """Print errors that the user can correct, and warnings of libraries, as one line each."""
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_args, **_kwargs: print_message(f"warning: {message}")
        warnings.simplefilter("always")
        warnings.simplefilter("ignore", ResourceWarning)  # Ctrl-C leaves open what it interrupts
        try:
            yield
        except EXPECTED as error:
            print_message(str(error))
            sys.exit(1)
        except BrokenPipeError:
            raise  # click ends silently: the reader of the pipe, such as head, has enough
        except OSError as error:
            remedy = "make room, or choose another place" if error.errno == errno.ENOSPC else "choose another file"
            print_message(f"{error.filename or 'the output'}: {error.strerror or reason_of(error)}; {remedy}")
            sys.exit(1)
        except MemoryError:
            print_message("out of memory; use a smaller drawing or a smaller --size")
            sys.exit(1)
