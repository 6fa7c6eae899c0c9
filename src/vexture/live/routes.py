"""What every server answers: the list of shapes, their manifests, their files, and the stream of changes."""

import hashlib
import json
import unicodedata
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import AbstractAsyncContextManager
from typing import Any, Final

from sse_starlette import EventSourceResponse, ServerSentEvent
from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.middleware.cors import CORSMiddleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import BaseRoute, Route

from vexture.live.manifest import manifest
from vexture.live.shelf import Shape, Shelf

__all__ = ["FOREVER", "application", "fixed", "levels_below", "refusal", "routes"]

PING_SECONDS: Final = 15
SEND_SECONDS: Final = 30
"""A client that takes nothing for this long is let go."""

FOREVER: Final = "public, max-age=31536000, immutable"
SVG_POLICY: Final = "sandbox; default-src 'none'; style-src 'unsafe-inline'"

Lifespan = Callable[[Starlette], AbstractAsyncContextManager[None]]

Views = Callable[[Shape], Mapping[str, Any]]
"""What a manifest names beside the files of a shape, relative to the manifest."""


def application(listed: list[BaseRoute], *, open_to_all: bool, lifespan: Lifespan | None = None) -> Starlette:
    """Make routes an application whose errors are JSON.

    Parameters
    ----------
    listed : list of route
    open_to_all : bool
        Whether pages of other origins may read (`GET` only).
    lifespan : callable, optional
        Context in which it runs.
    """
    reading = Middleware(
        CORSMiddleware,
        allow_origins=["*"],
        allow_methods=["GET", "HEAD"],
        allow_headers=["If-None-Match", "Cache-Control", "Last-Event-ID"],
        expose_headers=["ETag"],
        max_age=86400,
    )
    return Starlette(
        routes=listed,
        middleware=[reading] if open_to_all else [],
        lifespan=lifespan,
        exception_handlers={HTTPException: _told, Exception: _failed},
    )


def refusal(status: int, line: str, headers: Mapping[str, str] | None = None) -> JSONResponse:
    """Answer with one line that says why not."""
    return JSONResponse({"error": line}, status, {"Cache-Control": "no-store", **(headers or {})})


async def _told(request: Request, error: Exception) -> Response:
    """Say in JSON what the framework refuses."""
    assert isinstance(error, HTTPException)
    line = f"{request.url.path}: there is nothing here" if error.status_code == 404 else error.detail
    if error.status_code == 405:
        line = f"{request.method} is not possible here"
    return refusal(error.status_code, line, error.headers)


async def _failed(request: Request, error: Exception) -> Response:
    """Answer that the server has a fault; the traceback is in its log, not here."""
    return refusal(500, f"the server failed ({type(error).__name__}); its log says more")


def fixed(path: str, content: bytes, media_type: str, headers: Mapping[str, str]) -> Route:
    """Route of something that never changes while the server runs."""
    tag = f'"{hashlib.sha256(content).hexdigest()[:32]}"'

    async def answer(request: Request) -> Response:
        if is_known(tag, request.headers.get("if-none-match", "")):
            return Response(status_code=304, headers={"ETag": tag, **headers})
        return Response(content, media_type=media_type, headers={"ETag": tag, **headers})

    return Route(path, answer)


def levels_below(request: Request) -> int:
    """How many levels below ``shapes/`` the address of a shape's manifest is, as the client wrote it.

    The slash in ``flood/00`` is a level, and ``%2F`` in its place is none.
    """
    name = request.path_params["name"]
    return int(name.count("/")) - bytes(request.scope.get("raw_path") or b"").lower().count(b"%2f")


def routes(shelf: Shelf, views: Views = lambda shape: {}) -> list[BaseRoute]:
    """Routes to read the shapes of a shelf.

    Parameters
    ----------
    shelf : Shelf
    views : callable
        Gives what a shape's manifest names under ``views`` beside the shape's own files.
    """

    async def shapes(request: Request) -> Response:
        return JSONResponse({"shapes": shelf.names}, headers={"Cache-Control": "no-cache"})

    async def one(request: Request) -> Response:
        name = unicodedata.normalize("NFC", request.path_params["name"])
        shape = shelf.shape(name)
        if shape is None:
            return refusal(404, f"no shape {name[:100]!r}; /shapes lists the names")
        note = shelf.note(name)
        tag = entity_tag(shape.version, note)
        headers = {"ETag": tag, "Cache-Control": "no-cache"}
        if is_known(tag, request.headers.get("if-none-match", "")):
            return Response(status_code=304, headers=headers)
        return JSONResponse(manifest(shape, note, views(shape), levels=levels_below(request)), headers=headers)

    async def file(request: Request) -> Response:
        name = request.path_params["name"]
        found = shelf.file(name)
        if found is None:
            return refusal(404, f"no file {name[:100]!r}; the manifest of its shape names the newest")
        tag = f'"{name}"'
        headers = {"ETag": tag, "Cache-Control": FOREVER, "X-Content-Type-Options": "nosniff"}
        if found.media_type.startswith("image/svg"):
            headers["Content-Security-Policy"] = SVG_POLICY
        if is_known(tag, request.headers.get("if-none-match", "")):
            return Response(status_code=304, headers=headers)
        return Response(found.data, media_type=found.media_type, headers=headers)

    async def events(request: Request) -> Response:
        return EventSourceResponse(
            stream(shelf), ping=PING_SECONDS, send_timeout=SEND_SECONDS, headers={"Cache-Control": "no-cache"}
        )

    return [
        Route("/shapes", shapes),
        Route("/shapes/{name:path}", one),
        Route("/files/{name}", file),
        Route("/events", events),
    ]


async def stream(shelf: Shelf) -> AsyncIterator[ServerSentEvent]:
    """All versions and notes first, so that a client that comes back catches up; then what happens."""
    with shelf.events() as listener:
        yield said("hello", {"versions": shelf.versions})
        for name, message in shelf.notes.items():
            yield said("note", {"name": name, "message": message})
        while (event := await listener.next()) is not None:
            yield said(event.kind, event.data)


def said(kind: str, data: Mapping[str, Any]) -> ServerSentEvent:
    """One event as it is sent."""
    return ServerSentEvent(json.dumps(dict(data), separators=(",", ":")), event=kind)


def entity_tag(version: str, note: str | None) -> str:
    """Tag of a manifest: its version, and what tells one note from another.

    Examples
    --------
    >>> entity_tag("0a", None)
    '"0a"'
    """
    return f'"{version}"' if note is None else f'"{version}-{hashlib.sha256(note.encode()).hexdigest()[:8]}"'


def is_known(tag: str, header: str) -> bool:
    """Whether ``If-None-Match`` names a tag (RFC 9110, 13.1.2: weak comparison).

    Examples
    --------
    >>> is_known('"a"', 'W/"a", "b"'), is_known('"a"', "*"), is_known('"a"', "")
    (True, True, False)
    """
    tags = [part.strip().removeprefix("W/") for part in header.split(",")]
    return tag in tags or tags == ["*"]
