"""What clients are told of a shape."""

from collections.abc import Callable, Mapping
from typing import Any

from vexture.live.shelf import File, Shape

__all__ = ["manifest"]


def served_address(file: File) -> str:
    """Where a server has a file, relative to the manifest."""
    return f"../files/{file.name}"


def manifest(
    shape: Shape,
    note: str | None,
    views: Mapping[str, Any],
    *,
    address: Callable[[File], str] = served_address,
    events: str | None = "../events",
) -> dict[str, Any]:
    """Describe a shape, ready for JSON.

    Parameters
    ----------
    shape : Shape
    note : str or None
        Why its last update was refused, if it was.
    views : mapping
        What it can be compared with beside its own files.
    address : callable
        Gives the address of each of its files, relative to the manifest's own.
    events : str or None
        Address of the stream of changes.
    """
    return {
        "name": shape.name,
        "version": shape.version,
        "texture": address(shape.texture),
        "bytes": len(shape.texture.data),
        "events": events,
        "facts": dict(shape.facts),
        "views": {what: address(file) for what, file in shape.views.items()} | dict(views),
        "note": note,
    }
