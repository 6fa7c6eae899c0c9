"""The life of a server: its socket, its background work, and its stop within a second."""

import asyncio
import logging
import resource
import signal
import socket
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import AbstractAsyncContextManager, asynccontextmanager, suppress
from typing import Any, Final, TypeAlias

import uvicorn
from starlette.types import ASGIApp

from vexture.base.errors import DeviceError, ParameterError
from vexture.server.connections import ACCEPTED, InPieces, connections
from vexture.server.limits import Limits, Pace

WAITING: Final = 2048
"""Length of the queue of connections that wait to be accepted."""

STOP_SECONDS: Final = 1

Lifespan: TypeAlias = Callable[[Any], AbstractAsyncContextManager[None]]


def bind(host: str, port: int) -> socket.socket:
    """Reserve a port before any other work; clients are refused until `listen`.

    Raises
    ------
    DeviceError
        If the address cannot be used, usually because another server listens there.
    ParameterError
        If the number is not a valid port.

    Examples
    --------
    >>> with bind("127.0.0.1", 0) as first:
    ...     listen(first).startswith("http://127.0.0.1:")
    True
    """
    try:  # no port here: getaddrinfo would take it modulo 2^16
        family, kind, protocol, _, where = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)[0]
        server_socket = socket.socket(family, kind, protocol)
    except OSError as error:
        raise DeviceError(f"host {host}: {error.strerror}; choose another `host`") from None
    try:
        server_socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        server_socket.bind((where[0], port, *where[2:]))
    except OverflowError:
        server_socket.close()
        raise ParameterError(f"`port` is {port}; it must be 0 to 65535") from None
    except OSError as error:
        server_socket.close()
        raise _unusable(host, port, error) from None
    return server_socket


def listen(server_socket: socket.socket) -> str:
    """Let clients connect once everything is ready; return the URL of the server.

    Raises
    ------
    DeviceError
        If another server took the port at the same time.
    """
    host, port = server_socket.getsockname()[:2]
    try:
        server_socket.listen(WAITING)
    except OSError as error:
        raise _unusable(host, port, error) from None
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"


def _unusable(host: str, port: int, error: OSError) -> DeviceError:
    line = f"port {port} on {host} cannot be used ({error.strerror}); stop the other server or choose another `port`"
    return DeviceError(line)


def background(work: Callable[[], Coroutine[Any, Any, None]]) -> Lifespan:
    """Return the context of a server that runs `work` in the background and cancels it at its stop."""

    @asynccontextmanager
    async def lifespan(_app: Any) -> AsyncIterator[None]:
        task = asyncio.create_task(work())
        try:
            yield
        finally:
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task

    return lifespan


class _Server(uvicorn.Server):
    """A server that ends its open streams when it stops; otherwise it would wait for them."""

    def __init__(self, config: uvicorn.Config, stop: Callable[[], None]) -> None:
        super().__init__(config)
        self._stop = stop

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        for server_socket in sockets or ():
            server_socket.listen(
                WAITING
            )  # the event loop has shortened the queue to the number that it accepts at once

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._stop()
        logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)  # interrupted uploads are not errors
        await super().shutdown(sockets)


class _Few(logging.Filter):
    """Filter that drops repeated log lines, so that no client can fill the disk with them."""

    def __init__(self) -> None:
        super().__init__()
        self._pace = Pace(rate=1 / 60, burst=3)

    def filter(self, record: logging.LogRecord) -> bool:
        kind = record.exc_info[0] if record.exc_info else None
        return not self._pace.wait(f"{record.name} {kind} {record.getMessage()[:100]}")


def serve_until_stopped(app: ASGIApp, server_socket: socket.socket, stop: Callable[[], None], limits: Limits) -> None:
    """Serve until Ctrl-C or SIGTERM; then call `stop`, which ends streams and conversions, and wait for the clients."""
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    with suppress(ValueError, OSError):  # each client needs a file descriptor
        resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))

    errors = logging.StreamHandler()
    errors.addFilter(_Few())
    logging.basicConfig(handlers=[errors], format="%(message)s")
    config = uvicorn.Config(
        InPieces(app),
        http=connections(limits),
        backlog=ACCEPTED,
        log_config=None,
        log_level="error",  # lower levels only complain about clients, which get the message
        access_log=False,
        server_header=False,
        ws="none",
        timeout_graceful_shutdown=STOP_SECONDS,
    )
    server = _Server(config, stop)

    def end(*_: Any) -> None:
        """Stop the server on an early signal. Uvicorn handles later ones; its later repeat of them is harmless."""
        server.should_exit = True

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)
    try:
        with suppress(KeyboardInterrupt):
            server.run(sockets=[server_socket])
    finally:
        stop()  # a server that is stopped during its start does not shut down
