"""The program `vexture`. From here on, Ctrl-C ends it with one line, even while its modules are imported."""

import os
import signal

from vexture.cli.interrupt import at_once


def main() -> None:
    """Run the command line."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # a shell may ignore the signal
        signal.signal(signal.SIGINT, at_once)
    for descriptor in (0, 1, 2):
        try:
            os.fstat(descriptor)
        except OSError:  # it is closed: the next file that is opened must not take its number
            os.open(os.devnull, os.O_RDWR)
    from vexture.cli.main import main as command

    command(prog_name="vexture")
