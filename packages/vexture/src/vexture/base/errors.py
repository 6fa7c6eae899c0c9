"""Errors: one class for each remedy that a user has.

Every message is one line that names the value, the limit and the remedy. Messages name parameters in backticks, as in
`max_depth`; the command line turns them into options, prints the line and exits with code 1.

A wrong argument raises `ParameterError`, a `ValueError`. A bad file, a limit or a device raises a `VextureError`. Any
other exception that reaches a user is a bug.
"""

from typing import Final


class VextureError(Exception):
    """Base class of all errors that a file, a limit or a device causes."""

    def __init__(self, message: str = "") -> None:
        super().__init__(printable(message))


class SourceError(VextureError):
    """The drawing cannot be read: correct the source file."""


class FormatError(VextureError):
    """The texture file is damaged or in another format: convert the drawing again."""


class LimitError(VextureError):
    """The drawing, file or image exceeds a limit: change the parameter that the message names."""


class DeviceError(VextureError):
    """The GPU, its driver or the disk fails: use another renderer or another folder."""


class ParameterError(ValueError):
    """An argument has a value that is not allowed."""

    def __init__(self, message: str = "") -> None:
        super().__init__(printable(message))


EXPECTED: Final = (VextureError, ParameterError)
"""Errors that a command or a server reports as one line."""


class SourceWarning(UserWarning):
    """A part of the drawing is not supported and was left out or simplified."""


def printable(text: str) -> str:
    r"""Replace each character that ends a line or controls a terminal.

    Examples
    --------
    >>> print(printable("a\x9b2J\nb"))
    a�2J�b
    """
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text)


class MissingPackageError(DeviceError, AttributeError):
    """A public name needs a package that is not installed; ``hasattr`` answers False."""


def format_count(count: int, noun: str) -> str:
    """Format a count and its noun, which is plural unless the count is 1.

    Examples
    --------
    >>> format_count(1, "shape"), format_count(0, "shape"), format_count(2, "shape")
    ('1 shape', '0 shapes', '2 shapes')
    """
    return f"{count} {noun}{'s' * (count != 1)}"


def shorten_text(text: str, most: int) -> str:
    """Shorten a text to at most `most` characters.

    Examples
    --------
    >>> shorten_text("a long name", 8), shorten_text("a name", 8)
    ('a lon...', 'a name')
    """
    return text if len(text) <= most else text[: most - 3] + "..."


def reason_of(error: Exception, most: int = 120, hidden: str = "") -> str:
    """Shorten the text of another library's exception to one line; without a text, return the exception's type.

    `hidden` is the name of a temporary file; the text becomes "the file", as the name means nothing to the user.
    """
    text = " ".join((str(error).replace(hidden, "the file") if hidden else str(error)).split())
    return shorten_text(text, most) or type(error).__name__
