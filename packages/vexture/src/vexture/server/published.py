"""Published shapes: their files, their manifests, and the clients that listen for changes."""

import asyncio
import hashlib
import json
from collections import Counter, OrderedDict
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Final

TEXTURE_TYPE: Final = "image/ktx2"

DIGEST_LENGTH: Final = 32  # hexadecimal digits: 128 bits are enough to name a file after its content

REPLACED_BYTES: Final = 32 * 2**20
"""Of replaced files that are still served, to clients that have just read the previous manifest."""


@dataclass(frozen=True)
class PublishedFile:
    """Bytes that are served under the name of their digest, and so never change."""

    data: bytes
    media_type: str
    suffix: str  # of its name, such as .ktx2

    @cached_property
    def name(self) -> str:
        """Digest and suffix.

        Examples
        --------
        >>> PublishedFile(b"", "image/ktx2", ".ktx2").name
        'e3b0c44298fc1c149afbf4c8996fb924.ktx2'
        """
        return hashlib.sha256(self.data).hexdigest()[:DIGEST_LENGTH] + self.suffix


@dataclass(frozen=True)
class PublishedShape:
    """One published shape or drawing."""

    name: str
    texture: PublishedFile  # packed
    facts: Mapping[str, Any] = field(default_factory=dict)  # counts, sizes and times, ready for JSON
    views: Mapping[str, PublishedFile] = field(default_factory=dict)  # to compare with the texture: svg, the source

    @cached_property
    def version(self) -> str:
        """Digest of all that clients see, but for how long the conversion took."""
        facts = {what: fact for what, fact in self.facts.items() if what != "milliseconds"}
        seen = [self.name, self.texture.name, {what: file.name for what, file in self.views.items()}, facts]
        return hashlib.sha256(json.dumps(seen, sort_keys=True).encode()).hexdigest()[:DIGEST_LENGTH]

    @property
    def files(self) -> tuple[PublishedFile, ...]:
        """All files that it consists of."""
        return (self.texture, *self.views.values())


def manifest(
    shape: PublishedShape,
    note: str | None,
    views: Mapping[str, Any],
    *,
    levels: int = 0,
    address: Callable[[PublishedFile], str] | None = None,
) -> dict[str, Any]:
    """Describe a shape to clients, ready for JSON.

    The note says why its last update was refused, if it was. The views are addresses of what the texture can be
    compared with, beside the shape's own files. Addresses are relative to that of the manifest, which is some levels
    below ``shapes/``. On a page without a server, and so without a stream of changes, `address` gives those of files.
    """
    top = "../" * (levels + 1)
    where = address or (lambda file: f"{top}files/{file.name}")
    return {
        "name": shape.name,
        "version": shape.version,
        "texture": where(shape.texture),
        "bytes": len(shape.texture.data),
        "events": None if address else f"{top}events",
        "facts": dict(shape.facts),
        "views": {what: where(file) for what, file in shape.views.items()} | dict(views),
        "note": note,
    }


@dataclass(frozen=True)
class Event:
    """Something that happened: ``shape`` (name, version), ``gone`` (name) or ``note`` (name, message)."""

    kind: str
    data: Mapping[str, Any]

    @cached_property
    def sent(self) -> bytes:
        """The event as all clients receive it (HTML, 9.2)."""
        return f"event: {self.kind}\r\ndata: {json.dumps(self.data, separators=(',', ':'))}\r\n\r\n".encode()


class Listener:
    """Events that one client has still to receive: the newest of each name, so that a slow client costs no more."""

    def __init__(self) -> None:
        self._pending: OrderedDict[tuple[str, str], Event] = OrderedDict()
        self._something = asyncio.Event()
        self._closed = False

    def __len__(self) -> int:
        return len(self._pending)

    def add(self, event: Event) -> None:
        """Add an event, and drop those that it supersedes."""
        name = event.data["name"]
        for kind in ("note",) if event.kind == "note" else ("shape", "gone", "note"):
            self._pending.pop((kind, name), None)
        self._pending[event.kind, name] = event
        self._something.set()

    def close(self) -> None:
        """End the stream after the events that are pending."""
        self._closed = True
        self._something.set()

    async def next(self) -> Event | None:
        """Wait for the next event; None when the server stops."""
        while not self._pending:
            if self._closed:
                return None
            self._something.clear()
            await self._something.wait()
        return self._pending.popitem(last=False)[1]


class PublishedShapes:
    """Shapes in memory. All methods belong to the event loop's thread."""

    def __init__(self) -> None:
        self._shapes: dict[str, PublishedShape] = {}
        self._notes: dict[str, str] = {}
        self._files: dict[str, PublishedFile] = {}
        self._owners: Counter[str] = Counter()
        self._replaced: OrderedDict[str, PublishedFile] = OrderedDict()
        self._listeners: set[Listener] = set()
        self._closed = False

    @property
    def names(self) -> list[str]:
        """Names of the shapes, in the order in which they came."""
        return list(self._shapes)

    def versions(self, names: Iterable[str]) -> dict[str, str]:
        """Version of each shape of these names that there is."""
        return {name: self._shapes[name].version for name in names if name in self._shapes}

    @property
    def notes(self) -> dict[str, str]:
        """Reasons why the last update of a shape was refused, by the names of those of which it was."""
        return dict(self._notes)

    @property
    def nbytes(self) -> int:
        """Bytes of all files of the shapes."""
        return sum(len(file.data) for file in self._files.values())

    def shape(self, name: str) -> PublishedShape | None:
        """The shape of a name, if there is one."""
        return self._shapes.get(name)

    def file(self, name: str) -> PublishedFile | None:
        """File of a name that the shapes consist of, or consisted of a moment ago."""
        return self._files.get(name) or self._replaced.get(name)

    def owners(self, file: str) -> int:
        """Number of times that the shapes use a file, by its name."""
        return self._owners[file]

    def add(self, shape: PublishedShape) -> None:
        """Publish a shape; it replaces the one of its name."""
        self._notes.pop(shape.name, None)
        for file in shape.files:
            self._files[file.name] = file
            self._owners[file.name] += 1
            self._replaced.pop(file.name, None)
        before = self._shapes.get(shape.name)
        self._shapes[shape.name] = shape
        self._release(before)
        self._notify(Event("shape", {"name": shape.name, "version": shape.version}))

    def remove(self, name: str) -> None:
        """Remove the shape of a name, and the note about it."""
        shape, note = self._shapes.pop(name, None), self._notes.pop(name, None)
        if shape is not None:
            self._release(shape)
        if shape is not None or note is not None:
            self._notify(Event("gone", {"name": name}))

    def refuse(self, name: str, message: str) -> None:
        """Tell all clients why an update is not published; the last good shape stays."""
        self._notes[name] = message
        self._notify(Event("note", {"name": name, "message": message}))

    def close(self) -> None:
        """End the streams of all listeners, and of those that come later."""
        self._closed = True
        for listener in self._listeners:
            listener.close()

    def _release(self, shape: PublishedShape | None) -> None:
        """Give up the files of a replaced shape; those that no shape uses any more are served for a while."""
        for file in () if shape is None else shape.files:
            self._owners[file.name] -= 1
            if not self._owners[file.name]:
                del self._owners[file.name]
                self._replaced[file.name] = self._files.pop(file.name)
        size = sum(len(file.data) for file in self._replaced.values())
        while size > REPLACED_BYTES:
            size -= len(self._replaced.popitem(last=False)[1].data)

    def _notify(self, event: Event) -> None:
        for listener in self._listeners:
            listener.add(event)

    @contextmanager
    def events(self) -> Iterator[Listener]:
        """Listen to what happens from now on."""
        listener = Listener()
        self._listeners.add(listener)
        if self._closed:
            listener.close()
        try:
            yield listener
        finally:
            self._listeners.discard(listener)
