"""Names of shapes, and of their files."""

import hashlib
import unicodedata
from typing import Final

from vexture.base.errors import LimitError

MOST_BYTES: Final = 100
OTHERS: Final = frozenset(" ._-")
CATEGORIES: Final = ("L", "M", "N")
"""Unicode categories: letters, their marks, and digits."""


def checked_name(name: str) -> str:
    """Return a valid name of a shape in Unicode normal form NFC.

    It has at most 100 bytes. Each part between slashes consists of letters, digits, spaces and ``._-``; it does not
    start with a dot, and does not start or end with a space. Other names raise a `LimitError`.

    Examples
    --------
    >>> checked_name("kaart van Delft")
    'kaart van Delft'
    >>> checked_name("flood/00")
    'flood/00'
    >>> checked_name("../etc/passwd")
    Traceback (most recent call last):
    vexture.base.errors.LimitError: name '../etc/passwd': it must not start with a dot; choose another name
    """
    normal = unicodedata.normalize("NFC", name[: 4 * MOST_BYTES])
    shown = ascii(name if len(name) <= MOST_BYTES else name[:MOST_BYTES] + "...")
    if not normal:
        raise LimitError("the name is empty; choose one of letters and digits")
    if len(normal.encode(errors="replace")) > MOST_BYTES or len(name) > 4 * MOST_BYTES:
        raise LimitError(f"name {shown}: it is longer than {MOST_BYTES} bytes; choose a shorter one")
    for part in normal.split("/"):
        _check_part(part, shown)
    return normal


def _check_part(part: str, display_name: str) -> None:
    if not part:
        raise LimitError(f"name {display_name}: nothing stands before, after or between slashes; choose another name")
    if part[0] == ".":
        raise LimitError(f"name {display_name}: it must not start with a dot; choose another name")
    if part != part.strip(" "):
        raise LimitError(f"name {display_name}: it must not start or end with a space; choose another name")
    for letter in part:
        if letter not in OTHERS and unicodedata.category(letter)[0] not in CATEGORIES:
            raise LimitError(f"name {display_name}: {letter!a} is not a letter, a digit, a space or one of '._-'")


def manifest_name(name: str) -> str:
    """Return the file name of a shape's manifest, valid on every file system.

    Examples
    --------
    >>> manifest_name("duck")
    '2d2370db2447ff8cf4f3accd68c85aa1.json'
    """
    return hashlib.sha256(name.encode()).hexdigest()[:32] + ".json"
