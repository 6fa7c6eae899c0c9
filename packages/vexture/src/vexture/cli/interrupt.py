"""Ctrl-C while no command runs: before its modules are imported, and after it."""

import os
from types import FrameType

INTERRUPTED = 130
"""Exit code after Ctrl-C: 128 and the signal's number, as shells have it."""


def at_once(number: int, frame: FrameType | None) -> None:
    """End the program in a line: nothing is open that is half-written."""
    os.write(2, b"vexture: interrupted\n")
    os._exit(INTERRUPTED)
