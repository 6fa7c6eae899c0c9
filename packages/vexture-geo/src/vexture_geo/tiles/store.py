"""Finished parts of a pyramid, on disk beside it, so that an interrupted run can resume."""

import hashlib
import json
import os
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, Final

from vexture.base.errors import DeviceError
from vexture.texture.files import TEMPORARY
from vexture_geo.tiles.subtree import JobResult

SUFFIX: Final = ".parts"
"""Suffix of the folder, appended to the name of the output."""

KEY, PARTS, JOURNAL = "key.json", "parts.json", "journal"


@dataclass(frozen=True)
class Content:
    """Location of a tile's bytes."""

    path: Path
    offset: int
    length: int

    def read(self) -> bytes:
        """Read the bytes."""
        with self.path.open("rb") as file:
            file.seek(self.offset)
            return file.read(self.length)


class Store:
    """Folder of an unfinished pyramid.

    A pack holds the result of one job. It is written completely or not at all, and the journal records its digest: a
    pack that is not in the journal is made again.
    """

    def __init__(self, folder: Path, key: dict[str, Any]) -> None:
        self.folder = folder
        text = json.dumps(key, sort_keys=True)
        if folder.is_dir() and _text(folder / KEY) != text:
            if any(folder.iterdir()) and not (folder / KEY).exists():
                raise DeviceError(f"{folder}: it is needed, but holds something else; move it away")
            shutil.rmtree(folder)
        folder.mkdir(parents=True, exist_ok=True)
        self._lock = _lock(folder)
        if not (folder / KEY).exists():
            self.write(KEY, text.encode())
        self.sources = folder / "source"
        self._known = dict(self._journal())

    def write(self, name: str, data: bytes) -> None:
        """Write a file completely or not at all."""
        path = self.folder / name
        partial = path.with_name(path.name + TEMPORARY)
        try:
            partial.write_bytes(data)
            partial.replace(path)
        except BaseException:
            partial.unlink(missing_ok=True)  # it may have filled the disk
            raise

    def read_parts(self) -> Any:
        """Read the facts about the parts of the source, if all parts exist."""
        text = _text(self.folder / PARTS)
        if text is None:
            shutil.rmtree(self.sources, ignore_errors=True)
            self.sources.mkdir()
            return None
        return json.loads(text)

    @property
    def has_parts(self) -> bool:
        """True if the source is read, so that a later run can go on."""
        return (self.folder / PARTS).exists()

    def write_parts(self, facts: Any) -> None:
        """Record the facts about the source once all its parts exist."""
        self.write(PARTS, json.dumps(facts).encode())

    def _journal(self) -> Iterator[tuple[str, str]]:
        lines = (_text(self.folder / JOURNAL) or "").split("\n")[:-1]  # the last line may be incomplete
        for name, _, digest in (line.partition(" ") for line in lines):
            path = self.folder / name
            if path.is_file() and _digest(path) == digest:
                yield name, digest

    def has(self, name: str) -> bool:
        """Return whether a job is done."""
        return name in self._known

    def add(self, name: str, result: JobResult) -> None:
        """Store the result of a job."""
        head = json.dumps(
            {
                "runs": result.runs,
                "contents": [[digest, len(content)] for digest, content in result.contents.items()],
                "geometry": len(result.geometry),
            }
        )
        data = b"".join([head.encode(), b"\n", *result.contents.values(), result.geometry])
        self.write(name, data)
        digest = hashlib.sha256(data).hexdigest()
        with (self.folder / JOURNAL).open("a") as file:
            file.write(f"{name} {digest}\n")
        self._known[name] = digest

    def geometry(self, name: str) -> bytes:
        """Read the geometry for lower zooms that a job made."""
        with (self.folder / name).open("rb") as file:
            length = json.loads(file.readline())["geometry"]
            file.seek(-length, os.SEEK_END)
            return file.read(length)

    def tiles(self) -> tuple[list[tuple[int, int, str]], dict[str, Content]]:
        """Return all runs of equal tiles by number, count and digest, in order, and the locations of contents."""
        runs: list[tuple[int, int, str]] = []
        contents: dict[str, Content] = {}
        for name in sorted(self._known):
            path = self.folder / name
            with path.open("rb") as file:
                head = json.loads(file.readline())
                offset = file.tell()
            runs += [(first, count, digest) for first, count, digest in head["runs"]]
            for digest, length in head["contents"]:
                contents.setdefault(digest, Content(path, offset, length))
                offset += length
        runs.sort()
        joined: list[tuple[int, int, str]] = []
        for first, count, digest in runs:
            if joined and joined[-1][2] == digest and joined[-1][0] + joined[-1][1] == first:
                first, count = joined[-1][0], joined.pop()[1] + count
            joined.append((first, count, digest))
        return joined, contents

    def close(self) -> None:
        """Release the folder's lock."""
        if self._lock is not None:
            self._lock.close()

    def remove(self) -> None:
        """Remove the folder of a finished pyramid."""
        self.close()
        shutil.rmtree(self.folder, ignore_errors=True)


def _text(path: Path) -> str | None:
    try:
        return path.read_text()
    except FileNotFoundError:
        return None


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _lock(folder: Path) -> BinaryIO | None:
    """Lock a folder until the process ends in any way."""
    try:
        import fcntl
    except ImportError:  # on Windows
        return None
    file = (folder / "lock").open("wb")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        file.close()
        raise DeviceError(
            f"{folder}: another process makes this pyramid now; wait for it, or write elsewhere"
        ) from None
    return file
