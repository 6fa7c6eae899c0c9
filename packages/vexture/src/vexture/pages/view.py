"""`vexture view` and `vexture export`: show files on a server, or save them in one page."""

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
from vexture.server.published import PublishedShape, PublishedShapes
from vexture.server.watch import WatchedFile, name_files, watch

Report = Callable[[str], None]
"""Function that gets a line for the user."""

SourceResult: TypeAlias = tuple[bytes, PublishedShape]


def export(
    paths: Sequence[Path],
    output: Path,
    title: str | None,
    parameters: Parameters,
    report: Report,
    *,
    strict: bool = False,
) -> int:
    """Write one self-contained page that shows files; return its size.

    Raise a `SourceError` if a file has nothing that can be drawn, or with `strict` if anything in it cannot be drawn.
    """
    from vexture.pages.page import VIEWER, check_output, exported_page
    from vexture.texture.files import write_together

    check_output(output, VIEWER)
    shapes = []
    for source, (_, shape) in zip(
        sources := name_files(paths), map(_unwrap, _convert_sources(sources, parameters)), strict=True
    ):
        notes = [Note(note["kind"], note["message"], note["count"]) for note in shape.facts["notes"]]
        check_losses(str(source.path), notes, is_empty=shape.facts["segments"] == 0, strict=strict)
        _report_warnings(shape, report)  # an error contains them already
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
    report: Report,
    show: Callable[[str, int], None],
) -> None:
    """Serve files to browsers until Ctrl-C; if `watching`, convert them again when they change.

    `report` gets warnings and errors for the user, `show` the address and the number of shapes.
    """
    from vexture.pages.page_routes import DROPPED, dropping_routes, page_routes, thesis_addresses, thesis_routes
    from vexture.server.converter import Converter
    from vexture.server.listen import background, bind, listen, serve_until_stopped
    from vexture.server.routes import application, routes

    page = page_routes()
    with bind(host, port) as server_socket:
        published, converter = PublishedShapes(), Converter(DROPPED, parameters)

        async def convert(source: WatchedFile, data: bytes) -> PublishedShape:
            given = (data, str(source.path), source.name, parameters, source.path.parent)
            return await converter.run(shape_of, *given, about=str(source.path), seconds=parameters.max_seconds)

        async def follow() -> None:
            await converter.warm()
            await watch(published, sources, convert, seen)

        def stop() -> None:
            published.close()
            converter.close()

        sources = name_files(paths)
        seen = _publish_sources(published, sources, parameters, report)
        app = application(
            [
                *page,
                *routes(published, thesis_addresses),
                *thesis_routes(published, converter),
                *dropping_routes(published, converter, frozenset(source.name for source in sources)),
            ],
            DROPPED,
            only_at=host,
            lifespan=background(follow) if watching else None,
        )
        where = listen(server_socket)
        show(where, len(published.names))
        if opening and _has_display():
            threading.Thread(target=webbrowser.open, args=(where,), daemon=True).start()
        serve_until_stopped(app, server_socket, stop, DROPPED)


def _publish_sources(
    published: PublishedShapes, sources: Sequence[WatchedFile], parameters: Parameters, report: Report
) -> dict[str, bytes | None]:
    """Publish files; return the content of each, or None if it cannot be published."""
    seen: dict[str, bytes | None] = {}
    for source, result in zip(sources, _convert_sources(sources, parameters), strict=True):
        seen[source.name] = None
        try:
            seen[source.name], shape = _unwrap(result)
        except EXPECTED as error:
            if len(sources) == 1:
                raise
            report(str(error))
            published.refuse(source.name, str(error))
            continue
        _report_warnings(shape, report)
        published.add(shape)
    if not published.names:
        raise LimitError(f"none of the {len(sources)} files can be shown; correct one of them")
    return seen


def _convert_sources(
    sources: Sequence[WatchedFile], parameters: Parameters
) -> Iterator["SourceResult | VextureError | ParameterError"]:
    """Convert each source in another process; yield its result, or the error that prevented it."""
    items = [(source, parameters) for source in sources]
    return each_apart(_convert_source, items, [str(source.path) for source in sources], parameters.max_seconds)


def _convert_source(source: WatchedFile, parameters: Parameters) -> SourceResult:
    """Convert a source; return its content and its shape."""
    data = content_of(source.path)
    return data, shape_of(data, str(source.path), source.name, parameters, source.path.parent)


def _unwrap(result: "SourceResult | VextureError | ParameterError") -> SourceResult:
    """Return a result, or raise it if it is an error."""
    if isinstance(result, EXPECTED):
        raise result
    return result


def _report_warnings(shape: PublishedShape, report: Report) -> None:
    for warning in shape.facts["warnings"]:
        report(f"warning: {warning}")


def _has_display() -> bool:
    """Return whether a browser can open a window; a text browser would take over the terminal."""
    return sys.platform in ("darwin", "win32") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
