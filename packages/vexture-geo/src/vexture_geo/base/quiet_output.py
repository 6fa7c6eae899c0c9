"""Hide what a C library prints: GDAL's decoder of GRIB prints its doubts to the standard output."""

import ctypes
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Lock
from typing import Final

OUT: Final = 1
"""The descriptor of the standard output."""

TURN: Final = Lock()
"""Held while the standard output leads nowhere."""


@contextmanager
def quiet_output() -> Iterator[None]:
    """Hide what is printed to the standard output within this context, which should be short."""
    with TURN:
        try:
            kept = os.dup(OUT)
        except OSError:  # it is closed
            yield
            return
        try:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, OUT)
            os.close(nowhere)
            yield
        finally:
            with suppress(OSError, TypeError, AttributeError):  # where the C library cannot be called
                ctypes.CDLL(None).fflush(None)  # what it holds back would be printed later
            os.dup2(kept, OUT)
            os.close(kept)
