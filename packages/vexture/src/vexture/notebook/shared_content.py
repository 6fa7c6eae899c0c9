"""Bytes that several widgets share: a kernel sends them once, and a notebook stores them once."""

import hashlib
from typing import Any, Final

import ipywidgets
import traitlets

KEY_LENGTH: Final = 16


class SharedContent(ipywidgets.Widget):
    """A model without a view, shared by all widgets with the same content. `key` identifies the content."""

    key = traitlets.Unicode().tag(sync=True)
    content = traitlets.Bytes().tag(sync=True)
    users = 0

    def release(self) -> None:
        """Remove one user; the last one closes the model, which frees the bytes in the page."""
        self.users -= 1
        if self.users == 0:
            self.close()


_OPEN: dict[str, SharedContent] = {}


def share_content(content: bytes, **options: Any) -> SharedContent:
    """Return the model of some bytes with one more user; reuse an open model of the same bytes."""
    key = hashlib.sha256(content).hexdigest()[:KEY_LENGTH]
    found = _OPEN.get(key)
    if found is None or found.comm is None:
        found = _OPEN[key] = SharedContent(key=key, content=content, **options)
    found.users += 1
    return found
