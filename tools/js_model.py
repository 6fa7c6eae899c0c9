"""Exports of the npm package, as TypeDoc reads them from the sources' types."""

import hashlib
import json
import os
import posixpath
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

TYPEDOC: Final = Path("node_modules", "typedoc", "bin", "typedoc")
KEPT: Final = Path(".cache", "javascript")
"""Where descriptions are kept, in the repository."""

MAIN: Final = "vexture"
"""The package, and its main entry."""


@dataclass(frozen=True, slots=True)
class Entry:
    """An entry of the package.

    Parameters
    ----------
    name : str
        What a program imports, such as ``vexture/water``.
    source : str
        Its module, from the package's folder.
    """

    name: str
    source: str

    @property
    def slug(self) -> str:
        """Name of its page."""
        return self.name.rpartition("/")[2]


def entries(web: Path) -> list[Entry]:
    """Entries with code, the main one first, since a name has its home in the first that exports it."""
    exports = json.loads((web / "package.json").read_text(encoding="utf-8"))["exports"]
    found = [
        Entry(posixpath.join(MAIN, key.removeprefix(".").strip("/")).strip("/"), posixpath.normpath(value["default"]))
        for key, value in exports.items()
        if isinstance(value, dict) and "default" in value
    ]
    return sorted(found, key=lambda entry: entry.name != MAIN)


def missing(web: Path) -> str | None:
    """Return what the reference lacks to be made, in a few words; None if it lacks nothing."""
    if shutil.which("node") is None:
        return "Node.js is missing"
    if not (web / TYPEDOC).is_file():
        return "the packages of web/ are not installed"
    return None


def model(web: Path) -> dict[str, Any]:
    """Entries' names, and TypeDoc's description of each. It is kept until a source changes.

    Raises
    ------
    RuntimeError
        If TypeDoc fails.
    """
    found = entries(web)
    kept = web.parent / KEPT / f"{_digest(web)}.json"
    if not kept.is_file():
        kept.parent.mkdir(parents=True, exist_ok=True)
        for old in kept.parent.glob("*.json"):
            old.unlink(missing_ok=True)
        _describe(web, found, kept)
    named = {module["name"]: module for module in json.loads(kept.read_text(encoding="utf-8"))["children"]}
    # a module is named by its place below the folder that all have in common
    return {
        entry.name: named[posixpath.relpath(entry.source, "src").removesuffix(".js").removesuffix("/index")]
        for entry in found
    }


def _digest(web: Path) -> str:
    """Digest of all that the description depends on."""
    digest = hashlib.sha256()
    for path in [*sorted(web.glob("*.json")), *sorted((web / "src").rglob("*.*")), *sorted(web.glob("generated/*.js"))]:
        digest.update(f"{path.relative_to(web)}\0".encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def _describe(web: Path, found: list[Entry], output: Path) -> None:
    """Let TypeDoc write its description to a file."""
    with tempfile.TemporaryDirectory(dir=output.parent) as scratch:
        written = Path(scratch, "model.json")
        command = ["node", str(TYPEDOC), "--json", str(written)]
        for entry in found:
            command += ["--entryPoints", entry.source]
        outcome = subprocess.run(command, cwd=web, capture_output=True, text=True, check=False)
        if outcome.returncode or not written.is_file():
            raise RuntimeError(f"TypeDoc cannot read web/src: {(outcome.stderr + outcome.stdout).strip()}")
        os.replace(written, output)
