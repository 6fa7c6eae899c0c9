"""HarfBuzz, which reads fonts and shapes text; it comes with ``vexture[text]``."""

from functools import cache
from importlib import import_module
from typing import Any

from vexture.base.errors import DeviceError


@cache
def harfbuzz() -> Any:
    """Return the module `uharfbuzz`; raise a `DeviceError` if it is not installed."""
    try:
        return import_module("uharfbuzz")
    except ImportError:
        raise DeviceError("fonts need the package uharfbuzz; install it: pip install 'vexture[text]'") from None
