"""Name a texture's file; write several files atomically, all or none."""

import errno
import os
import re
import time
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from vexture.base.errors import DeviceError, FormatError, ParameterError
from vexture.base.layout import PACKED_SUFFIX

TEMPORARY = ".tmp"
"""Suffix of incomplete files."""

LEFT_SECONDS = 3600.0
"""Age from which an incomplete file is a killed process's leftover, and is removed when its target is written."""

OTHER_FILES = (".png", ".jpg", ".jpeg", ".webp", ".gif", ".bmp", ".svg", ".svgz", ".json", ".geojson", ".html", ".glsl")
"""Suffixes that a texture's file must not have, because programs would open it as a picture or a drawing."""

NAME_BYTES = 200  # file systems allow 255, and suffixes are added


def file_name(name: str) -> str:
    """File name for a drawing's name, of letters, digits, spaces and ``._-``, so that it cannot name another folder."""
    safe = re.sub(r"[^\w .-]", "_", name).strip(". ")
    return safe.encode()[:NAME_BYTES].decode(errors="ignore") or "drawing"


def target_of(path: str | os.PathLike[str], name: str) -> Path:
    """Path of the packed texture's file to write: `name` in a folder, or the path itself.

    Raises a `ParameterError` if the path ends in a suffix of `OTHER_FILES`.
    """
    if is_folder(path):
        return Path(path) / (file_name(name) + PACKED_SUFFIX)
    if (suffix := Path(path).suffix).lower() in OTHER_FILES:
        raise ParameterError(f"`path` {path} ends in {suffix}, but a texture is a KTX2 file; use {PACKED_SUFFIX}")
    return Path(path)


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Return whether a path to write to is an existing folder, or ends with a separator."""
    return os.fspath(path).endswith(("/", os.sep)) or os.path.isdir(path)


def writable(folder: Path) -> Path:
    """Return the folder if it is writable or can be made, else raise a `DeviceError`.

    Callers check this before a long computation.
    """
    there = folder.absolute()
    while not os.path.lexists(there):
        there = there.parent
    if not there.is_dir():
        raise DeviceError(f"{folder}: cannot be written ({there} is no folder); choose another place")
    if not os.access(there, os.W_OK | os.X_OK):
        raise DeviceError(f"{folder}: cannot be written ({os.strerror(errno.EACCES)}); choose another place")
    return folder


def write_together(files: Mapping[Path, bytes]) -> None:
    """Write all files or none, as `replace_files` does; a `DeviceError` names the file that cannot be written."""
    try:
        replace_files(files)
    except OSError as error:
        raise DeviceError(f"{error.filename}: cannot be written ({error.strerror}); choose another place") from None


def replace_files(files: Mapping[Path, bytes], *, durable: bool = False) -> None:
    """Write all files or none; make missing folders.

    Each file is written under a temporary name beside its target. When all are complete, they are renamed in their
    order. The target of a symbolic link is replaced, not the link. With `durable`, the files survive a loss of power
    after this function has returned, and a loss of power before never leaves a file without those before it. An
    `OSError` names the file that cannot be written.
    """
    places = {path.resolve(): data for path, data in files.items()}
    temporary: dict[Path, Path] = {}
    try:
        for path, data in places.items():
            make_folder(path.parent, durable=durable)
            with _temporary(path) as file:
                temporary[path] = Path(file.name)
                file.write(data)
                if durable:
                    file.flush()
                    os.fsync(file.fileno())
        replaced = [path for path in places if path.exists()]
        for path in replaced:  # checked before anything is replaced
            if path.is_dir():
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
            if not path.is_file():
                raise OSError(errno.EINVAL, "not a regular file")
        before = path.parent
        for path in places:
            if durable and path.parent != before:
                _keep_entries(before)
            before = path.parent
            moved = temporary[path].replace(path)
            if path in replaced:  # the old file is gone: an error must not remove the new one
                del temporary[path]
            else:
                temporary[path] = moved
    except BaseException as error:
        for file_left in temporary.values():
            file_left.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise OSError(error.errno, error.strerror, str(path)) from None
        raise
    if durable:
        _keep_entries(path.parent)


def make_folder(folder: Path, *, durable: bool) -> None:
    """Make a folder and its parents if they are missing."""
    if not folder.is_dir():
        make_folder(folder.parent, durable=durable)
        folder.mkdir(exist_ok=True)
        if durable:
            _keep_entries(folder.parent)


def _temporary(path: Path) -> BinaryIO:
    """Open a new file beside a path, and remove leftovers of killed processes."""
    number = 0
    while True:
        partial = path.with_name(f".{path.name}.{number}{TEMPORARY}")
        try:
            return partial.open("xb")
        except FileExistsError:  # another process is writing the same file, unless it is old
            number += 1
            with suppress(OSError):
                if time.time() - partial.lstat().st_mtime > LEFT_SECONDS:
                    partial.unlink()


def _keep_entries(folder: Path) -> None:
    """Write a folder's entries to the disk; without this, a rename may not survive a loss of power."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def read_file(path: Path, limit: int, remedy: str) -> bytes:
    """Read at most `limit` + 1 bytes of a file.

    Raises a `FormatError` that ends in `remedy` if the file is missing, and a `DeviceError` if it cannot be read.
    """
    try:
        with path.open("rb") as file:
            return file.read(limit + 1)
    except FileNotFoundError:
        raise FormatError(f"{path}: not found; {remedy}") from None
    except OSError as error:
        raise DeviceError(f"{path}: cannot be read ({error.strerror}); check the file's permissions") from None
