"""Compiled kernels: one decorator, one cache, one announcement.

Numba is imported when the first kernel must be compiled or read from the cache. The import takes half a second. A
command saves it if the wheel holds compiled code of its kernels (`vexture.base.machine_code`).

Numba's own cache checks only the source file of the function itself. If a kernel imports another kernel or a constant
that has changed, it would keep using the old one. So the cache folder is named after a digest of all modules that
define kernels or constants. Numba also trusts the content of its cache files, and a damaged file crashes the process.
Our files begin with a digest.
"""

import functools
import hashlib
import logging
import os
import pickle
import shutil
import tempfile
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar, cast, overload

from vexture.base.deadline import CLOCK
from vexture.base.machine_code import Compiled, argument_type, load

F = TypeVar("F", bound=Callable[..., Any])

ABOVE = {
    *("cli", "conversion", "fold", "fonts", "gltf", "notebook", "pages", "server", "svg", "tracing"),
    *("base/apart.py", "base/content.py", "base/labels.py", "base/pixels.py"),
    *("drawing/blur.py", "drawing/effect.py", "tree/planar/blurs.py"),
}
"""Folders and modules whose changes need no recompilation: they hold neither kernels nor constants of kernels."""

DIGEST_BYTES = hashlib.sha256().digest_size
"""Length of the digest at the start of a cache file."""

ONE_AT_A_TIME = threading.Lock()
"""Lock on Numba's configuration: several threads of a server may use a kernel for the first time at once."""


@functools.cache
def text_digest() -> str:
    """Digest of the source text of all modules that hold a kernel or a constant."""
    package = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for module in sorted(package.rglob("*.py")):
        place = module.relative_to(package)
        if place.parts[0] in ABOVE or place.as_posix() in ABOVE:
            continue
        text = module.read_bytes()
        if b"@kernel" in text or b": Final" in text:
            digest.update(text)
    return digest.hexdigest()[:12]


def kernel_cache() -> Path | None:
    """Folder of the compiled kernels: in ``VEXTURE_CACHE``, in the user's cache folder, or in a temporary folder.

    None if no such folder is writable. Kernels are then compiled again in each process.
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
        # the cache holds code that we run, so another user's folder is not trusted
        mine = not hasattr(os, "getuid") or folder.stat().st_uid == os.getuid()
        if mine and os.access(folder, os.W_OK | os.X_OK):
            return folder
    return None


@functools.cache
def _numba() -> tuple[Any, Path | None]:
    """Numba, which announces its first compilation, and its cache folder."""
    import numba
    from numba.core import event

    class Announcement(event.Listener):  # type: ignore[misc]
        """Tells the user at the first compilation why this run takes longer; stops the clock of time limits."""

        def __init__(self) -> None:
            self.made = False

        def on_start(self, event: Any) -> None:
            CLOCK.stop()
            dispatcher = event.data.get("dispatcher")
            ours = getattr(dispatcher, "py_func", None)
            if not self.made and ours is not None and ours.__module__.startswith("vexture."):
                self.made = True
                line = "vexture: compiling kernels for their first use here (minutes on a slow machine) ..."
                logging.getLogger("vexture").warning(line)  # to standard error, unless a program sets its level

        def on_end(self, event: Any) -> None:
            CLOCK.go_on()

    event.register("numba:compile", Announcement())
    return numba, kernel_cache()


class _KeptCode:
    """Cache files of a kernel, one for each set of argument types; replaces Numba's, which are not verified.

    A file that is damaged or cannot be read is compiled again and replaced. If a file cannot be written, the next
    process compiles the kernel again.
    """

    def __init__(self, cache: Any, version: str) -> None:
        self._start = os.path.join(cache.cache_path, cache._impl.filename_base)
        self._made_by = version, cache._impl.locator.get_source_stamp()

    def _place(self, key: Any) -> str:
        return f"{self._start}.{hashlib.sha256(repr(key).encode()).hexdigest()[:16]}.code"

    def load(self, key: Any) -> Any:
        """Return the code saved under a key; None if it is missing, damaged or outdated."""
        try:
            content = Path(self._place(key)).read_bytes()
        except OSError:
            return None
        digest, code = content[:DIGEST_BYTES], content[DIGEST_BYTES:]
        if hashlib.sha256(code).digest() != digest:
            return None
        made_by, data = pickle.loads(code)
        return data if made_by == self._made_by else None

    def save(self, key: Any, data: Any) -> None:
        """Save compiled code; do nothing if the disk refuses."""
        from numba.core.serialize import dumps

        place = self._place(key)
        code = dumps((self._made_by, data))
        with suppress(OSError):
            if os.path.isdir(place):
                shutil.rmtree(place)
            with tempfile.NamedTemporaryFile(dir=os.path.dirname(place), delete=False) as file:
                try:
                    file.write(hashlib.sha256(code).digest() + code)
                    file.close()
                    os.replace(file.name, place)
                except BaseException:
                    os.unlink(file.name)
                    raise


class Kernel:
    """A function over arrays that Numba compiles at its first call; see `kernel`."""

    def __init__(self, function: Callable[..., Any], allocates: bool, ahead: bool, shares: bool = False) -> None:
        functools.update_wrapper(self, function)
        self.py_func = function
        self._allocates, self._ahead, self.shares = allocates, ahead, shares
        self._code: Compiled | None = None

    @functools.cached_property
    def dispatcher(self) -> Any:
        """Numba's function."""
        private = self.py_func.__name__.startswith("_")  # only kernels call it: it needs no wrapper for Python
        options = {"error_model": "numpy", "no_cfunc_wrapper": True, "no_cpython_wrapper": private}
        options["nogil"] = self.shares
        with ONE_AT_A_TIME:
            numba, folder = _numba()
            # the decorator reads CACHE_DIR; restored below because other packages may use Numba too
            caller, numba.config.CACHE_DIR = numba.config.CACHE_DIR, str(folder)
            make = functools.partial(numba.njit, **options, _nrt=self._allocates)
            try:
                result = make(cache=folder is not None)(self.py_func)
                if folder is not None and not numba.config.DISABLE_JIT:
                    result._cache._cache_file = _KeptCode(result._cache, numba.__version__)
            except (OSError, RuntimeError):  # a file stands where the cache needs a folder
                result = make()(self.py_func)
            numba.config.CACHE_DIR = caller
        return result

    @property
    def _numba_type_(self) -> Any:
        """Numba's type of this kernel, for kernels that call it."""
        return self.dispatcher._numba_type_

    def __call__(self, *arguments: Any) -> Any:
        """Run code compiled ahead of time for arguments of these types, or else code that Numba compiles."""
        if self._ahead:
            types = argument_type(arguments)
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
    """Compile a scalar function over arrays with Numba, and cache the code on disk.

    Only kernels may call a function whose name begins with an underscore.

    Parameters
    ----------
    function : function
    allocates : bool
        False for a function that makes no arrays. Numba then counts no references; counting takes longer than the
        work of a short function.
    ahead : bool
        True for a function that everyday commands use. Wheels hold such functions compiled.
    shares : bool
        True for a function that runs long enough to let other Python threads run meanwhile. Taking the interpreter
        lock back from a busy thread may take milliseconds.

    Examples
    --------
    >>> from vexture.bezier.roots import cubic_at
    >>> cubic_at(0.0, 0.0, 1.0, 1.0, 0.5)
    0.5
    """

    def decorate(function: F) -> F:
        return cast("F", Kernel(function, allocates, ahead, shares))

    return decorate if function is None else decorate(function)
