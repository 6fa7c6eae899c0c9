"""Compiled kernels: one decorator, one cache, one announcement.

Numba is imported when the first kernel must be compiled or read from the cache. This takes half a second, which a
command saves if a wheel holds its kernels (`vexture.base.machine_code`).

Numba's own cache checks only the file of the function itself. A kernel would go on using the old code of a kernel, or
the old value of a constant, that it imports. So the cache folder is named after the text of all modules with either.
It also believes what its files hold, which ends the process where a disk has damaged them. Ours begin with a digest.
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
    *("base/apart.py", "base/content.py", "base/labels.py"),
}
"""Parts of the package without kernels or constants of kernels: a change there compiles nothing again."""

DIGEST_BYTES = hashlib.sha256().digest_size
"""With which a file of the cache begins."""

ONE_AT_A_TIME = threading.Lock()
"""Held while Numba's configuration is changed: several threads of a server may use a kernel for the first time."""


@functools.cache
def text_digest() -> str:
    """Digest of the text of all modules that hold a kernel or a constant."""
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
        if mine and os.access(folder, os.W_OK | os.X_OK):
            return folder
    return None


@functools.cache
def _numba() -> tuple[Any, Path | None]:
    """Numba, with an announcement of its first compilation, and the folder of its cache."""
    import numba
    from numba.core import event

    class Announcement(event.Listener):  # type: ignore[misc]
        """Tells the user, at the first compilation of this process, why the first run takes longer; stops the clock."""

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
    """The files of a kernel's code, one for each set of types; in place of Numba's, which are believed unseen.

    What is damaged, or cannot be read, is compiled again and replaced; what cannot be written is compiled by the next
    run, and this one goes on.
    """

    def __init__(self, cache: Any, version: str) -> None:
        self._start = os.path.join(cache.cache_path, cache._impl.filename_base)
        self._made_by = version, cache._impl.locator.get_source_stamp()

    def _place(self, key: Any) -> str:
        return f"{self._start}.{hashlib.sha256(repr(key).encode()).hexdigest()[:16]}.code"

    def load(self, key: Any) -> Any:
        """Return the code saved under a key; None if it is missing, damaged or old."""
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
        """Keep what was compiled, if the disk lets us."""
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
            make = functools.partial(numba.njit, **options, _nrt=self._allocates)
            try:
                result = make(cache=folder is not None)(self.py_func)
                if folder is not None and not numba.config.DISABLE_JIT:
                    result._cache._cache_file = _KeptCode(result._cache, numba.__version__)
            except (OSError, RuntimeError):  # something else is in the place of a folder in the cache
                result = make()(self.py_func)
            numba.config.CACHE_DIR = caller
        return result

    @property
    def _numba_type_(self) -> Any:
        """Numba's type of a kernel that another one calls."""
        return self.dispatcher._numba_type_

    def __call__(self, *arguments: Any) -> Any:
        """Run code that was compiled ahead of time for arguments of these types, or else what Numba compiles."""
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

    def decorate(function: F) -> F:
        return cast("F", Kernel(function, allocates, ahead, shares))

    return decorate if function is None else decorate(function)
