"""Connections of a server: how many there may be, how long each waits for its peer, and how it is refused."""

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
"""Descriptors that are no connections: files, conversions, what is being accepted or refused."""

ACCEPTED: Final = 8
"""Connections that the event loop accepts at once: what it accepts before it counts them stays within the reserve."""

LINGERING: Final = 32
"""Connections above the limit that are told so at one time; further ones are cut off."""

LINGER_SECONDS: Final = 2.0
LINGER_BYTES: Final = 2**20
"""What a refused peer still sends is read so long, up to so much: it would otherwise lose the answer."""

HEAD_BYTES: Final = 2**14
TOO_LONG: Final = HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE

PIECE_BYTES: Final = 2**16
"""Part of an answer that is handed to a connection at once. With what it buffers, it keeps about twice as much."""


def connections(limits: Limits) -> type[asyncio.Protocol]:
    """Protocol of connections, as many as the limits and this process's descriptors allow."""
    most, files = limits.connections, resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    if files != resource.RLIM_INFINITY:
        most = min(most, files - min(RESERVE, files // 2))
    return cast(type[asyncio.Protocol], partial(_Connection, limits=limits, most=most))


class _Strict(h11.Connection):
    """Refuses a head that came at once and is too long, and a body whose length is said twice.

    A proxy before the server may believe the other length, and so see other requests (RFC 9112, 6.3).
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
    """One connection. It is cut off when its peer neither asks nor takes what it asked for in time."""

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
        """Let the peer have some seconds from now on, or any time."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None if seconds is None else self.loop.call_later(seconds, late or self.transport.abort)

    def _unless_asked(self) -> None:
        """Once a request is here, wait for the server, or for a peer that does not take the answer before."""
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
        self._unless_asked()  # by a request that came before its turn

    def _without_request(self) -> None:
        """Give a peer up that has not sent the head of a request, or not taken the last answer."""
        if self.conn.our_state is not h11.IDLE or self.transport.get_write_buffer_size():
            self.transport.abort()
        elif self.conn.trailing_data[0]:
            self._refuse(408, f"the head took longer than {self._limits.head_seconds:g} s; try again")
        else:
            self.transport.close()

    def send_400_response(self, msg: str) -> None:
        """Refuse what is no request, as the parser has just raised."""
        error = sys.exception()
        if isinstance(error, h11.RemoteProtocolError) and error.error_status_hint == TOO_LONG:
            self._refuse(TOO_LONG, f"the head is longer than {HEAD_BYTES} bytes, the limit here; send fewer headers")
        else:
            self._refuse(400, f"this is no request of HTTP/1.1 ({error or msg}); correct it")

    def _refuse(self, status: int, line: str) -> None:
        """Answer with one line and close, late enough for a peer that still sends to read it."""
        if self.conn.our_state not in (h11.IDLE, h11.SEND_RESPONSE):  # an answer is on its way
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
    """Hands long contents to a connection in pieces, which share the content: a slow reader costs no copy of it."""

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
