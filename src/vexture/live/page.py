"""Pages, the viewer's and the flood's: as a server gives them out, and as one file that needs none."""

import base64
import hashlib
import html
import json
from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import Any, Final, NamedTuple

from vexture.errors import DeviceError, VextureError
from vexture.live.documents import THESIS_BITS, thesis_pair
from vexture.live.manifest import manifest
from vexture.live.shelf import File, Shape

__all__ = [
    "FLOOD",
    "SCRIPT",
    "SERVED_POLICY",
    "STYLE",
    "VIEWER",
    "Bundle",
    "built",
    "data_address",
    "exported_page",
    "served_page",
    "whole_page",
]


class Bundle(NamedTuple):
    """What a page consists of: names of files that `make viewer` makes."""

    script: str
    style: str


SCRIPT, STYLE = VIEWER = Bundle("viewer.js", "viewer.css")
FLOOD: Final = Bundle("flood.js", "flood.css")

SERVED_SCENE: Final[Mapping[str, Any]] = {"server": "./"}
"""What a served page is told: where its server is."""

PNG_TYPE = "image/png"

SERVED_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""What the served page may fetch: nothing from anywhere else."""

EXPORTED_POLICY = (
    "default-src 'none'; script-src {script}; style-src 'unsafe-inline'; img-src data: blob:; "
    "connect-src data: blob:; base-uri 'none'; form-action 'none'"
)
"""What the page in one file may fetch: nothing at all but what is in it."""

PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
{policy}<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{title}</title>
<link rel="icon" href="data:,">
{style}
</head>
<body>
<div id="app"></div>
<noscript>This page draws with JavaScript and WebGL 2; allow scripts to see it.</noscript>
<script type="application/json" id="vexture-scene">{scene}</script>
{script}
</body>
</html>
"""


def built(name: str) -> bytes:
    """One of the files that `make viewer` makes.

    Raises
    ------
    DeviceError
        If it is not made.
    """
    try:
        return files("vexture.live").joinpath("built", name).read_bytes()
    except OSError:
        raise DeviceError(
            "the pages are not built; run `make viewer` in the repository (needs node and npm), or install a wheel, "
            "which holds them"
        ) from None


def served_page(bundle: Bundle = VIEWER, scene: Mapping[str, Any] = SERVED_SCENE, title: str = "vexture") -> bytes:
    """Return the page of a server; its script and style are files beside it."""
    return _page(
        title=title,
        policy="",
        style=f'<link rel="stylesheet" href="{bundle.style}">',
        scene=scene,
        script=f'<script type="module" src="{bundle.script}"></script>',
    )


def exported_page(shapes: Sequence[Shape], title: str) -> bytes:
    """Return the viewer's page with everything in it: textures, sources, and both thesis encodings of each.

    Parameters
    ----------
    shapes : sequence of Shape
    title : str

    Raises
    ------
    DeviceError
        If the page is not built.
    """
    manifests = [manifest(shape, None, _embedded_pairs(shape), address=data_address) for shape in shapes]
    return whole_page(VIEWER, {"shapes": manifests}, title)


def whole_page(bundle: Bundle, scene: Mapping[str, Any], title: str) -> bytes:
    """Return a page that holds its script, its style and its scene.

    Raises
    ------
    DeviceError
        If the page is not built.
    """
    script = _in_html(built(bundle.script).decode())
    style = built(bundle.style).decode().replace("</", "<\\/")
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    policy = EXPORTED_POLICY.format(script=f"'sha256-{digest}'")
    return _page(
        title=title,
        policy=f'<meta http-equiv="Content-Security-Policy" content="{html.escape(policy)}">\n',
        style=f"<style>{style}</style>",
        scene=scene,
        script=f'<script type="module">{script}</script>',
    )


def data_address(file: File) -> str:
    """Address that is the file.

    Examples
    --------
    >>> data_address(File(b"a", "text/plain", ".txt"))
    'data:text/plain;base64,YQ=='
    """
    return f"data:{file.media_type};base64,{base64.b64encode(file.data).decode()}"


def _embedded_pairs(shape: Shape) -> dict[str, Any]:
    """Thesis encodings of a shape, or why there is none; nothing for a texture without its drawing."""
    if "svg" not in shape.views:
        return {}
    pairs: dict[str, Any] = {}
    for view, bits in THESIS_BITS.items():
        try:
            pairs[view] = [data_address(File(data, PNG_TYPE, ".png")) for data in thesis_pair(shape, bits)]
        except VextureError as error:
            pairs[view] = {"error": str(error)}
    return pairs


def _in_html(script: str) -> str:
    r"""Return a script that no HTML parser ends early.

    Examples
    --------
    >>> _in_html('"</script>", "<!--"')
    '"<\\/script>", "<\\x21--"'
    """
    return script.replace("</script", "<\\/script").replace("<!--", "<\\x21--")


def _page(*, title: str, policy: str, style: str, scene: Mapping[str, Any], script: str) -> bytes:
    text = json.dumps(scene, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    parts = {"title": html.escape(title), "policy": policy, "style": style, "scene": text, "script": script}
    return PAGE.format(**parts).encode()
