"""A site with pages that convert drawings: the package as a bundler makes it, under the policies of its folders."""

import functools
import http.server
import shutil
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from build_wasm import OUTPUT
from chromium import WEB, bundle

PAGES = Path(__file__).parent / "pages"
TRUSTED = "require-trusted-types-for 'script'"

POLICY = "default-src 'self'; style-src 'unsafe-inline'"
"""A policy without 'wasm-unsafe-eval'."""

POLICIES = {"strict": POLICY, "trusted": TRUSTED, "distrusted": f"{TRUSTED}; trusted-types other"}
"""Policies of the folders of the site."""

HEAD = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">'
SCRIPT = '<script type="module" src="page.js"></script>'
LOGO = '<div style="color: #00f"><svg id="logo" viewBox="0 0 9 9"><path fill="currentColor" d="M1 1h5v5z"/></svg></div>'


def svg(body: str, root: str = 'viewBox="0 0 9 9"') -> str:
    """Markup of a drawing."""
    return f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>'


RED = svg('<path fill="#f00" d="M1 1h5v5z"/>')


class Site:
    """Folder of a page, its address, and the paths that were requested of its server."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.address = folder, ""
        self.paths: list[str] = []

    def handler(self) -> Any:
        """Class of handlers of its requests."""
        site = self

        class Handler(http.server.SimpleHTTPRequestHandler):
            extensions_map = {".js": "text/javascript", ".wasm": "application/wasm", "": "text/html"}  # noqa: RUF012

            def do_GET(self) -> None:
                site.paths.append(self.path)
                super().do_GET()

            def end_headers(self) -> None:
                self.send_header("Cache-Control", "no-store")
                folder = self.path.split("/")[1]
                if folder in POLICIES:
                    self.send_header("Content-Security-Policy", POLICIES[folder])
                super().end_headers()

            def log_message(self, *arguments: object) -> None:
                """Log nothing."""

        return functools.partial(Handler, directory=str(self.folder))


@contextmanager
def served_site(folder: Path) -> Iterator[Site]:
    """Serve a site whose bundles lie in folders: some have policies, `lost` has no worker, `bare` no WebAssembly."""
    if not all((OUTPUT / f"{name}.wasm").is_file() for name in ("silhouettes", "maps", "strokes")):
        pytest.skip("no kernels (make wasm)")
    shutil.copytree(OUTPUT, folder / "kernels")
    usual = folder / "usual"
    bundle(PAGES / "convert.js", usual / "page.js")
    bundle(WEB / "src" / "convert" / "worker.js", usual / "worker.js")
    (usual / "index.html").write_text(HEAD + LOGO + SCRIPT, encoding="utf-8")
    (usual / "red.svg").write_text(RED, encoding="utf-8")
    for name in ("strict", "trusted", "distrusted", "lost", "bare"):
        shutil.copytree(usual, folder / name)
    (folder / "lost" / "worker.js").unlink()
    (folder / "bare" / "index.html").write_text(f"{HEAD}<script>delete WebAssembly</script>{SCRIPT}", encoding="utf-8")
    one = Site(folder)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), one.handler())
    threading.Thread(target=server.serve_forever, daemon=True).start()
    one.address = f"http://127.0.0.1:{server.server_port}"
    try:
        yield one
    finally:
        server.shutdown()
        server.server_close()


def open_folder(context: Any, site: Site, name: str) -> Any:
    """Open the page of a folder; in `urls` is all that it requests, in `failures` errors that nothing caught."""
    opened = context.new_page()
    opened.urls, opened.failures = [], []
    opened.on("request", lambda request: opened.urls.append(request.url))
    opened.on("pageerror", lambda error: opened.failures.append(str(error)))
    opened.goto(f"{site.address}/{name}/")
    opened.wait_for_function("window.outcome")
    return opened


def converted(page: Any, source: str, options: str = "{}", value: Any = None) -> dict[str, Any]:
    """Outcome of converting a source, which is an expression; `value` is there as `text`."""
    found: dict[str, Any] = page.evaluate(f"async (text) => outcome(convert({source}, {options}))", value)
    return found
