"""Files of fonts: those of the system, and the default font that comes with ``vexture[text]``."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Final

from vexture.fonts.files import SUFFIXES

DEFAULT_PACKAGE: Final = "fontpkg_noto_sans"
"""Holds the default font, Noto Sans, in its folder ``files``."""

PATIENCE: Final = 20.0
"""Seconds for a program of fontconfig, which may build its caches."""

LINUX: Final = ("/usr/share/fonts", "/usr/local/share/fonts", "~/.fonts", "~/.local/share/fonts")
MACOS: Final = ("/System/Library/Fonts", "/Library/Fonts", "~/Library/Fonts")
WINDOWS: Final = ("%WINDIR%/Fonts", "%LOCALAPPDATA%/Microsoft/Windows/Fonts")
"""The usual folders of fonts."""


def font_files(folder: Path) -> Iterator[Path]:
    """All font files in a folder and the folders in it, in the order of their names.

    A WOFF beside the WOFF2 of its name is passed over: packages of web fonts have each font as both.
    """
    found = [path for path in sorted(folder.rglob("*")) if path.suffix.lower() in SUFFIXES and path.is_file()]
    newer = {path.with_suffix("") for path in found if path.suffix.lower() == ".woff2"}
    yield from (path for path in found if path.suffix.lower() != ".woff" or path.with_suffix("") not in newer)


@cache
def system_files() -> tuple[Path, ...]:
    """Font files of the system: those that fontconfig lists, or those of the usual folders."""
    listed = run_program("fc-list", "--format", "%{file}\n")
    if listed:
        paths = {Path(line) for line in listed.splitlines()}
        return tuple(sorted(path for path in paths if path.suffix.lower() in SUFFIXES))
    folders = {"darwin": MACOS, "win32": WINDOWS}.get(sys.platform, LINUX)
    places = (Path(os.path.expandvars(folder)).expanduser() for folder in folders)
    return tuple(path for place in places if place.is_dir() for path in font_files(place))


@cache
def generic_family(name: str) -> str:
    """Family that fontconfig chooses for a generic one; empty without it."""
    return run_program("fc-match", "--format", "%{family[0]}", name)


def run_program(program: str, *arguments: str) -> str:
    """Output of a program of fontconfig; empty if it is not there or fails."""
    found = shutil.which(program)
    if found is None:
        return ""
    try:
        done = subprocess.run([found, *arguments], capture_output=True, timeout=PATIENCE, check=True)
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.decode("utf-8", "replace")


def default_files() -> tuple[Path, ...]:
    """Files of the default font; none if ``vexture[text]`` is not installed."""
    spec = find_spec(DEFAULT_PACKAGE)
    places = () if spec is None else spec.submodule_search_locations or ()
    return tuple(path for place in places for path in font_files(Path(place) / "files"))
