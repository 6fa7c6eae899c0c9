"""`vexture view` and `vexture export`: files on a server that shows them, or in one page that holds them."""

import os
import sys
import threading
import webbrowser
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from vexture.errors import EXPECTED, LimitError
from vexture.live.documents import shape_of
from vexture.live.shelf import Shape, Shelf
from vexture.live.watch import Source, named, watch
from vexture.notes import Note, check_losses
from vexture.parameters import Parameters
from vexture.reading import content_of

__all__ = ["export", "view"]

Say = Callable[[str], None]
"""Takes a line for the user."""


def export(
    paths: Sequence[Path], output: Path, title: str | None, parameters: Parameters, say: Say, *, strict: bool = False
) -> int:
    """Write one page that shows files and needs nothing else; return its size.

    Raise a `SourceError` if nothing can be drawn of a file, or with `strict` if anything cannot.
    """
    from vexture.live.page import VIEWER, check_output, exported_page
    from vexture.texture.files import write_together

    check_output(output, VIEWER)
    shapes = []
    for source in named(paths):
        shape = _converted(source, content_of(source.path), parameters)
        notes = [Note(note["kind"], note["message"], note["count"]) for note in shape.facts["notes"]]
        check_losses(str(source.path), notes, is_empty=shape.facts["segments"] == 0, strict=strict)
        _say_warnings(shape, say)  # an error says them itself
        shapes.append(shape)
    page = exported_page(shapes, title or ", ".join(shape.name for shape in shapes))
    write_together({output: page})
    return len(page)


def view(
    paths: Sequence[Path],
    parameters: Parameters,
    *,
    host: str,
    port: int,
    watching: bool,
    opening: bool,
    say: Say,
    show: Callable[[str, int], None],
) -> None:
    """Serve files to browsers until Ctrl-C, and convert them again when they change if `watching`.

    `say` takes warnings and errors for the user, `show` the address and the number of shapes.
    """
    from vexture.live.listen import background, bind, listen, serve_until_stopped
    from vexture.live.page_routes import DROPPED, dropping_routes, page_routes, thesis_addresses, thesis_routes
    from vexture.live.routes import application, routes

    page = page_routes()
    with bind(host, port) as taken:
        shelf = Shelf()
        sources = named(paths)
        seen = _published(shelf, sources, parameters, say)
        app = application(
            [
                *page,
                *routes(shelf, thesis_addresses),
                *thesis_routes(shelf),
                *dropping_routes(shelf, parameters, frozenset(source.name for source in sources)),
            ],
            DROPPED,
            only_at=host,
            lifespan=background(partial(watch, shelf, sources, parameters, seen)) if watching else None,
        )
        where = listen(taken)
        show(where, len(shelf.names))
        if opening and _has_display():
            threading.Thread(target=webbrowser.open, args=(where,), daemon=True).start()
        serve_until_stopped(app, taken, shelf.close, DROPPED)


def _published(shelf: Shelf, sources: Sequence[Source], parameters: Parameters, say: Say) -> dict[str, bytes | None]:
    """Publish files; return the content of each, or None if it cannot be published."""
    seen: dict[str, bytes | None] = {}
    for source in sources:
        try:
            data = content_of(source.path)
            shape = _converted(source, data, parameters)
            _say_warnings(shape, say)
            shelf.put(shape)
            seen[source.name] = data
        except EXPECTED as error:
            if len(sources) == 1:
                raise
            say(str(error))
            shelf.refuse(source.name, str(error))
            seen[source.name] = None
    if not shelf.names:
        raise LimitError(f"none of the {len(sources)} files can be shown; correct one of them")
    return seen


def _converted(source: Source, data: bytes, parameters: Parameters) -> Shape:
    return shape_of(data, str(source.path), source.name, parameters, source.path.parent)


def _say_warnings(shape: Shape, say: Say) -> None:
    for warning in shape.facts["warnings"]:
        say(f"warning: {warning}")


def _has_display() -> bool:
    """Whether a browser has somewhere to appear; a text browser would take the terminal."""
    return sys.platform in ("darwin", "win32") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
