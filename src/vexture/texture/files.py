"""Names of a texture's file; writing all files or none."""

import errno
import os
import re
import secrets
from collections.abc import Mapping
from pathlib import Path

from vexture.errors import DeviceError, FormatError
from vexture.layout import PACKED_SUFFIX

__all__ = [
    "TEMPORARY",
    "file_name",
    "is_folder",
    "read_file",
    "replace_files",
    "target_of",
    "writable",
    "write_together",
]

TEMPORARY = ".tmp"
"""How the names of files end that are not complete: those that a crash has left can go."""

NAME_BYTES = 200  # file systems allow 255, and suffixes are still to come


def file_name(name: str) -> str:
    """Return a file name for a drawing's name: of letters, digits, spaces and ``._-``, in no other folder.

    Examples
    --------
    >>> file_name("../../etc/passwd"), file_name(""), file_name("kaart van Delft")
    ('_.._etc_passwd', 'drawing', 'kaart van Delft')
    """
    safe = re.sub(r"[^\w .-]", "_", name).strip(". ")
    return safe.encode()[:NAME_BYTES].decode(errors="ignore") or "drawing"


def target_of(path: str | os.PathLike[str], name: str) -> Path:
    """Return the packed texture's file to write: named `name` in a folder, or the path itself.

    Examples
    --------
    >>> str(target_of("maps/", "delft")), str(target_of("maps/all.ktx2", "delft"))
    ('maps/delft.ktx2', 'maps/all.ktx2')
    """
    return Path(path) / (file_name(name) + PACKED_SUFFIX) if is_folder(path) else Path(path)


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Whether a path to write to exists as a folder, or says by its end that it shall be one."""
    return os.fspath(path).endswith(("/", os.sep)) or os.path.isdir(path)


def writable(folder: Path) -> Path:
    """The folder, which is there or can be made: for those who would find out after a minute's work.

    Raises
    ------
    DeviceError
        If nothing can be written there.

    Examples
    --------
    >>> writable(Path("/dev/null/report"))
    Traceback (most recent call last):
        ...
    vexture.errors.DeviceError: /dev/null/report: cannot be written (/dev/null is no folder); choose another place
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
    """Write all the files or none, as `replace_files` does.

    Raises
    ------
    DeviceError
        If the disk refuses.
    """
    try:
        replace_files(files)
    except OSError as error:
        raise DeviceError(f"{error.filename}: cannot be written ({error.strerror}); choose another place") from None


def replace_files(files: Mapping[Path, bytes], *, durable: bool = False) -> None:
    """Write all the files or none, in folders that are made where they are missing.

    Each is written under a temporary name beside its place; when all are complete they are moved.

    Parameters
    ----------
    files : mapping
        Content of each; of a link, what it stands for is replaced.
    durable : bool
        Whether they must survive a loss of power from when this function returns.

    Raises
    ------
    OSError
        Naming the file that the disk refuses.
    """
    places = {path.resolve(): data for path, data in files.items()}
    token = secrets.token_hex(4)
    made: dict[Path, Path] = {}
    try:
        for path, data in places.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            partial = path.with_name(f".{path.name}.{token}{TEMPORARY}")
            with partial.open("xb") as file:
                made[path] = partial
                file.write(data)
                if durable:
                    file.flush()
                    os.fsync(file.fileno())
        for path in places:  # seen before anything is replaced
            if path.is_dir():
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
            if path.exists() and not path.is_file():
                raise OSError(errno.EINVAL, "not a regular file")
        for path in places:
            made[path] = made[path].replace(path)
    except BaseException as error:
        for file_made in made.values():
            file_made.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise OSError(error.errno, error.strerror, str(path)) from None
        raise
    for folder in {path.parent for path in places} if durable else ():
        _keep_renames(folder)


def _keep_renames(folder: Path) -> None:
    """Bring a folder's entries to the disk: a rename is there after a loss of power only then."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def read_file(path: Path, limit: int, remedy: str) -> bytes:
    """Return the bytes of a file, one more than `limit` at most.

    Parameters
    ----------
    path : Path
    limit : int
        Bytes.
    remedy : str
        What a message says of a file that is not there.

    Raises
    ------
    FormatError
        If there is no such file.
    DeviceError
        If the disk refuses.
    """
    try:
        with path.open("rb") as file:
            return file.read(limit + 1)
    except FileNotFoundError:
        raise FormatError(f"{path}: not found; {remedy}") from None
    except OSError as error:
        raise DeviceError(f"{path}: cannot be read ({error.strerror}); check the file's permissions") from None
