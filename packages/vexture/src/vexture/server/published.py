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

DIGEST_LENGTH: Final = 32  # hexadecimal digits; 128 bits identify a file's content

REPLACED_BYTES: Final = 32 * 2**20
"""Bytes of replaced files that are still served, for clients that have just read the previous manifest."""


@dataclass(frozen=True)
class PublishedFile:
    """Immutable bytes, served under a name made from their digest."""

    data: bytes
    media_type: str
    suffix: str  # suffix of the name, such as .ktx2

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
    views: Mapping[str, PublishedFile] = field(default_factory=dict)  # for comparison, such as the source as svg

    @cached_property
    def version(self) -> str:
        """Digest of everything that clients see, except the duration of the conversion."""
        facts = {what: fact for what, fact in self.facts.items() if what != "milliseconds"}
        seen = [self.name, self.texture.name, {what: file.name for what, file in self.views.items()}, facts]
        return hashlib.sha256(json.dumps(seen, sort_keys=True).encode()).hexdigest()[:DIGEST_LENGTH]

    @property
    def files(self) -> tuple[PublishedFile, ...]:
        """All files of the shape."""
        return (self.texture, *self.views.values())


def manifest(
    shape: PublishedShape,
    note: str | None,
    views: Mapping[str, Any],
    *,
    levels: int = 0,
    address: Callable[[PublishedFile], str] | None = None,
) -> dict[str, Any]:
    """Describe a shape to clients, as JSON values.

    The note, if there is one, says why the last update was refused. The views are addresses for comparison, in addition
    to the shape's own files. Addresses are relative to the manifest, which is `levels` levels below ``shapes/``. On a
    page without a server, and so without a stream of changes, `address` returns the addresses of files.
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
    """A change: ``shape`` (name, version), ``gone`` (name) or ``note`` (name, message)."""

    kind: str
    data: Mapping[str, Any]

    @cached_property
    def sent(self) -> bytes:
        """The event as bytes, identical for all clients (HTML, 9.2)."""
        return f"event: {self.kind}\r\ndata: {json.dumps(self.data, separators=(',', ':'))}\r\n\r\n".encode()


class Listener:
    """Pending events of one client: only the newest of each name, so that a slow client needs no more memory."""

    def __init__(self) -> None:
        self._pending: OrderedDict[tuple[str, str], Event] = OrderedDict()
        self._something = asyncio.Event()
        self._closed = False

    def __len__(self) -> int:
        return len(self._pending)

    def add(self, event: Event) -> None:
        """Add an event, and drop the events that it supersedes."""
        name = event.data["name"]
        for kind in ("note",) if event.kind == "note" else ("shape", "gone", "note"):
            self._pending.pop((kind, name), None)
        self._pending[event.kind, name] = event
        self._something.set()

    def close(self) -> None:
        """End the stream after the pending events."""
        self._closed = True
        self._something.set()

    async def next(self) -> Event | None:
        """Wait for the next event; return None if the server stops."""
        while not self._pending:
            if self._closed:
                return None
            self._something.clear()
            await self._something.wait()
        return self._pending.popitem(last=False)[1]


class PublishedShapes:
    """Shapes in memory. All methods must run in the event loop's thread."""

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
        """Names of the shapes, in the order of publication."""
        return list(self._shapes)

    def versions(self, names: Iterable[str]) -> dict[str, str]:
        """Return the version of each of these shapes that exists."""
        return {name: self._shapes[name].version for name in names if name in self._shapes}

    @property
    def notes(self) -> dict[str, str]:
        """Reasons why the last update of a shape was refused, by the shape's name."""
        return dict(self._notes)

    @property
    def nbytes(self) -> int:
        """Total bytes of all files of the shapes."""
        return sum(len(file.data) for file in self._files.values())

    def shape(self, name: str) -> PublishedShape | None:
        """Return the shape of a name, if there is one."""
        return self._shapes.get(name)

    def file(self, name: str) -> PublishedFile | None:
        """Return a file by name, if a shape uses it or used it until recently."""
        return self._files.get(name) or self._replaced.get(name)

    def owners(self, file: str) -> int:
        """Return the number of times that shapes use a file."""
        return self._owners[file]

    def add(self, shape: PublishedShape) -> None:
        """Publish a shape, in place of any shape of the same name."""
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
        """Remove a shape, and the note about it."""
        shape, note = self._shapes.pop(name, None), self._notes.pop(name, None)
        if shape is not None:
            self._release(shape)
        if shape is not None or note is not None:
            self._notify(Event("gone", {"name": name}))

    def refuse(self, name: str, message: str) -> None:
        """Notify all clients why an update is refused; the last good shape stays."""
        self._notes[name] = message
        self._notify(Event("note", {"name": name, "message": message}))

    def close(self) -> None:
        """End the streams of all listeners, also of future ones."""
        self._closed = True
        for listener in self._listeners:
            listener.close()

    def _release(self, shape: PublishedShape | None) -> None:
        """Release the files of a replaced shape; files without users are served for a while longer."""
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
        """Listen to events from now on."""
        listener = Listener()
        self._listeners.add(listener)
        if self._closed:
            listener.close()
        try:
            yield listener
        finally:
            self._listeners.discard(listener)
