"""Shapes by name, the files that clients fetch for them, and who waits for changes."""

import asyncio
import hashlib
import json
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Final, NamedTuple

__all__ = ["TEXTURE_TYPE", "Event", "File", "Shape", "Shelf"]

TEXTURE_TYPE: Final = "image/ktx2"

DIGEST_LENGTH: Final = 32  # hexadecimal digits: 128 bits are enough to name a file after its content


class File(NamedTuple):
    """Bytes that are served under a name made of their digest, and so never change.

    Attributes
    ----------
    data : bytes
    media_type : str
    suffix : str
        End of its name, such as ``.ktx2``.
    """

    data: bytes
    media_type: str
    suffix: str

    @property
    def name(self) -> str:
        """Digest and suffix.

        Examples
        --------
        >>> File(b"", "image/ktx2", ".ktx2").name
        'e3b0c44298fc1c149afbf4c8996fb924.ktx2'
        """
        return hashlib.sha256(self.data).hexdigest()[:DIGEST_LENGTH] + self.suffix


@dataclass(frozen=True)
class Shape:
    """One published shape or drawing.

    Parameters
    ----------
    name : str
    texture : File
        Its packed texture.
    facts : mapping
        Counts, sizes and times for people, ready for JSON.
    views : mapping
        Files that are compared with the texture: ``svg``, the source.
    """

    name: str
    texture: File
    facts: Mapping[str, Any] = field(default_factory=dict)
    views: Mapping[str, File] = field(default_factory=dict)

    @cached_property
    def version(self) -> str:
        """Digest of all that clients see."""
        seen = [self.name, self.texture.name, {what: file.name for what, file in self.views.items()}]
        return hashlib.sha256(json.dumps(seen, sort_keys=True).encode()).hexdigest()[:DIGEST_LENGTH]


class Event(NamedTuple):
    """Something that happened: ``shape`` (name, version), ``gone`` (name) or ``note`` (name, message)."""

    kind: str
    data: Mapping[str, Any]


class Shelf:
    """Shapes in memory. All methods belong to the event loop's thread."""

    def __init__(self) -> None:
        self._shapes: dict[str, Shape] = {}
        self._notes: dict[str, str] = {}
        self._waiting: set[asyncio.Queue[Event]] = set()

    @property
    def names(self) -> list[str]:
        """Names of the shapes, in the order in which they came."""
        return list(self._shapes)

    def shape(self, name: str) -> Shape | None:
        """The shape of a name, if there is one."""
        return self._shapes.get(name)

    def note(self, name: str) -> str | None:
        """Why the last update of a name was refused, if it was."""
        return self._notes.get(name)

    def file(self, name: str) -> File | None:
        """One of the files that the shapes consist of."""
        for shape in self._shapes.values():
            for file in (shape.texture, *shape.views.values()):
                if file.name == name:
                    return file
        return None

    def put(self, shape: Shape) -> None:
        """Publish a shape, in the place of the one of its name."""
        self._notes.pop(shape.name, None)
        self._shapes[shape.name] = shape
        self._tell(Event("shape", {"name": shape.name, "version": shape.version}))

    def refuse(self, name: str, message: str) -> None:
        """Tell everyone why an update is not published; the last good shape stays."""
        self._notes[name] = message
        self._tell(Event("note", {"name": name, "message": message}))

    def _tell(self, event: Event) -> None:
        for queue in self._waiting:
            queue.put_nowait(event)

    @asynccontextmanager
    async def events(self) -> AsyncIterator[asyncio.Queue[Event]]:
        """Queue of what happens from now on."""
        queue: asyncio.Queue[Event] = asyncio.Queue()
        self._waiting.add(queue)
        try:
            yield queue
        finally:
            self._waiting.discard(queue)
