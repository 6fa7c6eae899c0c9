"""`vexture view` and `vexture export`: files on a server that shows them, or in one page that holds them."""

import os
import sys
import threading
import webbrowser
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TypeAlias

from vexture.base.apart import each_apart
from vexture.base.errors import EXPECTED, LimitError, ParameterError, VextureError
from vexture.base.notes import Note, check_losses
from vexture.conversion.parameters import Parameters
from vexture.conversion.reading import content_of
from vexture.server.publish_file import shape_of
from vexture.server.published import Shape, Shelf
from vexture.server.watch import Source, named, watch

__all__ = ["export", "view"]

Say = Callable[[str], None]
"""Takes a line for the user."""

Made: TypeAlias = tuple[bytes, Shape]


def export(
    paths: Sequence[Path], output: Path, title: str | None, parameters: Parameters, say: Say, *, strict: bool = False
) -> int:
    """Write one page that shows files and needs nothing else; return its size.

    Raise a `SourceError` if nothing can be drawn of a file, or with `strict` if anything cannot.
    """
    from vexture.pages.page import VIEWER, check_output, exported_page
    from vexture.texture.files import write_together

    check_output(output, VIEWER)
    shapes = []
    for source, (_, shape) in zip(sources := named(paths), map(_checked, _converted(sources, parameters)), strict=True):
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
    from vexture.pages.page_routes import DROPPED, dropping_routes, page_routes, thesis_addresses, thesis_routes
    from vexture.server.converter import Converter
    from vexture.server.listen import background, bind, listen, serve_until_stopped
    from vexture.server.routes import application, routes

    page = page_routes()
    with bind(host, port) as taken:
        shelf, converter = Shelf(), Converter(DROPPED, parameters)

        async def convert(source: Source, data: bytes) -> Shape:
            given = (data, str(source.path), source.name, parameters, source.path.parent)
            return await converter.run(shape_of, *given, about=str(source.path), seconds=parameters.max_seconds)

        async def follow() -> None:
            await converter.warm()
            await watch(shelf, sources, convert, seen)

        def stop() -> None:
            shelf.close()
            converter.close()

        sources = named(paths)
        seen = _published(shelf, sources, parameters, say)
        app = application(
            [
                *page,
                *routes(shelf, thesis_addresses),
                *thesis_routes(shelf, converter),
                *dropping_routes(shelf, converter, frozenset(source.name for source in sources)),
            ],
            DROPPED,
            only_at=host,
            lifespan=background(follow) if watching else None,
        )
        where = listen(taken)
        show(where, len(shelf.names))
        if opening and _has_display():
            threading.Thread(target=webbrowser.open, args=(where,), daemon=True).start()
        serve_until_stopped(app, taken, stop, DROPPED)


def _published(shelf: Shelf, sources: Sequence[Source], parameters: Parameters, say: Say) -> dict[str, bytes | None]:
    """Publish files; return the content of each, or None if it cannot be published."""
    seen: dict[str, bytes | None] = {}
    for source, result in zip(sources, _converted(sources, parameters), strict=True):
        seen[source.name] = None
        try:
            seen[source.name], shape = _checked(result)
        except EXPECTED as error:
            if len(sources) == 1:
                raise
            say(str(error))
            shelf.refuse(source.name, str(error))
            continue
        _say_warnings(shape, say)
        shelf.put(shape)
    if not shelf.names:
        raise LimitError(f"none of the {len(sources)} files can be shown; correct one of them")
    return seen


def _converted(sources: Sequence[Source], parameters: Parameters) -> Iterator["Made | VextureError | ParameterError"]:
    """What `_made` makes of each source, in another process; or why it cannot."""
    items = [(source, parameters) for source in sources]
    return each_apart(_made, items, [str(source.path) for source in sources], parameters.max_seconds)


def _made(source: Source, parameters: Parameters) -> Made:
    """The content of a source, and its shape."""
    data = content_of(source.path)
    return data, shape_of(data, str(source.path), source.name, parameters, source.path.parent)


def _checked(result: "Made | VextureError | ParameterError") -> Made:
    """What was made; raises the error if it was not."""
    if isinstance(result, EXPECTED):
        raise result
    return result


def _say_warnings(shape: Shape, say: Say) -> None:
    for warning in shape.facts["warnings"]:
        say(f"warning: {warning}")


def _has_display() -> bool:
    """Whether a browser has somewhere to appear; a text browser would take the terminal."""
    return sys.platform in ("darwin", "win32") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
