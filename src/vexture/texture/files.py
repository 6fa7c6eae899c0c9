"""Names of a texture's file; writing all files or none."""

import errno
import os
import re
import secrets
from pathlib import Path

from vexture.errors import DeviceError, FormatError
from vexture.layout import PACKED_SUFFIX

__all__ = ["file_name", "is_folder", "read_file", "target_of", "writable", "write_together"]

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


def write_together(files: dict[Path, bytes]) -> None:
    """Write all the files or none, in folders that are made where they are missing.

    Each is written under a temporary name beside its place; when all are complete they are moved.

    Raises
    ------
    DeviceError
        If the disk refuses.
    """
    files = {path.resolve(): data for path, data in files.items()}  # links are not replaced, but what they stand for
    token = secrets.token_hex(4)
    temporary = {path: path.with_name(f".{path.name}.{token}.tmp") for path in files}
    made: list[Path] = []
    try:
        for path, data in files.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            with temporary[path].open("xb") as file:
                made.append(temporary[path])
                file.write(data)
        for path in files:  # seen before anything is replaced
            if path.is_dir():
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
            if path.exists() and not path.is_file():
                raise OSError(errno.EINVAL, "not a regular file")
        for place, path in enumerate(files):
            made[place] = made[place].replace(path)
    except BaseException as error:
        for file_made in made:
            file_made.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise DeviceError(f"{path}: cannot be written ({error.strerror}); choose another place") from None
        raise


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
