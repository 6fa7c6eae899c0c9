"""Hide output of C libraries, because GDAL's decoder of GRIB prints warnings to the standard output."""

import ctypes
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Lock
from typing import Final

OUT: Final = 1
"""Descriptor of the standard output."""

TURN: Final = Lock()
"""Lock held while the standard output is redirected."""


@contextmanager
def quiet_output() -> Iterator[None]:
    """Hide everything printed to the standard output within this context, which should be short."""
    with TURN:
        try:
            kept = os.dup(OUT)
        except OSError:  # the standard output is closed
            yield
            return
        try:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, OUT)
            os.close(nowhere)
            yield
        finally:
            with suppress(OSError, TypeError, AttributeError):  # where the C library cannot be called
                ctypes.CDLL(None).fflush(None)  # otherwise buffered output would be printed later
            os.dup2(kept, OUT)
            os.close(kept)
