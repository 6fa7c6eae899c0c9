"""A JupyterLab of its own, and a notebook in it: run its cells, and ask its kernel."""

import ast
import json
import os
import secrets
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from guides import free_port

PATIENCE = 60
"""Seconds that a server may take to answer."""

QUIET = (
    "--no-browser",
    "--allow-root",
    "--ServerApp.ip=127.0.0.1",
    "--LabApp.expose_app_in_browser=True",
    "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    "--LabApp.extension_manager=readonly",
    "--ServerApp.jpserver_extensions={'jupyter_lsp': False, 'jupyter_server_terminals': False}",
)
"""No window, no news, no network; and the application where scripts find it."""

WITHOUT = (
    *("audio", "celltags", "completer", "console", "csvviewer", "debugger", "extensionmanager", "help", "htmlviewer"),
    *("hub", "imageviewer", "inspector", "javascript", "json", "logconsole", "lsp", "markdownviewer", "mathjax"),
    *("mermaid", "metadataform", "pdf", "pluginmanager", "running", "terminal", "toc", "tooltip", "vega5", "video"),
)
"""Extensions of JupyterLab."""

KERNEL = {"name": "python3", "display_name": "Python 3", "language": "python"}

RUN = """async (cell) => {
  const { shell, commands } = jupyterapp;
  shell.currentWidget.content.activeCellIndex = cell;
  await commands.execute('notebook:run-cell');
}"""
ASK = """async (expression) => {
  const { kernel } = jupyterapp.shell.currentWidget.sessionContext.session;
  const { content } = await kernel.requestExecute({ code: '', user_expressions: { value: expression } }).done;
  const { value } = content.user_expressions;
  return value.status === 'ok' ? value.data['text/plain'] : `${value.ename}: ${value.evalue}`;
}"""
READY = "jupyterapp.shell.currentWidget?.sessionContext?.session?.kernel?.status === 'idle'"


def write_notebook(path: Path, cells: tuple[str, ...]) -> None:
    """A notebook of some cells."""
    import nbformat

    made = [nbformat.v4.new_code_cell(cell) for cell in cells]
    nbformat.write(nbformat.v4.new_notebook(cells=made, metadata={"kernelspec": KERNEL}), path)


@contextmanager
def jupyter_lab(folder: Path, notebook: str) -> Iterator[str]:
    """Address of a JupyterLab that serves a folder, with a kernel for a notebook in it."""
    own = {f"JUPYTER_{kind}_DIR": str(folder / ".jupyter" / kind.lower()) for kind in ("CONFIG", "DATA", "RUNTIME")}
    token = secrets.token_hex()
    _configure(folder / ".jupyter" / "config")
    environment = {**os.environ, **own, "IPYTHONDIR": str(folder / ".jupyter" / "ipython"), "JUPYTER_TOKEN": token}
    address = f"http://127.0.0.1:{(port := free_port())}"
    command = [sys.executable, "-m", "jupyterlab", *QUIET, f"--ServerApp.port={port}", f"--ServerApp.root_dir={folder}"]
    with (folder / "server.log").open("w") as log:
        server = subprocess.Popen(command, env=environment, stderr=log)
        try:
            _until_it_answers(f"{address}/api/status?token={token}", folder / "server.log", server)
            session = {"path": notebook, "name": notebook, "type": "notebook", "kernel": {"name": KERNEL["name"]}}
            kernel = _request(f"{address}/api/sessions?token={token}", session)["kernel"]["id"]
            yield f"{address}/lab/tree/{notebook}?token={token}"
            _request(f"{address}/api/kernels/{kernel}?token={token}", method="DELETE")
        finally:
            server.kill()
            server.wait()


def _configure(folder: Path) -> None:
    """No question about news, and no parts that a notebook of widgets does without: they take seconds."""
    settings = folder / "lab" / "user-settings" / "@jupyterlab" / "apputils-extension"
    settings.mkdir(parents=True)
    (settings / "notification.jupyterlab-settings").write_text('{"fetchNews": "false"}')
    (folder / "labconfig").mkdir()
    without = {f"@jupyterlab/{name}-extension": True for name in WITHOUT}
    (folder / "labconfig" / "page_config.json").write_text(json.dumps({"disabledExtensions": without}))


def _until_it_answers(address: str, log: Path, server: subprocess.Popen[bytes]) -> None:
    end = time.monotonic() + PATIENCE
    while True:
        try:
            _request(address)
        except urllib.error.URLError:
            assert server.poll() is None, log.read_text()
            assert time.monotonic() < end, log.read_text()
            time.sleep(0.05)
        else:
            return


def _request(address: str, content: Any = None, method: str | None = None) -> Any:
    data = None if content is None else json.dumps(content).encode()
    with urllib.request.urlopen(urllib.request.Request(address, data, method=method), timeout=PATIENCE) as answer:
        return json.loads(answer.read() or "null")


class OpenNotebook:
    """A notebook in a page of JupyterLab."""

    def __init__(self, page: Any, address: str) -> None:
        self.page = page
        page.goto(address)
        page.wait_for_function(f"window.jupyterapp && {READY}")

    def run(self, cell: int) -> Any:
        """Run a cell to its end; the place of its output."""
        self.page.evaluate(RUN, cell)
        return self.page.locator(".jp-Notebook .jp-Cell").nth(cell).locator(".jp-Cell-outputArea")

    def value(self, expression: str) -> Any:
        """What an expression is in the kernel, by way of JSON."""
        said = self.page.evaluate(ASK, f"__import__('json').dumps({expression})")
        assert said.startswith(("'", '"')), said
        return json.loads(ast.literal_eval(said))

    def until(self, expression: str) -> None:
        """Wait until an expression holds in the kernel: messages from the page have come."""
        end = time.monotonic() + PATIENCE
        while not self.value(f"bool({expression})"):
            assert time.monotonic() < end, expression
            time.sleep(0.02)
