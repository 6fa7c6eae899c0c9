"""Bytes that several widgets use: a kernel sends them once, and a notebook holds them once."""

import hashlib
from typing import Any, Final

import ipywidgets
import traitlets

KEY_LENGTH: Final = 16


class SharedContent(ipywidgets.Widget):
    """A model without a view. `key` tells its content from others."""

    key = traitlets.Unicode().tag(sync=True)
    content = traitlets.Bytes().tag(sync=True)
    users = 0

    def release(self) -> None:
        """Remove one user; the last one closes the model, and its bytes in the page."""
        self.users -= 1
        if self.users == 0:
            self.close()


_OPEN: dict[str, SharedContent] = {}


def share_content(content: bytes, **options: Any) -> SharedContent:
    """Return the model of some bytes, with one more user; an open one of the same bytes is used again."""
    key = hashlib.sha256(content).hexdigest()[:KEY_LENGTH]
    found = _OPEN.get(key)
    if found is None or found.comm is None:
        found = _OPEN[key] = SharedContent(key=key, content=content, **options)
    found.users += 1
    return found
