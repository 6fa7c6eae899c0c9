"""Resources of a model outside its JSON: the bytes of its buffers, and files next to it."""

import binascii
import os
import re
from base64 import b64decode, b64encode
from dataclasses import replace
from pathlib import Path
from typing import Any, Final
from urllib.parse import unquote

from vexture.base.content import LARGEST_FILE, picture_size
from vexture.base.errors import SourceError, printable, shorten_text
from vexture.gltf.container import REMEDY, Container, objects_in, pad, values

KTX2_TYPE: Final = "image/ktx2"
BYTES_TYPE: Final = "application/octet-stream"

OUTSIDE: Final = re.compile(r"[a-z][a-z0-9+.-]*:|[/\\]", re.IGNORECASE)
"""Start of an address that is not a file next to the model."""

DATA: Final = re.compile(r"data:[^,]*;base64,", re.IGNORECASE)

SHOWN: Final = 40
"""Longest file name in a message, in characters."""


def data_uri(content: bytes, media_type: str) -> str:
    """Return a data URL with the content."""
    return f"data:{media_type};base64,{b64encode(content).decode()}"


def files_beside(document: dict[str, Any]) -> list[str]:
    """Return all addresses in a document that are not data URLs."""
    found = (value.get("uri") for value in values(document) if isinstance(value, dict))
    return [uri for uri in found if isinstance(uri, str) and uri[:5].lower() != "data:"]


def with_view(container: Container, content: bytes) -> tuple[Container, int | None]:
    """Append bytes to the first buffer; return the index of their view, too, or None if that buffer is elsewhere."""
    buffers, binary = objects_in(container.document, "buffers"), container.binary or b""
    is_ours = container.binary is not None and "uri" not in buffers[0] if buffers else not binary
    if not is_ours:
        return container, None
    before = pad(binary)
    views = objects_in(container.document, "bufferViews")
    view = {"buffer": 0, "byteOffset": len(before), "byteLength": len(content)}
    first = (buffers[0] if buffers else {}) | {"byteLength": len(before) + len(content)}
    document = container.document | {"buffers": [first, *buffers[1:]], "bufferViews": [*views, view]}
    return replace(container, document=document, binary=before + content), len(views)


def pack(container: Container, folder: Path | None) -> Container:
    """Embed the files next to a model, as for a .glb.

    Raise a `SourceError` if a file is missing, is not next to the model or below, or is used by an unknown extension.
    """
    document = dict(container.document)
    buffers = [dict(buffer) for buffer in objects_in(document, "buffers")]
    binary = container.binary
    for place, buffer in enumerate(buffers):
        if place == 0 and binary is None and isinstance(buffer.get("uri"), str):
            binary = content_at(buffer.pop("uri"), folder)
        elif _is_beside(buffer):
            buffer["uri"] = data_uri(content_at(buffer["uri"], folder), BYTES_TYPE)
    if buffers:
        document["buffers"] = buffers
    result = replace(container, document=document, binary=binary, is_glb=True, indent=None)
    images = [dict(image) for image in objects_in(document, "images")]
    for image in images:
        if _is_beside(image):
            content = content_at(image["uri"], folder)
            media_type = image.get("mimeType") or _image_type(content, image["uri"])
            result, view = with_view(result, content)
            del image["uri"]
            image |= {"bufferView": view, "mimeType": media_type} if view is not None else {
                "uri": data_uri(content, media_type)
            }  # fmt: skip
    if images:
        result = replace(result, document=result.document | {"images": images})
    if left := files_beside(result.document):
        raise SourceError(f"an extension of it refers to the file {_label(left[0])}; write a .gltf beside it")
    return result


def _is_beside(owner: dict[str, Any]) -> bool:
    return bool(files_beside({"uri": owner.get("uri")}))


def _image_type(content: bytes, uri: str) -> str:
    size = picture_size(content)
    if size is not None:
        return f"image/{size[0].lower()}"
    if content.startswith(b"\xabKTX 20"):
        return KTX2_TYPE
    raise SourceError(f"the file {_label(uri)} is no picture that a model can hold; write a .gltf beside it")


def content_at(uri: str, folder: Path | None) -> bytes:
    """Return the content of a file next to the model or below, or of a data URL."""
    if uri[:5].lower() == "data:":
        start = DATA.match(uri)
        if start is None:
            raise SourceError(f"the address {_label(uri)} is not base64; {REMEDY}")
        try:
            return b64decode(uri[start.end() :], validate=True)
        except (binascii.Error, ValueError):
            raise SourceError(f"the address {_label(uri)} is no base64; {REMEDY}") from None
    path = unquote(uri)
    if folder is None or OUTSIDE.match(path) or "\0" in path or ".." in re.split(r"[/\\]", path):
        raise SourceError(f"it refers to {_label(uri)}, and only files beside it or in folders there are read")
    inside = folder.resolve()
    try:
        file = (inside / path).resolve()
        if not file.is_relative_to(inside):
            raise SourceError(f"it refers to {_label(uri)}, which leads out of its folder; put the file there")
        with file.open("rb") as opened:
            content = opened.read(LARGEST_FILE + 1)
    except OSError as error:
        raise SourceError(
            f"its file {_label(uri)} cannot be read ({error.strerror}); put it beside the model"
        ) from None
    if len(content) > LARGEST_FILE:
        raise SourceError(f"its file {_label(uri)} is larger than {LARGEST_FILE:,} bytes; write a .gltf beside it")
    return content


def missing_file(container: Container, folder: Path | None, target: Path) -> str:
    """Return the name of a file that a model would miss in the folder of a target; empty if there is none."""
    left = files_beside(container.document)
    is_elsewhere = folder is None or folder.resolve() != target.absolute().parent.resolve()
    return _label(left[0]) if left and is_elsewhere else ""


def _label(uri: str) -> str:
    return printable(shorten_text(os.fspath(uri), SHOWN))
