"""What clients are told of a shape."""

from collections.abc import Callable, Mapping
from typing import Any

from vexture.live.shelf import File, Shape

__all__ = ["manifest"]


def manifest(
    shape: Shape,
    note: str | None,
    views: Mapping[str, Any],
    *,
    levels: int = 0,
    address: Callable[[File], str] | None = None,
) -> dict[str, Any]:
    """Describe a shape, ready for JSON.

    Parameters
    ----------
    shape : Shape
    note : str or None
        Why its last update was refused, if it was.
    views : mapping
        What it can be compared with beside its own files.
    levels : int
        How many levels the manifest's address is below ``shapes/``.
    address : callable, optional
        Gives the address of each of its files where there is no server, and so no stream of changes either.
    """
    top = "../" * (levels + 1)

    def served(file: File) -> str:
        return f"{top}files/{file.name}"

    where = address or served
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
