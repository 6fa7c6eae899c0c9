"""`vexture serve`: the shapes of a folder, for readers and publishers."""

from collections.abc import Callable, Sequence
from contextlib import closing, suppress
from dataclasses import replace
from pathlib import Path

from starlette.routing import Route

from vexture.base.errors import DeviceError, format_count
from vexture.pages.page_routes import page_routes
from vexture.server.converter import BusyError, Converter
from vexture.server.folder import Folder
from vexture.server.limits import Limits
from vexture.server.listen import background, bind, listen, serve_until_stopped
from vexture.server.publish_file import PUBLISHED_PARAMETERS
from vexture.server.routes import application, routes
from vexture.server.tokens import read_token
from vexture.server.uploads import publishing_routes


def serve(
    path: Path,
    token_file: Path | None,
    host: str,
    port: int,
    limits: Limits,
    precision: float | None,
    fonts: Sequence[Path] | None,
    report: Callable[[str], None],
) -> None:
    """Serve a folder until Ctrl-C or SIGTERM; without a token nothing can be published.

    `precision` and `fonts` are for conversions; `report` gets lines for the user, first the server's address.
    """
    token = None if token_file is None else read_token(token_file)
    with closing(bind(host, port)) as server_socket:
        is_new = not path.exists()
        folder = Folder(path, limits, report)
        waiting = len(folder.drawings)
        converter = Converter(limits, replace(PUBLISHED_PARAMETERS, precision=precision, fonts=fonts))

        async def start() -> None:
            with suppress(BusyError):
                await converter.warm()
                await folder.take_drawings(converter)
                if waiting:
                    report(f"{path}: {format_count(len(folder.names), 'shape')}")

        app = application(
            [*routes(folder), *publishing_routes(folder, converter, limits, token), *_page()],
            limits,
            lifespan=background(start),
        )

        def stop() -> None:
            folder.close()
            converter.close()

        shapes = f"{format_count(len(folder.names), 'shape')} of " if folder.names or not waiting else ""
        to_read = f", with {format_count(waiting, 'file')} to read," if waiting else ""
        report(f"serving {shapes}{path}{to_read} at {listen(server_socket)}")
        if is_new:
            report(f"{path}: there was no such folder, so it was created")
        try:
            serve_until_stopped(app, server_socket, stop, limits)
        finally:
            folder.release()


def _page() -> list[Route]:
    """Return the routes of the viewer's page, if it is built."""
    with suppress(DeviceError):
        return page_routes()
    return []
