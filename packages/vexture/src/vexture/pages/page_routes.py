"""Routes of the viewer's server besides its shapes: the page, thesis encodings for comparison, dropped files."""

import asyncio
import unicodedata
from collections import OrderedDict
from collections.abc import Callable, Collection
from functools import cache
from math import inf
from urllib.parse import quote, urlsplit

from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from vexture.base.errors import EXPECTED
from vexture.pages.page import PNG_TYPE, SERVED_POLICY, VIEWER, Bundle, built, served_page
from vexture.server.converter import BusyError, Converter
from vexture.server.limits import Limits
from vexture.server.publish_file import THESIS_BITS, load_thesis, thesis_pair
from vexture.server.published import PublishedShape, PublishedShapes, manifest
from vexture.server.routes import FOREVER, NO_SNIFFING, current_route, fixed_route, refusal
from vexture.server.uploads import read_body
from vexture.texture.registry import find_encoding

DROPPED = Limits(max_bytes=64 * 2**20)
"""Limits of the viewer's server: a dropped file is the user's own, and may be larger."""

MOST_DROPPED = 64
"""Most dropped files that are kept; the oldest is removed."""

MOST_PAIRS = 32
"""Most thesis encodings that are kept, each a few kilobytes."""

MOST_NAME_LENGTH = 200

BUSY = {"Retry-After": "5"}


def page_routes(bundle: Bundle = VIEWER, page: Callable[[], bytes] | None = None) -> list[Route]:
    """Make the routes of a page (from `served_page`; by default the viewer's), its script and its style."""
    common = {"Cache-Control": "no-cache", **NO_SNIFFING, "Referrer-Policy": "no-referrer"}
    policy = {"Content-Security-Policy": SERVED_POLICY}
    return [
        current_route("/", page or cache(lambda: served_page(bundle)), "text/html", common | policy),
        fixed_route(f"/{bundle.script}", built(bundle.script, bundle.package), "text/javascript", common),
        fixed_route(f"/{bundle.style}", built(bundle.style, bundle.package), "text/css", common),
    ]


def thesis_addresses(shape: PublishedShape) -> dict[str, list[str]]:
    """Return the addresses of a shape's thesis encodings, relative to its manifest; none without its drawing."""
    if "svg" not in shape.views:
        return {}
    return {
        view: [f"../views/{shape.version}/{view}{suffix}" for suffix in find_encoding("thesis").SUFFIXES]
        for view in THESIS_BITS
    }


def thesis_routes(published: PublishedShapes, converter: Converter) -> list[Route]:
    """Make the routes of the thesis encodings of published shapes, which are converted on the first request."""
    files = {
        view + suffix: (bits, place)
        for view, bits in THESIS_BITS.items()
        for place, suffix in enumerate(find_encoding("thesis").SUFFIXES)
    }
    pairs: OrderedDict[tuple[str, int], asyncio.Future[tuple[bytes, ...]]] = OrderedDict()

    async def convert_pair(shape: PublishedShape, bits: int) -> tuple[bytes, ...]:
        await converter.run(load_thesis, about=shape.name, seconds=inf)  # a minute that counts for no conversion
        return await converter.run(thesis_pair, shape, bits, about=shape.name)

    async def view(request: Request) -> Response:
        version, name = request.path_params["version"], request.path_params["name"]
        shape = next((one for one in map(published.shape, published.names) if one and one.version == version), None)
        if shape is None or name not in files:
            return refusal(404, f"no view {name[:100]!r} of that version; the manifest of its shape names the newest")
        bits, place = files[name]
        if (version, bits) not in pairs:
            pairs[version, bits] = asyncio.ensure_future(convert_pair(shape, bits))
            if len(pairs) > MOST_PAIRS:
                pairs.popitem(last=False)
        try:
            pair = await asyncio.shield(pairs[version, bits])
        except BusyError as error:
            del pairs[version, bits]
            return refusal(503, str(error), BUSY)
        except EXPECTED as error:
            return refusal(422, str(error))
        return Response(pair[place], media_type=PNG_TYPE, headers={"Cache-Control": FOREVER, **NO_SNIFFING})

    return [Route("/views/{version}/{name}", view)]


def dropping_routes(published: PublishedShapes, converter: Converter, reserved: Collection[str]) -> list[Route]:
    """Make the route that converts a file dropped on the page like an upload, and publishes it.

    The names in `reserved` belong to shapes that must stay: a dropped file with such a name gets another one.
    """
    dropped: OrderedDict[str, None] = OrderedDict()

    async def convert(request: Request) -> Response:
        if not _is_ours(request):
            return refusal(403, "only the viewer's own page may send drawings here")
        file_name = request.query_params.get("name", "").replace("\\", "/").rpartition("/")[2]
        if not file_name or len(file_name) > MOST_NAME_LENGTH or not file_name.isprintable():
            return refusal(422, f"the name of the file must have 1 to {MOST_NAME_LENGTH} characters; rename it")
        name = unicodedata.normalize("NFC", file_name.partition(".")[0]) or "drawing"
        while name in reserved:
            name += " (dropped)"
        try:
            data, size = await read_body(request, DROPPED, DROPPED.max_bytes)
            if size > len(data):
                return refusal(413, f"the file is larger than {DROPPED.max_bytes:,} bytes; name it to `vexture view`")
            with converter.place():
                shape = await converter.shape_of(data, name, file_name)
        except BusyError as error:
            return refusal(503, str(error), BUSY)
        except TimeoutError:
            return refusal(408, f"the file took longer than {DROPPED.upload_seconds:g} s; try again")
        except ClientDisconnect:
            return refusal(400, "the file did not arrive")
        except EXPECTED as error:
            return refusal(422, str(error))
        published.add(shape)
        dropped[name] = None
        dropped.move_to_end(name)
        if len(dropped) > MOST_DROPPED:
            published.remove(dropped.popitem(last=False)[0])
        place = f"shapes/{quote(shape.name, safe='')}"
        return JSONResponse(manifest(shape, None, thesis_addresses(shape)), 201, {"Location": place})

    return [Route("/convert", convert, methods=["POST"])]


def _is_ours(request: Request) -> bool:
    """Return whether a request comes from this server's page, or from a program that is not a browser."""
    if request.headers.get("sec-fetch-site", "same-origin") != "same-origin":
        return False
    origin = request.headers.get("origin")
    return origin is None or urlsplit(origin).netloc == request.headers.get("host")
