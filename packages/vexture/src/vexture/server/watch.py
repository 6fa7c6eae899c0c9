"""Files that are converted again whenever they are saved."""

import asyncio
import unicodedata
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vexture.base.errors import EXPECTED
from vexture.conversion.reading import content_of
from vexture.server.published import PublishedShape, PublishedShapes

STEP_MILLISECONDS = 10
DEBOUNCE_MILLISECONDS = 50
"""Interval between two checks for changes, and the longest time over which changes are collected."""

CHECK_MILLISECONDS = 1000
"""Interval of full checks. They find files saved before watching began, and changes that a disk does not report."""

SETTLING_SECONDS = (0.03, 0.15, 0.5)
"""Pauses before an unreadable or invalid file is read again. Editors delete a file while they save, or write it in
pieces."""


_Stamp = tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class WatchedFile:
    """A file that is shown."""

    path: Path  # as the user typed it, for messages
    name: str  # name of the shape

    @property
    def places(self) -> set[Path]:
        """Paths to watch for changes of the file: its own and, for a symbolic link, its target."""
        return {self.path.parent.resolve() / self.path.name, self.path.resolve()}


Convert = Callable[[WatchedFile, bytes], Awaitable[PublishedShape]]


def name_files(paths: Sequence[Path]) -> list[WatchedFile]:
    r"""Give each file a unique name, made from its stem, in Unicode normal form NFC.

    Examples
    --------
    >>> [source.name for source in name_files([Path("a/duck.svg"), Path("b/duck.svg"), Path("cake.svg")])]
    ['duck', 'duck-2', 'cake']
    >>> [source.name for source in name_files([Path("cafe\u0301.svg")])] == ["caf\u00e9"]
    True
    """
    names: set[str] = set()
    sources = []
    for path in paths:
        stem = unicodedata.normalize("NFC", path.stem) or "drawing"
        name, number = stem, 1
        while name in names:
            number += 1
            name = f"{stem}-{number}"
        names.add(name)
        sources.append(WatchedFile(path, name))
    return sources


async def watch(
    published: PublishedShapes, sources: Sequence[WatchedFile], convert: Convert, contents: Mapping[str, bytes | None]
) -> None:
    """Publish each file again when it changes, or notify clients why not, until this is cancelled.

    `convert` makes the shape of a file and its content; `contents` holds the published content of each file by name.
    """
    from watchfiles import awatch

    content: dict[str, bytes | None] = dict(contents)
    read: dict[str, _Stamp | None] = {}
    owners: dict[Path, list[WatchedFile]] = {}
    for source in sources:
        for place in source.places:
            owners.setdefault(place, []).append(source)

    def ours(_change: Any, path: str) -> bool:
        return Path(path) in owners

    async for changes in awatch(
        *{place.parent for place in owners},
        watch_filter=ours,
        step=STEP_MILLISECONDS,
        debounce=DEBOUNCE_MILLISECONDS,
        rust_timeout=CHECK_MILLISECONDS,
        yield_on_timeout=True,
        recursive=False,
    ):
        changed = {source for _, path in changes for source in owners[Path(path)]}
        for source in changed or sources:
            stamp = _stamp(source.path)
            if source in changed or read.get(source.name, ()) != stamp:
                read[source.name] = stamp
                await _publish(published, source, convert, content)


def _stamp(path: Path) -> _Stamp | None:
    """Return a file's inode, size and time, which change with its content; None if it does not exist."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_ino, found.st_size, found.st_mtime_ns


async def _publish(
    published: PublishedShapes, source: WatchedFile, convert: Convert, content: dict[str, bytes | None]
) -> None:
    """Publish a file once it is a valid drawing; after the last pause, notify clients why it is not."""
    line = ""
    for delay in (*SETTLING_SECONDS, None):
        try:
            data = await asyncio.to_thread(content_of, source.path)
            if data == content[source.name]:
                return
            shape = await convert(source, data)
        except EXPECTED as error:
            line = str(error)
            if delay is not None:
                await asyncio.sleep(delay)
            continue
        content[source.name] = data
        published.add(shape)
        return
    content[source.name] = None  # if the last good content comes back, it is published and clears the note
    published.refuse(source.name, line)
