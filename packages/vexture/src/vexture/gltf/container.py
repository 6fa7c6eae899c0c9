"""Files of glTF 2.0, .gltf and .glb, as JSON and bytes; unknown content is kept unchanged.

No library is used: Python libraries read a model into their own classes, and write only what these support.
"""

import json
import math
import re
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from vexture.base.content import BYTE_ORDER_MARK
from vexture.base.errors import LimitError, SourceError

MAGIC: Final = b"glTF"
VERSION: Final = 2
HEADER: Final = struct.Struct("<4sII")
CHUNK: Final = struct.Struct("<I4s")
JSON_CHUNK: Final = b"JSON"
BINARY_CHUNK: Final = b"BIN\0"
LARGEST_GLB: Final = 2**32 - 1

MOST_NESTED: Final = 128
"""Deepest nesting of objects and lists in a model; exporters write about ten levels."""

REMEDY: Final = "export the model again"

INDENTED: Final = re.compile(r"\s*\{\s*?\n([ \t]+)\"")
"""Start of an indented .gltf, with the white space of one level."""


@dataclass(frozen=True, slots=True, eq=False)
class Container:
    """The contents of a model's file; the document is never changed in place."""

    document: dict[str, Any]
    binary: bytes | None = None  # content of the first buffer of a .glb
    others: tuple[tuple[bytes, bytes], ...] = ()  # further chunks of a .glb, for extensions
    indent: str | None = None  # indentation of a .gltf
    is_glb: bool = False


def parse(content: bytes) -> Container:
    """Read a .glb or a .gltf, recognized by its content.

    Raise a `SourceError` if it is damaged, or is not glTF 2.0.
    """
    if content.startswith(MAGIC):
        chunks = list(_chunks(content))
        if not chunks or chunks[0][0] != JSON_CHUNK:
            raise SourceError(f"its first chunk is not JSON; {REMEDY}")
        rest = chunks[1:]
        binary = rest.pop(0)[1] if rest and rest[0][0] == BINARY_CHUNK else None
        return Container(_document(chunks[0][1]), binary, tuple(rest), is_glb=True)
    if not content.removeprefix(BYTE_ORDER_MARK).lstrip().startswith(b"{"):
        raise SourceError("is no glTF; give a .glb or a .gltf of glTF 2.0")
    indented = INDENTED.match(content[:256].removeprefix(BYTE_ORDER_MARK).decode(errors="replace"))
    return Container(_document(content), indent=indented[1] if indented else None)


def _chunks(content: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yield the type and content of each chunk of a .glb."""
    if len(content) < HEADER.size:
        raise SourceError(f"breaks off after {len(content)} bytes; {REMEDY}")
    _, version, length = HEADER.unpack_from(content)
    if version != VERSION:
        raise SourceError(f"is glTF {version}; vexture reads glTF {VERSION}; {REMEDY}")
    if not HEADER.size <= length <= len(content):
        raise SourceError(f"its header says {length} bytes, and it has {len(content)}; {REMEDY}")
    at = HEADER.size
    while at < length:
        if length - at < CHUNK.size:
            raise SourceError(f"breaks off in the head of a chunk at {at}; {REMEDY}")
        size, kind = CHUNK.unpack_from(content, at)
        at += CHUNK.size
        if size > length - at:
            raise SourceError(f"its chunk at {at} says {size} bytes, and {length - at} are left; {REMEDY}")
        yield kind, content[at : at + size]
        at += size


def _document(text: bytes) -> dict[str, Any]:
    """Parse the JSON of a model."""
    try:
        document = json.loads(text.decode("utf-8-sig"), parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        raise SourceError(f"its JSON cannot be read ({_short(error)}); {REMEDY}") from None
    if not isinstance(document, dict):
        raise SourceError(f"its JSON is no object; {REMEDY}")
    for value in values(document):
        if isinstance(value, float) and not math.isfinite(value):
            raise SourceError(f"its JSON has a number that is too large; {REMEDY}")
    asset = document.get("asset")
    version = asset.get("version") if isinstance(asset, dict) else None
    if not isinstance(version, str) or version.partition(".")[0] != str(VERSION):
        raise SourceError(f"asset.version is {version!r:.40}; vexture reads glTF {VERSION}.0; {REMEDY}")
    return document


def values(document: Any) -> Iterator[Any]:
    """Yield all values in a document, including those in objects and lists.

    Raise a `SourceError` if they are nested too deeply to be written again.
    """
    level = [document]
    for _ in range(MOST_NESTED):
        yield from level
        inner = (each.values() if isinstance(each, dict) else each for each in level if isinstance(each, dict | list))
        level = [value for group in inner for value in group]
    if level:
        raise SourceError(f"its JSON is nested deeper than {MOST_NESTED} levels; {REMEDY}")


def objects_in(document: dict[str, Any], name: str) -> list[dict[str, Any]]:
    """Return a list of objects at the top level of a document; empty if there is none."""
    found = document.get(name, [])
    if not isinstance(found, list) or not all(isinstance(one, dict) for one in found):
        raise SourceError(f"{name} is no list of objects; {REMEDY}")
    return found


def _refuse_constant(name: str) -> None:
    raise ValueError(f"{name} is no number of JSON")


def _short(error: Exception) -> str:
    return "nested too deep" if isinstance(error, RecursionError) else str(error)[:80]


def pad(content: bytes, filler: bytes = b"\0") -> bytes:
    """Pad content to a multiple of four bytes."""
    return content + filler * (-len(content) % 4)


def to_gltf(document: dict[str, Any], indent: str | None = None) -> bytes:
    """Return the contents of a .gltf."""
    separators = (",", ":") if indent is None else (",", ": ")
    text = json.dumps(document, ensure_ascii=False, allow_nan=False, indent=indent, separators=separators)
    try:
        return text.encode()
    except UnicodeEncodeError:  # an unpaired surrogate, which JSON can escape but UTF-8 cannot encode
        return json.dumps(document, allow_nan=False, indent=indent, separators=separators).encode()


def to_glb(container: Container) -> bytes:
    """Return the contents of a .glb; raise a `LimitError` if its header cannot store the length."""
    chunks = [(JSON_CHUNK, pad(to_gltf(container.document), b" "))]
    if container.binary is not None:
        chunks.append((BINARY_CHUNK, pad(container.binary)))
    chunks += container.others
    length = HEADER.size + sum(CHUNK.size + len(content) for _, content in chunks)
    if length > LARGEST_GLB:
        raise LimitError(f"the model would have {length} bytes, and a .glb has at most {LARGEST_GLB}; write a .gltf")
    parts = [HEADER.pack(MAGIC, VERSION, length)]
    for kind, content in chunks:
        parts += [CHUNK.pack(len(content), kind), content]
    return b"".join(parts)
