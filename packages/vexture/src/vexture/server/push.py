"""`vexture push`: one file to a server."""

import json
from http.client import HTTPException
from pathlib import Path
from typing import Final
from urllib.error import HTTPError, URLError
from urllib.parse import quote, unquote, urlsplit, urlunsplit
from urllib.request import Request, urlopen

from vexture.base.errors import DeviceError, ParameterError, VextureError
from vexture.server.names import checked_name

SECONDS: Final = 150.0
"""Time limit, longer than the default limits of a server for reading and converting an upload."""

LONGEST_ANSWER: Final = 2**20
SHAPES: Final = "/shapes"


def push(path: Path, url: str, token: str) -> dict[str, str]:
    """Publish a file on a server, or at ``server/shapes/NAME``; by default the name is the file's without its suffix.

    Return the manifest's address as ``url``, and its ``name``, ``version`` and ``bytes``.
    """
    target = target_of(url, path.stem)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise DeviceError(f"{path}: cannot be read ({error.strerror}); name another file") from None
    # the server recognizes the kind by the content
    headers = {"Authorization": f"Bearer {token}", "Content-Type": "application/octet-stream"}
    try:
        with urlopen(Request(target, data, headers, method="PUT"), timeout=SECONDS) as answer:
            manifest = json.loads(answer.read(LONGEST_ANSWER))
        return {"url": target, **{key: str(manifest[key]) for key in ("name", "version", "bytes")}}
    except HTTPError as error:
        raise _refusal_error(target, error) from None
    except URLError as error:
        raise DeviceError(f"{target}: cannot be reached ({error.reason}); check the address") from None
    except (OSError, HTTPException) as error:
        raise DeviceError(f"{target}: the connection broke off ({error or type(error).__name__}); try again") from None
    except (ValueError, KeyError, TypeError):
        raise DeviceError(f"{target}: what answers is not a vexture server; check the address") from None


def target_of(url: str, stem: str) -> str:
    """Return the address of a shape.

    Examples
    --------
    >>> target_of("http://127.0.0.1:8000", "kaart van Delft")
    'http://127.0.0.1:8000/shapes/kaart%20van%20Delft'
    >>> target_of("https://example.org/maps/shapes/flood/24", "anything")
    'https://example.org/maps/shapes/flood/24'
    """
    try:
        parts = urlsplit(url)
        usable = parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
    except ValueError:
        usable = False
    if not usable or not url.isprintable():
        raise ParameterError(f"{url!r} is not the address of a server; use one such as http://127.0.0.1:8000")
    base, found, name = parts.path.rpartition(f"{SHAPES}/")
    if not found:
        base, name = parts.path.rstrip("/").removesuffix(SHAPES), ""
    name = checked_name(unquote(name) or stem)
    return urlunsplit((parts.scheme, parts.netloc, f"{base}{SHAPES}/{quote(name)}", "", ""))


def _refusal_error(target: str, error: HTTPError) -> VextureError:
    """Turn a server's answer into an error of one line."""
    try:
        line = json.loads(error.read(LONGEST_ANSWER))["error"]
    except (OSError, HTTPException, ValueError, KeyError, TypeError):
        line = error.reason or "no reason is given"
    text = "".join(letter if letter.isprintable() else " " for letter in str(line))[:1000]
    return DeviceError(f"{target}: {text} ({error.code})")
