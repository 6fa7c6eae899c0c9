"""A real browser with WebGL 2 on Mesa's llvmpipe, a server for its pages, and bundles of JavaScript for them."""

import functools
import http.server
import os
import shutil
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

ROOT: Final = Path(__file__).parents[3]
WEB: Final = ROOT / "web"

CHROMIUM: Final = shutil.which("chromium") or "/usr/bin/chromium"
FLAGS: Final = [
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-gl=angle",
    "--use-angle=gl-egl",
    "--ignore-gpu-blocklist",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--force-color-profile=srgb",
    "--hide-scrollbars",
]

ENTRIES: Final = ("globe", "gltf", "maplibre", "react", "text", "thesis", "water", "webgpu")
"""Entries of the npm package beside the main one."""


@contextmanager
def chromium(*flags: str) -> Iterator[Any]:
    """Run the browser, with further flags, and yield it."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as started:
        browser = started.chromium.launch(executable_path=CHROMIUM, args=[*FLAGS, *flags])
        try:
            yield browser
        finally:
            browser.close()


class _Quiet(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".js": "text/javascript"}  # noqa: RUF012

    def log_message(self, *arguments: object) -> None:
        """Log nothing."""


@contextmanager
def serve_folder(folder: Path) -> Iterator[str]:
    """Serve a folder, and yield its address without a slash at the end."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(_Quiet, directory=str(folder)))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        server.server_close()


def bundle(entry: Path, output: Path, three: str = "three", *, is_split: bool = False) -> None:
    """Bundle a module with all that it imports; `three` is the package that stands for three.js.

    What it imports later is part of the one file or, if split, in files of their own beside it.

    The entry's ``import ... from "vexture"`` is the package in web/, and so are its other entries. What web/ has
    installed is found from anywhere.
    """
    esbuild = WEB / "node_modules" / ".bin" / "esbuild"
    # HarfBuzz imports `module` in Node.js alone
    command = [str(esbuild), str(entry), "--bundle", "--format=esm", "--external:module"]
    if is_split:
        command += ["--splitting", f"--outdir={output.parent}", f"--entry-names={output.stem}"]
    else:
        command += [f"--outfile={output}"]
    command += [f"--alias:vexture={WEB / 'src' / 'index.js'}"]
    command += [f"--alias:vexture/{name}={WEB / 'src' / name / 'index.js'}" for name in ENTRIES]
    command += [f"--alias:three={WEB / 'node_modules' / three}"]
    build = WEB / "node_modules" / three / "build"
    command += [f"--alias:three/{name}={build / f'three.{name}.js'}" for name in ("webgpu", "tsl")]
    command += [f"--alias:three/addons={WEB / 'node_modules' / three / 'examples' / 'jsm'}", "--jsx=automatic"]
    found = os.environ | {"NODE_PATH": str(WEB / "node_modules")}
    outcome = subprocess.run(command, cwd=WEB, env=found, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
