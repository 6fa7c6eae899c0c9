"""Compiled kernels: one decorator, one cache, one announcement.

Numba is imported when the first kernel must be compiled or read from the cache. This takes half a second, which a
command saves if a wheel holds its kernels (`vexture.machine_code`).

Numba's own cache checks only the file of the function itself. A kernel would go on using the old code of a kernel, or
the old value of a constant, that it imports. So the cache folder is named after the text of all modules with either.
"""

import functools
import hashlib
import logging
import os
import tempfile
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar, cast, overload

from vexture.machine_code import Compiled, described, load

__all__ = ["Kernel", "kernel", "text_digest"]

F = TypeVar("F", bound=Callable[..., Any])

ABOVE = {
    *("cartography", "cli", "flood", "fold", "geo", "gltf", "live", "notebook", "svg", "tiles", "tracing", "wgsl"),
}
"""Parts of the package without kernels or constants of kernels: a change there compiles nothing again."""

ONE_AT_A_TIME = threading.Lock()
"""Held while Numba's configuration is changed: several threads of a server may use a kernel for the first time."""


@functools.cache
def text_digest() -> str:
    """Digest of the text of all modules that hold a kernel or a constant."""
    package = Path(__file__).parent
    digest = hashlib.sha256()
    for module in sorted(package.rglob("*.py")):
        if module.relative_to(package).parts[0] in ABOVE:
            continue
        text = module.read_bytes()
        if b"@kernel" in text or b": Final" in text:
            digest.update(text)
    return digest.hexdigest()[:12]


def kernel_cache() -> Path | None:
    """Folder of the compiled kernels: below ``VEXTURE_CACHE``, or the user's cache folder, or a temporary one.

    None if no such folder can be written: kernels are not kept then.
    """
    default = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "vexture"
    root = Path(os.environ.get("VEXTURE_CACHE") or default)
    own = f"vexture-{os.getuid() if hasattr(os, 'getuid') else 0}"
    bases: tuple[Callable[[], Path], ...] = (lambda: root, lambda: Path(tempfile.gettempdir()) / own)
    for base in bases:
        try:
            folder = base() / f"kernels-{text_digest()}"
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError:
            continue
        # the cache holds code: a folder that someone else made is not trusted
        mine = not hasattr(os, "getuid") or folder.stat().st_uid == os.getuid()
        if mine and os.access(folder, os.W_OK):
            return folder
    return None


@functools.cache
def _numba() -> tuple[Any, Path | None]:
    """Numba, with an announcement of its first compilation, and the folder of its cache."""
    import numba
    from numba.core import event

    class Announcement(event.Listener):  # type: ignore[misc]
        """Tells the user, at the first compilation of this process, why the first run takes longer."""

        def __init__(self) -> None:
            self.made = False

        def on_start(self, event: Any) -> None:
            dispatcher = event.data.get("dispatcher")
            ours = getattr(dispatcher, "py_func", None)
            if not self.made and ours is not None and ours.__module__.startswith("vexture."):
                self.made = True
                line = "vexture: compiling kernels for their first use here (up to a minute on a slow machine) ..."
                logging.getLogger("vexture").warning(line)  # to standard error, unless a program sets its level

        def on_end(self, event: Any) -> None:
            pass

    event.register("numba:compile", Announcement())
    return numba, kernel_cache()


def _kept_if_possible(save: Callable[..., None]) -> Callable[..., None]:
    """Numba's method that stores compiled code; on a full disk the next run compiles again, and this one goes on."""

    def kept(*given: Any) -> None:
        with suppress(OSError):
            save(*given)

    return kept


class Kernel:
    """A function over arrays that Numba compiles when it is first called; see `kernel`."""

    def __init__(self, function: Callable[..., Any], allocates: bool, ahead: bool, shares: bool = False) -> None:
        functools.update_wrapper(self, function)
        self.py_func = function
        self._allocates, self._ahead, self.shares = allocates, ahead, shares
        self._code: Compiled | None = None

    @functools.cached_property
    def dispatcher(self) -> Any:
        """Numba's function."""
        private = self.py_func.__name__.startswith("_")  # called by kernels only: needs no wrapper for Python
        options = {"error_model": "numpy", "no_cfunc_wrapper": True, "no_cpython_wrapper": private}
        options["nogil"] = self.shares
        with ONE_AT_A_TIME:
            numba, folder = _numba()
            # read by the decorator; other packages may use Numba too
            caller, numba.config.CACHE_DIR = numba.config.CACHE_DIR, str(folder)
            result = numba.njit(**options, cache=folder is not None, _nrt=self._allocates)(self.py_func)
            if not numba.config.DISABLE_JIT:
                result._cache.save_overload = _kept_if_possible(result._cache.save_overload)
            numba.config.CACHE_DIR = caller
        return result

    @property
    def _numba_type_(self) -> Any:
        """Numba's type of a kernel that another one calls."""
        return self.dispatcher._numba_type_

    def __call__(self, *arguments: Any) -> Any:
        """Run code that was compiled ahead of time for arguments of these types, or else what Numba compiles."""
        if self._ahead:
            types = described(arguments)
            if self._code is None or self._code.code.arguments != types:
                self._code = load(self, text_digest(), types)
                self._ahead = self._code is not None
            if self._code is not None:
                return self._code(*arguments)
        return self.dispatcher(*arguments)


@overload
def kernel(function: F) -> F: ...


@overload
def kernel(*, allocates: bool = True, ahead: bool = False, shares: bool = False) -> Callable[[F], F]: ...


def kernel(
    function: F | None = None, *, allocates: bool = True, ahead: bool = False, shares: bool = False
) -> F | Callable[[F], F]:
    """Compile a scalar function over arrays with Numba, cached on disk.

    A function whose name begins with an underscore is called by kernels only.

    Parameters
    ----------
    function : function
    allocates : bool
        False for a function that makes no arrays. Numba then counts no references, which takes longer than the work
        of a short function.
    ahead : bool
        True for a function of a plain command, which the wheel of a platform holds compiled.
    shares : bool
        True for a function that works long enough to let other threads of Python run meanwhile. Getting the
        interpreter back from a busy thread may take milliseconds.

    Examples
    --------
    >>> from vexture.bezier.roots import cubic_at
    >>> cubic_at(0.0, 0.0, 1.0, 1.0, 0.5)
    0.5
    """

    def compiled(function: F) -> F:
        return cast("F", Kernel(function, allocates, ahead, shares))

    return compiled if function is None else compiled(function)
