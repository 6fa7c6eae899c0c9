"""Routes of every server: the list of shapes, their manifests and files, the stream of changes, the description."""

import asyncio
import hashlib
import ipaddress
import json
import unicodedata
from collections.abc import AsyncIterator, Callable, Iterable, Mapping
from dataclasses import asdict
from functools import lru_cache
from importlib.resources import files
from typing import Any, Final, TypeAlias
from urllib.parse import urlsplit

from starlette.applications import Starlette
from starlette.convertors import PathConvertor, register_url_convertor
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.middleware.cors import CORSMiddleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response, StreamingResponse
from starlette.routing import Match, Route
from starlette.types import ASGIApp, Receive, Scope, Send

from vexture.server.limits import Limits
from vexture.server.listen import Lifespan
from vexture.server.published import Event, PublishedShape, PublishedShapes, manifest

DESCRIPTION: Final = "/openapi.json"
"""Address of the description."""


def description(routes: Iterable[Route], limits: Limits) -> bytes:
    """Describe a server to authors of clients; raise a `KeyError` if ``openapi.json`` lacks one of its routes."""
    document = json.loads(files("vexture.server").joinpath("openapi.json").read_bytes())
    paths: dict[str, dict[str, Any]] = {DESCRIPTION: document["paths"][DESCRIPTION]}
    for route in routes:
        item = document["paths"][route.path_format]
        methods = [method.lower() for method in route.methods or () if method != "HEAD"]
        path = paths.setdefault(route.path_format, {"parameters": item.get("parameters", [])})
        path.update({method: item[method] for method in methods})
    document["paths"] = paths
    document["info"]["x-limits"] = asdict(limits)
    return json.dumps(document, indent=1).encode()


PING_SECONDS: Final = 15
"""Interval of pings in a stream; a proxy closes a stream that is silent for long."""

TOLD: Final = 256
"""Shapes in one part of the first event, so that a slow client costs no copy of all shapes."""

FOREVER: Final = "public, max-age=31536000, immutable"
SVG_POLICY: Final = "sandbox; default-src 'none'; style-src 'unsafe-inline'"
NO_SNIFFING: Final = {"X-Content-Type-Options": "nosniff"}

Views: TypeAlias = Callable[[PublishedShape], Mapping[str, Any]]
"""Function that returns further entries of a manifest besides the shape's files, relative to the manifest."""

OTHER_ORIGINS: Final = Middleware(
    CORSMiddleware,
    allow_origins=["*"],
    allow_methods=["GET", "HEAD"],
    allow_headers=["If-None-Match", "Cache-Control", "Last-Event-ID"],
    expose_headers=["ETag"],
    max_age=86400,
)
"""Headers that allow pages of other origins to read."""


class _Any(PathConvertor):
    """Any rest of a path; Starlette's own convertor refuses line breaks, and drops one at the end."""

    regex = "(?s:.*)"


register_url_convertor("any", _Any())


class KnownHosts:
    """Answers only requests to an IP address, ``localhost`` or the name of this server.

    A hostile page can make its own name stand for this machine (DNS rebinding). It would then have the same origin as
    the viewer and could read drawings. It cannot have the same origin as an IP address.
    """

    def __init__(self, app: ASGIApp, name: str) -> None:
        self.app = app
        self.names = {"localhost", name.lower()}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] == "http":
            host = dict(scope["headers"]).get(b"host", b"").decode("latin-1")
            if not self.knows(host):
                answer = refusal(421, f"host {host[:100]!r} is not this server; open it by the address that it printed")
                await answer(scope, receive, send)
                return
        await self.app(scope, receive, send)

    def knows(self, host: str) -> bool:
        """Return whether a ``Host`` header names this server.

        Examples
        --------
        >>> known = KnownHosts(None, "studio")
        >>> [known.knows(host) for host in ("127.0.0.1:80", "[::1]:80", "Studio", "evil.example:80", "")]
        [True, True, True, False, False]
        """
        try:
            name = urlsplit(f"//{host}").hostname or ""
            return name in self.names or bool(ipaddress.ip_address(name))
        except ValueError:
            return False


def application(
    listed: list[Route], limits: Limits, *, only_at: str | None = None, lifespan: Lifespan | None = None
) -> Starlette:
    """Make an application from routes; it describes itself, and its errors are JSON.

    With `only_at` it answers only requests to this host name or to the machine itself (`KnownHosts`). Otherwise it
    answers all requests, and pages of other origins may read.
    """
    described = fixed_route(DESCRIPTION, description(listed, limits), "application/json", {"Cache-Control": "no-cache"})
    app = Starlette(
        routes=[*listed, described],
        middleware=[OTHER_ORIGINS if only_at is None else Middleware(KnownHosts, name=only_at)],
        lifespan=lifespan,
        exception_handlers={HTTPException: _http_error, Exception: _server_error},
    )
    app.router.redirect_slashes = False  # it would redirect to a host that the client names
    return app


def refusal(status: int, line: str, headers: Mapping[str, str] | None = None) -> JSONResponse:
    """Answer with one line that gives the reason of a refusal."""
    return JSONResponse({"error": line}, status, {"Cache-Control": "no-store", **(headers or {})})


async def _http_error(request: Request, error: Exception) -> Response:
    """Answer in JSON to requests that the framework refuses."""
    assert isinstance(error, HTTPException)
    if error.status_code == 405:
        found = [route for route in request.app.routes if route.matches(request.scope)[0] is not Match.NONE]
        allowed = sorted(set().union(*(route.methods for route in found)))  # Starlette names those of one route
        return refusal(405, f"{request.method} is not possible here", {"Allow": ", ".join(allowed)})
    line = f"{request.url.path}: there is nothing here" if error.status_code == 404 else error.detail
    return refusal(error.status_code, line, error.headers)


async def _server_error(request: Request, error: Exception) -> Response:
    """Answer that the server failed; the traceback goes to its log only."""
    return refusal(500, f"the server failed ({type(error).__name__}); its log says more")


def fixed_route(path: str, content: bytes, media_type: str, headers: Mapping[str, str]) -> Route:
    """Make the route of a content that never changes while the server runs."""
    return current_route(path, lambda: content, media_type, headers)


def current_route(path: str, content: Callable[[], bytes], media_type: str, headers: Mapping[str, str]) -> Route:
    """Make the route of a changing content; the digest of an object is computed once."""
    digest = lru_cache(1)(lambda found: hashlib.sha256(found).hexdigest()[:32])

    async def answer(request: Request) -> Response:
        found = content()
        tagged = {"ETag": f'"{digest(found)}"', **headers}
        return _not_modified(request, tagged) or Response(found, media_type=media_type, headers=tagged)

    return Route(path, answer)


def levels_below(request: Request) -> int:
    """Count the levels of a manifest's address below ``shapes/``, as written by the client.

    The slash in ``flood/00`` starts a level; ``%2F`` in its place does not.
    """
    name = request.path_params["name"]
    return int(name.count("/")) - bytes(request.scope.get("raw_path") or b"").lower().count(b"%2f")


def routes(published: PublishedShapes, views: Views = lambda shape: {}) -> list[Route]:
    """Make the routes for reading published shapes; their manifests also contain the result of `views`."""

    async def shapes(request: Request) -> Response:
        listed = _shape_list(tuple(published.names))
        return Response(listed, media_type="application/json", headers={"Cache-Control": "no-cache"})

    async def one(request: Request) -> Response:
        name = unicodedata.normalize("NFC", request.path_params["name"])
        shape = published.shape(name)
        if shape is None:
            return refusal(404, f"no shape {name[:100]!r}; /shapes lists the names")
        note = published.notes.get(name)
        headers = {"ETag": entity_tag(shape.version, note), "Cache-Control": "no-cache"}
        body = manifest(shape, note, views(shape), levels=levels_below(request))
        return _not_modified(request, headers) or JSONResponse(body, headers=headers)

    async def file(request: Request) -> Response:
        name = request.path_params["name"]
        found = published.file(name)
        if found is None:
            return refusal(404, f"no file {name[:100]!r}; the manifest of its shape names the newest")
        headers = {"ETag": f'"{name}"', "Cache-Control": FOREVER, **NO_SNIFFING}
        if found.media_type.startswith("image/svg"):
            headers["Content-Security-Policy"] = SVG_POLICY
        return _not_modified(request, headers) or Response(found.data, media_type=found.media_type, headers=headers)

    async def events(request: Request) -> Response:
        headers = {"Cache-Control": "no-cache", "X-Accel-Buffering": "no", "Content-Type": "text/event-stream"}
        if request.method != "HEAD":
            return StreamingResponse(stream(published), headers=headers)
        answer = Response(headers=headers)
        del answer.headers["Content-Length"]  # the length of a stream is unknown
        return answer

    return [
        Route("/shapes", shapes),
        Route("/shapes/{name:any}", one),
        Route("/files/{name}", file),
        Route("/events", events),
    ]


@lru_cache(1)
def _shape_list(names: tuple[str, ...]) -> bytes:
    """Encode the list of shapes, once for many clients."""
    return json.dumps({"shapes": names}, ensure_ascii=False, separators=(",", ":")).encode()


async def stream(published: PublishedShapes) -> AsyncIterator[bytes]:
    """Yield all versions and notes, so that a client that reconnects catches up, and then the changes.

    The versions form one event, sent in parts. A change between two parts follows as an event of its own.
    """
    with published.events() as listener:
        yield b'event: hello\r\ndata: {"versions":{'
        names, separator = published.names, ""
        for start in range(0, len(names), TOLD):
            if versions := published.versions(names[start : start + TOLD]):
                yield f"{separator}{json.dumps(versions, separators=(',', ':'))[1:-1]}".encode()
                separator = ","
        yield b"}}\r\n\r\n"
        for name, message in published.notes.items():
            yield Event("note", {"name": name, "message": message}).sent
        while True:
            try:
                async with asyncio.timeout(PING_SECONDS):
                    change = await listener.next()
            except TimeoutError:
                yield b": still here\r\n\r\n"
                continue
            if change is None:
                return
            yield change.sent


def entity_tag(version: str, note: str | None) -> str:
    """Return the entity tag of a manifest: its version, and a digest of the note."""
    return f'"{version}"' if note is None else f'"{version}-{hashlib.sha256(note.encode()).hexdigest()[:8]}"'


def _not_modified(request: Request, headers: Mapping[str, str]) -> Response | None:
    """Return a 304 answer if the client already has the content of this ``ETag``, else None."""
    known = is_known(headers["ETag"], request.headers.get("if-none-match", ""))
    return Response(status_code=304, headers=headers) if known else None


def is_known(tag: str, header: str) -> bool:
    """Return whether ``If-None-Match`` contains a tag (RFC 9110, 13.1.2: weak comparison).

    Examples
    --------
    >>> is_known('"a"', 'W/"a", "b"'), is_known('"a"', "*"), is_known('"a"', "")
    (True, True, False)
    """
    tags = [part.strip().removeprefix("W/") for part in header.split(",")]
    return tag in tags or tags == ["*"]
