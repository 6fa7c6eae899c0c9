"""Compiled kernels: one decorator, one cache, one announcement.

Numba's own cache watches only the file of the function itself, so a kernel would go on calling the old code of a
kernel, or with the old value of a constant, that it imports. The cache folder is therefore named after the text of all
modules that hold either.
"""

import hashlib
import os
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, overload

import numba
from numba.core import event

__all__ = ["kernel"]

F = TypeVar("F", bound=Callable[..., Any])

ABOVE = {"evaluation", "figures", "flood", "folding", "live", "report", "sources"}
"""Parts of the package that no kernel stands in or takes a constant from: changing them compiles nothing again."""


def kernel_cache() -> Path:
    """Folder of the compiled kernels: below ``VEXTURE_CACHE``, or the user's cache folder, or a temporary one."""
    package = Path(__file__).parent
    digest = hashlib.sha256(numba.__version__.encode())
    for module in sorted(package.rglob("*.py")):
        if module.relative_to(package).parts[0] in ABOVE:
            continue
        text = module.read_bytes()
        if b"@kernel" in text or b": Final" in text:
            digest.update(text)
    default = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "vexture"
    root = Path(os.environ.get("VEXTURE_CACHE") or default)
    for base in (root, Path(tempfile.gettempdir()) / f"vexture-{os.getuid() if hasattr(os, 'getuid') else 0}"):
        folder = base / f"kernels-{digest.hexdigest()[:12]}"
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError:
            continue
        # the cache holds code: a folder that someone else made is not trusted
        mine = not hasattr(os, "getuid") or folder.stat().st_uid == os.getuid()
        if mine and os.access(folder, os.W_OK):
            return folder
    return root


class _Announcement(event.Listener):  # type: ignore[misc]
    """Says once, on the first compilation of this process, why the first run takes longer."""

    def __init__(self) -> None:
        self.made = False

    def on_start(self, event: Any) -> None:
        dispatcher = event.data.get("dispatcher")
        ours = getattr(dispatcher, "py_func", None)
        if not self.made and ours is not None and ours.__module__.startswith("vexture."):
            self.made = True
            line = "vexture: compiling kernels for their first use on this machine (half a minute or less) ..."
            print(line, file=sys.stderr, flush=True)

    def on_end(self, event: Any) -> None:
        pass


CACHE = str(kernel_cache())
event.register("numba:compile", _Announcement())


@overload
def kernel(function: F) -> F: ...


@overload
def kernel(*, allocates: bool) -> Callable[[F], F]: ...


def kernel(function: F | None = None, *, allocates: bool = True) -> F | Callable[[F], F]:
    """Compile a scalar function over arrays with Numba, cached on disk.

    A name with a leading underscore says that only kernels call it.

    Parameters
    ----------
    function : function
        What is decorated.
    allocates : bool
        False for a function that makes no arrays: Numba then counts no references in it, which for short functions
        costs more than what they do.

    Examples
    --------
    >>> from vexture.bezier.roots import cubic_at
    >>> cubic_at(0.0, 0.0, 1.0, 1.0, 0.5)
    0.5
    """

    def compiled(function: F) -> F:
        caller, numba.config.CACHE_DIR = (
            numba.config.CACHE_DIR,
            CACHE,
        )  # read while decorating; others may use Numba too
        private = function.__name__.startswith("_")  # called by kernels only: Python needs no way in
        options = {"cache": True, "error_model": "numpy", "no_cfunc_wrapper": True, "no_cpython_wrapper": private}
        result: F = numba.njit(**options, _nrt=allocates)(function)
        numba.config.CACHE_DIR = caller
        return result

    return compiled if function is None else compiled(function)
