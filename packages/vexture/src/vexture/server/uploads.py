"""Uploads of shapes: authorization, limits, and the answers to refused uploads."""

import asyncio
import hmac
from contextlib import suppress
from math import ceil
from typing import Final
from weakref import WeakValueDictionary

from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from vexture.base.errors import EXPECTED, DeviceError, LimitError
from vexture.server.converter import BusyError, Converter
from vexture.server.limited_shapes import FullError, LimitedShapes
from vexture.server.limits import Limits, Pace
from vexture.server.names import checked_name
from vexture.server.published import manifest
from vexture.server.routes import entity_tag, levels_below, refusal
from vexture.server.tokens import WrongTokens

DRAINED: Final = 4
"""Multiple of the size limit up to which a refused body is read: clients do not see an answer while they send."""

DELAY_SECONDS: Final = 1.0
MOST_DELAYED: Final = 100
"""Delay of an answer to a wrong token above the rate limit, and the most such answers that wait at a time."""

CHALLENGE: Final = {"WWW-Authenticate": 'Bearer realm="vexture"'}
WRONG: Final = {"WWW-Authenticate": 'Bearer realm="vexture", error="invalid_token"'}


class _RefusedError(Exception):
    """An upload is refused, with a status and one line."""

    def __init__(self, status: int, line: str, headers: dict[str, str] | None = None) -> None:
        super().__init__(line)
        self.status, self.line, self.headers = status, line, headers


class _WrongTokenError(_RefusedError):
    """A wrong token above the rate limit."""


def publishing_routes(published: LimitedShapes, converter: Converter, limits: Limits, token: str | None) -> list[Route]:
    """Make the routes for publishing shapes with the token; without a token, all uploads are refused."""
    pace, wrong = Pace(limits.rate, limits.burst), WrongTokens()
    delayed = asyncio.Semaphore(MOST_DELAYED)
    turns: WeakValueDictionary[str, asyncio.Lock] = WeakValueDictionary()

    def admit(request: Request) -> str:
        who = request.client.host if request.client else ""
        _check_token(request, token, wrong, who)
        try:
            name = checked_name(request.path_params["name"])
        except LimitError as error:
            raise _RefusedError(400, str(error)) from None
        if wait := pace.wait(who):
            line = f"more than {limits.rate:g} uploads a second; wait {wait:.1f} s"
            raise _RefusedError(429, line, {"Retry-After": str(ceil(wait))})
        return name

    async def upload(request: Request) -> Response:
        try:
            name = admit(request)
        except _RefusedError as error:
            with suppress(TimeoutError, ClientDisconnect):
                await read_body(request, limits, 0)
            if isinstance(error, _WrongTokenError) and not delayed.locked():
                async with delayed:
                    await asyncio.sleep(DELAY_SECONDS)
            return refusal(error.status, error.line, error.headers)
        try:
            data = await _body(request, limits)
            with converter.place():  # only now: a slow sender takes no place
                async with turns.setdefault(name, asyncio.Lock()):  # of several uploads of one name, the last one wins
                    return await publish(name, data, levels_below(request))
        except _RefusedError as error:
            return refusal(error.status, error.line, error.headers)
        except BusyError as error:
            return refusal(503, str(error), {"Retry-After": "5"})

    async def publish(name: str, data: bytes, levels: int) -> Response:
        try:
            shape = await converter.shape_of(data, name)
        except BusyError:
            raise
        except EXPECTED as error:
            if published.shape(name) is not None:
                published.refuse(name, str(error))
            return refusal(422, str(error))
        is_new = published.shape(name) is None
        try:
            await published.publish(shape)
        except (FullError, DeviceError) as error:
            return refusal(507, str(error))
        headers = {"ETag": entity_tag(shape.version, None), "Cache-Control": "no-store"}
        return JSONResponse(manifest(shape, None, {}, levels=levels), 201 if is_new else 200, headers)

    return [Route("/shapes/{name:any}", upload, methods=["PUT"])]


def _check_token(request: Request, token: str | None, wrong: WrongTokens, address: str) -> None:
    if token is None:
        raise _RefusedError(403, "this server takes no uploads; start it with --token-file")
    scheme, _, given = request.headers.get("authorization", "").partition(" ")
    if scheme.lower() != "bearer":
        raise _RefusedError(401, "uploads need the header Authorization: Bearer TOKEN", CHALLENGE)
    if not hmac.compare_digest(given.strip().encode(), token.encode()):
        if wait := wrong.wait(address):
            line = f"the token is wrong, as others were before it; wait {wait:.0f} s, and give the right one"
            raise _WrongTokenError(429, line, {"Retry-After": str(ceil(wait))})
        raise _RefusedError(401, "the token is wrong", WRONG)


async def _body(request: Request, limits: Limits) -> bytes:
    """Read an upload; refuse one that is too large or too slow."""
    most = limits.max_bytes
    length = request.headers.get("content-length", "0")
    too_large = int(length[:20]) > most if length.isdecimal() else True
    try:
        body, size = await read_body(request, limits, 0 if too_large else most)
    except TimeoutError:
        raise _RefusedError(408, f"the upload took longer than {limits.upload_seconds:g} s; try again") from None
    except ClientDisconnect:
        raise _RefusedError(400, "the upload broke off; try again") from None
    if too_large or size > most:
        raise _RefusedError(413, f"the upload is larger than {most} bytes, the limit here; simplify the drawing")
    return body


async def read_body(request: Request, limits: Limits, max_bytes: int) -> tuple[bytes, int]:
    """Read a body; return its content, if it has at most `max_bytes` bytes, and the number of bytes read.

    Raise a `TimeoutError` if that takes too long, and a `ClientDisconnect` if the client stops.
    """
    body, size = bytearray(), 0
    async with asyncio.timeout(limits.upload_seconds):
        async for chunk in request.stream():
            size += len(chunk)
            if size <= max_bytes:
                body += chunk
            elif size > DRAINED * limits.max_bytes:
                break
    return bytes(body), size
