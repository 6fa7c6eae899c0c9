"""Conversion in worker processes, so that one that takes too much time or memory cannot harm the server."""

import asyncio
import errno
import os
from collections.abc import AsyncIterator, Callable, Iterator
from concurrent.futures.process import BrokenProcessPool
from contextlib import AsyncExitStack, asynccontextmanager, contextmanager, suppress
from typing import Any, Final, Protocol, TypeVar

from vexture.base.content import FileKind, kind_of, start_of
from vexture.base.errors import LimitError, VextureError
from vexture.conversion.parameters import Parameters
from vexture.server.limits import Limits
from vexture.server.publish_file import PUBLISHED_PARAMETERS, SMALL, shape_of
from vexture.server.published import PublishedShape
from vexture.server.worker import Worker

T = TypeVar("T")

SIDE_BY_SIDE: Final = 2
"""Number of conversions at the same time: a slow one does not block all others."""

MEMORY_BYTES: Final = 4 * 2**30
"""Limit of the address space of a worker process."""

TEMPORARY_BYTES: Final = 512 * 2**20
"""Limit of the temporary files of a conversion on the disk, for all together and for each."""

FULL: Final = (errno.EFBIG, errno.ENOSPC, errno.EDQUOT)
"""Error numbers for a lack of room on the disk."""

LOOK_SECONDS: Final = 0.2
"""Interval at which the temporary files of a conversion are checked."""

SUFFIXES: Final = {FileKind.TEXTURE: ".ktx2", FileKind.GEOJSON: ".geojson", FileKind.SVG: ".svg"}
"""Suffixes for the names of uploads; the texture stores the result as its source."""


class BusyError(VextureError):
    """Too many conversions are waiting."""


class UploadConversion(Protocol):
    """Conversion of another kind of upload, such as into the frame of a flood; it is sent to the worker processes."""

    def warm(self) -> None:
        """Load everything that a conversion needs."""

    def shape_of(self, data: bytes, name: str) -> PublishedShape:
        """Convert an upload."""


class Converter:
    """Converts several uploads at the same time, with parameters or with a conversion of another kind."""

    def __init__(self, limits: Limits, conversion: Parameters | UploadConversion = PUBLISHED_PARAMETERS) -> None:
        self._limits = limits
        self._conversion = conversion
        self._waiting = 0
        self._workers = [Worker(MEMORY_BYTES, TEMPORARY_BYTES) for _ in range(SIDE_BY_SIDE)]
        self._idle: asyncio.LifoQueue[Worker] = asyncio.LifoQueue()  # the last used is warm; others start on demand
        for worker in self._workers:
            self._idle.put_nowait(worker)
        self._ended = False

    @asynccontextmanager
    async def _worker(self) -> AsyncIterator[Worker]:
        """Wait for an idle worker."""
        worker = await self._idle.get()
        try:
            if self._ended:
                raise BusyError("the server stops; try again later")
            yield worker
        finally:
            self._idle.put_nowait(worker)

    async def warm(self) -> None:
        """Start a worker process, so that the first conversion need not wait for it."""
        async with AsyncExitStack() as stack:  # take all workers: a second one would compile the same kernels meanwhile
            first, *_ = [await stack.enter_async_context(self._worker()) for _ in self._workers]
            with suppress(BrokenProcessPool):  # the server is stopping
                await self._start_worker(first)

    async def _start_worker(self, worker: Worker) -> Worker:
        """Start a worker's process if it is not running, outside a conversion's time limit; return the worker."""
        if not worker.is_running:
            await worker.run(_warm, self._conversion)
        return worker

    @contextmanager
    def place(self) -> Iterator[None]:
        """Reserve a place for an upload; raise a `BusyError` if there is none."""
        if self._waiting >= self._limits.conversions:
            raise BusyError(f"{self._waiting} drawings wait to be converted already; try again in a few seconds")
        self._waiting += 1
        try:
            yield
        finally:
            self._waiting -= 1

    async def shape_of(self, data: bytes, name: str, file_name: str | None = None) -> PublishedShape:
        """Convert an upload according to its content; raise a `BusyError` if the server stops.

        `file_name` is the sender's name for it; by default `name`, with the suffix of the content's kind.
        """
        return await self.run(_convert, data, name, file_name, self._limits.texture_bytes, self._conversion, about=name)

    async def run(self, work: Callable[..., T], *given: Any, about: str, seconds: float | None = None) -> T:
        """Run work in a worker process, by default within the time limit of an upload; raise as `shape_of` does."""
        seconds = self._limits.conversion_seconds if seconds is None else seconds
        async with self._worker() as worker:
            try:
                await self._start_worker(worker)
                async with asyncio.timeout(seconds):
                    return await _watch_files(worker, worker.run(work, *given))
            except asyncio.CancelledError:
                worker.kill()
                raise
            except (TimeoutError, BrokenProcessPool, MemoryError, OSError) as error:
                if isinstance(error, OSError) and not isinstance(error, TimeoutError) and error.errno not in FULL:
                    raise
                worker.kill()
                if self._ended:
                    raise BusyError("the server stops; try again later") from None
                raise LimitError(f"{about}: its conversion {_need(error, seconds)}; simplify the drawing") from None

    def close(self) -> None:
        """End all worker processes and start no more."""
        self._ended = True
        for worker in self._workers:
            worker.kill()


async def _watch_files(worker: Worker, work: "asyncio.Future[T]") -> T:
    """Wait for work; raise an `OSError` if its temporary files need too much room."""
    while not work.done():
        await asyncio.wait([work], timeout=LOOK_SECONDS)
        if worker.temporary_bytes > TEMPORARY_BYTES:
            raise OSError(errno.EFBIG, os.strerror(errno.EFBIG))
    return await work


def _need(error: Exception, seconds: float) -> str:
    """Describe the resource that a conversion has used up."""
    if isinstance(error, TimeoutError):
        return f"takes longer than {seconds:g} s"
    if isinstance(error, OSError):
        return f"needs more temporary files than have room, or than {TEMPORARY_BYTES:,} bytes of them"
    return "needs too much memory"


def _warm(conversion: Parameters | UploadConversion) -> None:
    """Load everything that a conversion needs."""
    if isinstance(conversion, Parameters):
        shape_of(SMALL, "small.svg", "small", conversion)
    else:
        conversion.warm()


def _convert(
    data: bytes, name: str, file_name: str | None, most: int, conversion: Parameters | UploadConversion
) -> PublishedShape:
    """Convert an upload, in a worker process."""
    from vexture.texture.ktx2 import TEXEL_BYTES
    from vexture.texture.load import texture_from

    if not isinstance(conversion, Parameters):
        shape = conversion.shape_of(data, name)
    elif file_name is not None:
        shape = shape_of(data, file_name, name, conversion)
    elif not data.strip():
        raise LimitError(f"{name}: the upload is empty; send an SVG, GeoJSON, a picture or a packed texture")
    else:
        shape = shape_of(data, name + SUFFIXES.get(kind_of(start_of(data)), ""), name, conversion)
    size = texture_from(shape.texture.data, name).nbytes
    if size > most:
        raise LimitError(
            f"{name}: its texture has {size // TEXEL_BYTES} texels; the limit is {most // TEXEL_BYTES}; simplify it"
        )
    return shape
