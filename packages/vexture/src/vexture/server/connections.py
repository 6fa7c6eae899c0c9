"""Connections of a server: their number, the time limits for their peers, and the way to refuse them."""

import asyncio
import json
import resource
import sys
from collections.abc import Callable
from functools import partial
from http import HTTPStatus
from typing import Any, Final, cast

import h11
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from vexture.server.limits import Limits

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
