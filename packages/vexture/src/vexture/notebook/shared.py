"""Bytes that several widgets use: a kernel sends them once, and a notebook holds them once."""

import hashlib
from typing import Any, Final

import ipywidgets
import traitlets

__all__ = ["Shared", "shared"]

KEY_LENGTH: Final = 16


class Shared(ipywidgets.Widget):
    """A model without a view. `key` tells its content from others."""

    key = traitlets.Unicode().tag(sync=True)
    content = traitlets.Bytes().tag(sync=True)
    users = 0

    def release(self) -> None:
        """One user less; without any it is closed, and so are its bytes in the page."""
        self.users -= 1
        if self.users == 0:
            self.close()


_OPEN: dict[str, Shared] = {}


def shared(content: bytes, **options: Any) -> Shared:
    """The model of some bytes, with one user more; that which is there, unless it was closed."""
    key = hashlib.sha256(content).hexdigest()[:KEY_LENGTH]
    found = _OPEN.get(key)
    if found is None or found.comm is None:
        found = _OPEN[key] = Shared(key=key, content=content, **options)
    found.users += 1
    return found
