"""The viewer's page with shapes inside, assembled from the bundle."""

import base64
import json
import subprocess
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from chromium import WEB

FIT = 0.9  # of the canvas's shorter side is the unit square at zoom 1 (web/viewer/view.js)

PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>vexture</title><link rel="icon" href="data:,">
<style>{css}</style>
<div id="app"></div>
<script type="application/json" id="vexture-scene">{scene}</script>
<script type="module">{script}</script>
</html>
"""


def data_url(media_type: str, content: bytes) -> str:
    """Content as an address of its own."""
    return f"data:{media_type};base64,{base64.b64encode(content).decode()}"


def manifest(texture: Any, **more: Any) -> dict[str, Any]:
    """What the page is told of a packed texture."""
    content = texture.to_ktx2()
    url = data_url("image/ktx2", content)
    return {
        "name": texture.name,
        "version": "1",
        "texture": url,
        "bytes": len(content),
        "facts": {},
        "views": {},
    } | more


def thesis_view(texture: Any, folder: Path) -> list[str]:
    """Thesis pair of a manifest's views."""
    texture.save(folder / texture.name)
    return [data_url("image/png", (folder / f"{texture.name}.{part}.png").read_bytes()) for part in ("quads", "curves")]


@cache
def built() -> tuple[str, str]:
    """Script and style of the page, as they are now; the built ones may be those of an earlier day."""
    entries = ["viewer/main.js", "viewer/viewer.css"]
    with tempfile.TemporaryDirectory() as folder:
        command = ["node_modules/.bin/esbuild", *entries, "--bundle", "--format=esm", f"--outdir={folder}"]
        outcome = subprocess.run(command, cwd=WEB, capture_output=True, text=True, check=False)
        assert outcome.returncode == 0, outcome.stderr
        script, style = (Path(folder, name).read_text(encoding="utf-8") for name in ("main.js", "viewer.css"))
    return script, style


def write_page(path: Path, *manifests: dict[str, Any], scene: dict[str, Any] | None = None) -> Path:
    """Write the page, with shapes in it."""
    text = json.dumps(scene or {"shapes": manifests}).replace("<", "\\u003c")
    script, css = built()
    script = script.replace("</script", "<\\/script")
    path.write_text(PAGE.format(css=css, scene=text, script=script), encoding="utf-8")
    return path


def view_matrix(center: tuple[float, float], zoom: float, size: tuple[int, int]) -> NDArray[np.float64]:
    """From pixels, y down, to the unit square, of what the page shows."""
    side = 1.0 / (zoom * FIT * min(size))
    u, v = center
    return np.array([[side, 0.0, u - side * size[0] / 2], [0.0, -side, v + side * size[1] / 2]])
