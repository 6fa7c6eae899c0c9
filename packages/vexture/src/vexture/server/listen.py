"""The life of a server: its socket, its background work, and its stop within a second."""

import asyncio
import json
import logging
import resource
import signal
import socket
import sys
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import AbstractAsyncContextManager, asynccontextmanager, suppress
from functools import partial
from http import HTTPStatus
from typing import Any, Final, TypeAlias, cast

import h11
import uvicorn
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from vexture.base.errors import DeviceError, ParameterError
from vexture.server.limits import Limits, Pace

RESERVE: Final = 128
"""File descriptors kept for other uses: files, conversions, and connections being accepted or refused."""

ACCEPTED: Final = 8
"""Connections that the event loop accepts in one go. They are not yet counted, so they must fit the reserve."""

LINGERING: Final = 32
"""Connections above the limit that get a refusal at the same time; further ones are cut off."""

LINGER_SECONDS: Final = 2.0
LINGER_BYTES: Final = 2**20
"""Time and size limits for reading from a refused peer; without reading on, the peer would lose the answer."""

HEAD_BYTES: Final = 2**14
TOO_LONG: Final = HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE

PIECE_BYTES: Final = 2**16
"""Bytes of an answer that are handed to a connection at once. With its buffer, it holds about twice as much."""


def connections(limits: Limits) -> type[asyncio.Protocol]:
    """Return the protocol of connections, limited in number by the limits and by this process's file descriptors."""
    most, files = limits.connections, resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    if files != resource.RLIM_INFINITY:
        most = min(most, files - min(RESERVE, files // 2))
    return cast(type[asyncio.Protocol], partial(_Connection, limits=limits, most=most))


class _Strict(h11.Connection):
    """A parser that refuses too long heads, even if they come at once, and bodies with two lengths.

    A proxy in front of the server may use the other length, and would then see other requests (RFC 9112, 6.3).
    """

    def next_event(self) -> Any:
        event = super().next_event()
        if isinstance(event, h11.Request):
            if {b"content-length", b"transfer-encoding"} <= dict(event.headers).keys():
                raise h11.RemoteProtocolError("Content-Length and Transfer-Encoding exclude each other")
            if len(event.target) + sum(len(name) + len(value) for name, value in event.headers) > HEAD_BYTES:
                raise h11.RemoteProtocolError("too long", error_status_hint=TOO_LONG)
        return event


class _Connection(H11Protocol):
    """A connection that is cut off if its peer is too slow to send a request or to read the answer."""

    def __init__(self, *given: Any, limits: Limits, most: int, **named: Any) -> None:
        super().__init__(*given, **named)
        self.conn = _Strict(h11.SERVER, HEAD_BYTES)
        self._limits, self._most = limits, most
        self._timer: asyncio.TimerHandle | None = None
        self._refused = False
        self._discarded = 0

    @property
    def _answers(self) -> bool:
        return self.cycle is not None and not self.cycle.response_complete and not self._refused

    def _wait(self, seconds: float | None, late: Callable[[], None] | None = None) -> None:
        """Give the peer a number of seconds from now on, or unlimited time."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None if seconds is None else self.loop.call_later(seconds, late or self.transport.abort)

    def _unless_asked(self) -> None:
        """Stop the clock once a request has arrived, unless the peer is slow to read the answer."""
        if self._answers:
            self._wait(self._limits.stall_seconds if self.flow.write_paused else None)

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # as in uvicorn
        super().connection_made(transport)
        self._wait(self._limits.head_seconds, self._without_request)
        above = len(self.connections) - self._most
        if above > LINGERING:
            transport.abort()
        elif above > 0:
            self._refuse(503, f"{self._most} connections are open, the limit here; try again later")

    def connection_lost(self, exc: Exception | None) -> None:
        self._wait(None)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        if self._refused:
            self._discarded += len(data)
            if self._discarded > LINGER_BYTES:
                self.transport.abort()
            return
        answered = self._answers
        super().data_received(data)
        if not answered:
            self._unless_asked()

    def pause_writing(self) -> None:
        super().pause_writing()
        self._wait(self._limits.stall_seconds)

    def resume_writing(self) -> None:
        super().resume_writing()
        self._unless_asked()

    def on_response_complete(self) -> None:
        tail = self._limits.stall_seconds if self.transport.get_write_buffer_size() else 0.0
        self._wait(self._limits.head_seconds + tail, self._without_request)
        super().on_response_complete()
        self._unless_asked()  # the next request may already have arrived

    def _without_request(self) -> None:
        """Close a connection whose peer has not sent the head of a request, or not read the last answer."""
        if self.conn.our_state is not h11.IDLE or self.transport.get_write_buffer_size():
            self.transport.abort()
        elif self.conn.trailing_data[0]:
            self._refuse(408, f"the head took longer than {self._limits.head_seconds:g} s; try again")
        else:
            self.transport.close()

    def send_400_response(self, msg: str) -> None:
        """Refuse input that is not a request, for which the parser has just raised an error."""
        error = sys.exception()
        if isinstance(error, h11.RemoteProtocolError) and error.error_status_hint == TOO_LONG:
            self._refuse(TOO_LONG, f"the head is longer than {HEAD_BYTES} bytes, the limit here; send fewer headers")
        else:
            self._refuse(400, f"this is no request of HTTP/1.1 ({error or msg}); correct it")

    def _refuse(self, status: int, line: str) -> None:
        """Answer with one line; close late enough for a peer that is still sending to read it."""
        if self.conn.our_state not in (h11.IDLE, h11.SEND_RESPONSE):  # an answer has begun
            self.transport.abort()
            return
        self._refused = True
        if self.cycle is not None:
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        body = json.dumps({"error": line}).encode()
        head = (
            f"HTTP/1.1 {status} {HTTPStatus(status).phrase}\r\nContent-Type: application/json\r\n"
            f"Content-Length: {len(body)}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n"
        )
        self.transport.write(head.encode() + body)
        self.transport.write_eof()
        self.flow.resume_reading()
        self._wait(LINGER_SECONDS)

    def shutdown(self) -> None:
        if self._refused:
            self.transport.abort()
        else:
            super().shutdown()


class InPieces:
    """Middleware that sends large contents in pieces that share memory, so that a slow reader costs no copy."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on."""

        async def in_pieces(message: Message) -> None:
            body = message.get("body", b"")
            last = len(body) - len(body) % PIECE_BYTES
            for start in range(0, last, PIECE_BYTES):
                await send({**message, "body": body[start : start + PIECE_BYTES], "more_body": True})
            await send({**message, "body": body[last:]} if last else message)

        await self._app(scope, receive, in_pieces)


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
