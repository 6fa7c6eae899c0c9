"""A server from its socket to its end: one line if it cannot start, a clean stop within a second."""

import logging
import resource
import signal
import socket
from collections.abc import Callable
from contextlib import suppress
from typing import Any, Final

import uvicorn
from sse_starlette.sse import AppStatus
from starlette.types import ASGIApp

from vexture.errors import DeviceError, LimitError

__all__ = ["address", "bind", "serve_until_stopped"]

WAITING: Final = 2048
"""Connections that may wait to be accepted."""

STOP_SECONDS: Final = 1


def bind(host: str, port: int) -> socket.socket:
    """Take a port, before anything else is done.

    Raises
    ------
    DeviceError
        If another server has it, or it may not be had.
    LimitError
        If it is no port.

    Examples
    --------
    >>> with bind("127.0.0.1", 0) as first:
    ...     address(first).startswith("http://127.0.0.1:")
    True
    """
    try:
        family, kind, protocol, _, where = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)[
            0
        ]  # it would wrap ports
        taken = socket.socket(family, kind, protocol)
    except OSError as error:
        raise DeviceError(f"host {host}: {error.strerror}; choose another with --host") from None
    try:
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        taken.bind((where[0], port, *where[2:]))
        taken.listen(WAITING)
    except OverflowError:
        taken.close()
        raise LimitError(f"port {port} is none: a port has 16 bits; choose another --port") from None
    except OSError as error:
        taken.close()
        raise DeviceError(
            f"port {port} on {host} cannot be had ({error.strerror}); stop the other server or choose another --port"
        ) from None
    return taken


def address(taken: socket.socket) -> str:
    """Address of the server of a socket, as a browser wants it."""
    host, port = taken.getsockname()[:2]
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"


class _Server(uvicorn.Server):
    """A server that tells its open streams to end when it stops; otherwise they would hold it."""

    def __init__(self, config: uvicorn.Config, stop: Callable[[], None]) -> None:
        super().__init__(config)
        self._stop = stop

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._stop()
        logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)  # uploads that stop with us are no errors
        await super().shutdown(sockets)


def server_of(app: ASGIApp, stop: Callable[[], None]) -> uvicorn.Server:
    """Server of an application; `stop` is called when it is to end, before it waits for its clients."""
    AppStatus.enable_automatic_graceful_drain = False  # it would cut streams off in the middle; `stop` ends them
    config = uvicorn.Config(
        app,
        log_level="warning",
        access_log=False,
        server_header=False,
        ws="none",
        timeout_graceful_shutdown=STOP_SECONDS,
    )
    return _Server(config, stop)


def serve_until_stopped(app: ASGIApp, taken: socket.socket, stop: Callable[[], None]) -> None:
    """Serve until Ctrl-C or SIGTERM.

    Parameters
    ----------
    app : ASGI application
    taken : socket
        From `bind`.
    stop : callable
        Ends the streams; called once when the server is to stop (`Shelf.close`).
    """
    allow_many_connections()

    def ignore(*_: Any) -> None:
        """Uvicorn raises the signal again after it has stopped, which would end in a traceback."""

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, ignore)
    with suppress(KeyboardInterrupt):
        server_of(app, stop).run(sockets=[taken])


def allow_many_connections() -> None:
    """Raise the number of files that may be open, one for each client, as far as the system lets us."""
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    with suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
