"""HTML pages: served by a server, or saved in one file that needs no server."""

import base64
import hashlib
import html
import json
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any, Final, NamedTuple

from vexture.base.errors import DeviceError, ParameterError, VextureError
from vexture.server.publish_file import THESIS_BITS, thesis_pair
from vexture.server.published import PublishedFile, PublishedShape, manifest


class Bundle(NamedTuple):
    """Names of a page's files, which `make viewer` builds in the folder ``built`` of a package."""

    script: str
    style: str
    package: str = "vexture.pages"


VIEWER: Final = Bundle("viewer.js", "viewer.css")
SCRIPT, STYLE = VIEWER.script, VIEWER.style

SERVED_SCENE: Final[Mapping[str, Any]] = {"server": "./"}
"""Data of a served page: the address of its server."""

LICENCES: Final = "LICENSES.txt"
"""Licences of the packages in the bundles; most require a copy wherever their code is."""

PNG_TYPE: Final = "image/png"
SUFFIXES: Final = (".html", ".htm")

SERVED_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""Content security policy of a served page, which may fetch only from its own server."""

EXPORTED_POLICY = (
    "default-src 'none'; script-src {script}; style-src 'unsafe-inline'; img-src data: blob:; "
    "connect-src data: blob:; base-uri 'none'; form-action 'none'"
)
"""Content security policy of a page in one file, which may fetch only its own content."""

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
{licences}{script}
</body>
</html>
"""


def built(name: str, package: str = VIEWER.package) -> bytes:
    """Read a file that `make viewer` builds in a package; raise a `DeviceError` if it is not built."""
    try:
        return files(package).joinpath("built", name).read_bytes()
    except OSError:
        raise DeviceError(
            "the pages are not built; run `make viewer` in the repository (needs node and npm), or install a wheel, "
            "which holds them"
        ) from None


def check_output(output: Path, bundle: Bundle) -> None:
    """Check, before anything is converted, that a page is built and that its output is named as a page."""
    if output.suffix.lower() not in SUFFIXES:
        raise ParameterError(f"`output` {output}: the page is an HTML file; name one that ends in {SUFFIXES[0]}")
    built(bundle.script, bundle.package)


def served_page(bundle: Bundle = VIEWER, scene: Mapping[str, Any] = SERVED_SCENE, title: str = "vexture") -> bytes:
    """Return a page for a server, with its script and style in separate files."""
    return _page(
        title=title,
        policy="",
        style=f'<link rel="stylesheet" href="{bundle.style}">',
        scene=scene,
        licences="",
        script=f'<script type="module" src="{bundle.script}"></script>',
    )


def exported_page(shapes: Sequence[PublishedShape], title: str) -> bytes:
    """Return the viewer's page with the textures, sources and both thesis encodings of shapes embedded."""
    manifests = [manifest(shape, None, _embedded_pairs(shape), address=data_address) for shape in shapes]
    return whole_page(VIEWER, {"shapes": manifests}, title)


def whole_page(bundle: Bundle, scene: Mapping[str, Any], title: str) -> bytes:
    """Return a page that contains its script, style and scene, and the licences of their packages."""
    script = _in_html(built(bundle.script, bundle.package).decode())
    style = built(bundle.style, bundle.package).decode().replace("</", "<\\/")
    licences = _in_html(built(LICENCES, bundle.package).decode())
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    policy = EXPORTED_POLICY.format(script=f"'sha256-{digest}'")
    return _page(
        title=title,
        policy=f'<meta http-equiv="Content-Security-Policy" content="{html.escape(policy)}">\n',
        style=f"<style>{style}</style>",
        scene=scene,
        licences=f'<script type="text/plain" id="licences">\n{licences}</script>\n',
        script=f'<script type="module">{script}</script>',
    )


def data_address(file: PublishedFile) -> str:
    """Return the data URL of a file.

    Examples
    --------
    >>> data_address(PublishedFile(b"a", "text/plain", ".txt"))
    'data:text/plain;base64,YQ=='
    """
    return f"data:{file.media_type};base64,{base64.b64encode(file.data).decode()}"


def _embedded_pairs(shape: PublishedShape) -> dict[str, Any]:
    """Return the thesis encodings of a shape, or their errors; empty for a texture without its drawing."""
    if "svg" not in shape.views:
        return {}
    pairs: dict[str, Any] = {}
    for view, bits in THESIS_BITS.items():
        try:
            pairs[view] = [data_address(PublishedFile(data, PNG_TYPE, ".png")) for data in thesis_pair(shape, bits)]
        except VextureError as error:
            pairs[view] = {"error": str(error)}
    return pairs


def _in_html(script: str) -> str:
    r"""Escape a script so that no HTML parser ends it early.

    Examples
    --------
    >>> _in_html('"</script>", "<!--"')
    '"<\\/script>", "<\\x21--"'
    """
    return script.replace("</script", "<\\/script").replace("<!--", "<\\x21--")


def _page(*, title: str, policy: str, style: str, scene: Mapping[str, Any], licences: str, script: str) -> bytes:
    text = json.dumps(scene, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    page = PAGE.format(
        title=html.escape(title), policy=policy, style=style, scene=text, licences=licences, script=script
    )
    return page.encode()
