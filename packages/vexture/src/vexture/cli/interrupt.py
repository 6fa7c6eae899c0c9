"""Handling of Ctrl-C before the modules of a command are imported, and after the command."""

import os
from types import FrameType

INTERRUPTED = 130
"""Exit code after Ctrl-C: 128 plus the signal's number, as in shells."""


def at_once(number: int, frame: FrameType | None) -> None:
    """End the program with one line; no file is half-written at this point."""
    os.write(2, b"vexture: interrupted\n")
    os._exit(INTERRUPTED)
