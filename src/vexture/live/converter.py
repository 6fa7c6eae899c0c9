"""Conversion in processes of their own, so that one that takes too long or too much memory cannot harm the server."""

import asyncio
from collections.abc import AsyncIterator, Iterator
from concurrent.futures.process import BrokenProcessPool
from contextlib import AsyncExitStack, asynccontextmanager, contextmanager, suppress
from typing import Final

from vexture.content import FileKind, kind_of, start_of
from vexture.errors import LimitError, VextureError
from vexture.live.documents import PUBLISHED_PARAMETERS, SMALL, shape_of
from vexture.live.flood_conversion import FloodConversion
from vexture.live.limits import Limits
from vexture.live.shelf import Shape
from vexture.live.worker import Worker
from vexture.parameters import Parameters

__all__ = ["BusyError", "Converter"]

SIDE_BY_SIDE: Final = 2
"""Conversions at one time: a slow one does not keep all others waiting."""

MEMORY_BYTES: Final = 4 * 2**30
"""Address space of a process."""

SUFFIXES: Final = {FileKind.TEXTURE: ".ktx2", FileKind.GEOJSON: ".geojson", FileKind.SVG: ".svg"}
"""Added to the name of an upload, which its texture then names as its source."""


class BusyError(VextureError):
    """Too many conversions wait: try again later."""


class Converter:
    """Converts uploads side by side, as parameters say or, on the server of a flood, into its frame."""

    def __init__(self, limits: Limits, how: Parameters | FloodConversion = PUBLISHED_PARAMETERS) -> None:
        self._limits = limits
        self._how = how
        self._waiting = 0
        self._workers = [Worker(MEMORY_BYTES) for _ in range(SIDE_BY_SIDE)]
        self._idle: asyncio.LifoQueue[Worker] = asyncio.LifoQueue()  # the last used is warm; others start when needed
        for worker in self._workers:
            self._idle.put_nowait(worker)
        self._ended = False

    @asynccontextmanager
    async def _worker(self) -> AsyncIterator[Worker]:
        """Wait for a worker that is idle."""
        worker = await self._idle.get()
        try:
            if self._ended:
                raise BusyError("the server stops; try again later")
            yield worker
        finally:
            self._idle.put_nowait(worker)

    async def warm(self) -> None:
        """Start a process, so that the first conversion need not wait for it."""
        async with AsyncExitStack() as held:  # all of them: a second one would compile the same kernels meanwhile
            first, *_ = [await held.enter_async_context(self._worker()) for _ in self._workers]
            with suppress(BrokenProcessPool):  # the server stops
                await first.run(_warm, self._how)

    @contextmanager
    def place(self) -> Iterator[None]:
        """Reserve a place for an upload; raises a `BusyError` if there is none."""
        if self._waiting >= self._limits.conversions:
            raise BusyError(f"{self._waiting} drawings wait to be converted already; try again in a few seconds")
        self._waiting += 1
        try:
            yield
        finally:
            self._waiting -= 1

    async def shape_of(self, data: bytes, name: str) -> Shape:
        """Shape of an upload, whose content decides what it is; raises a `BusyError` if the server stops."""
        seconds, most = self._limits.conversion_seconds, self._limits.texture_bytes
        async with self._worker() as worker:
            try:
                async with asyncio.timeout(seconds):
                    return await worker.run(_convert, data, name, most, self._how)
            except asyncio.CancelledError:
                worker.kill()
                raise
            except (TimeoutError, BrokenProcessPool, MemoryError) as error:
                worker.kill()
                if self._ended:
                    raise BusyError("the server stops; try again later") from None
                needs = (
                    f"takes longer than {seconds:g} s" if isinstance(error, TimeoutError) else "needs too much memory"
                )
                raise LimitError(f"{name}: its conversion {needs}; simplify the drawing") from None

    def close(self) -> None:
        """End the processes and start no other one."""
        self._ended = True
        for worker in self._workers:
            worker.kill()


def _warm(how: Parameters | FloodConversion) -> None:
    """Load what a conversion needs."""
    if isinstance(how, FloodConversion):
        how.warm()
    else:
        shape_of(SMALL, "small.svg", "small", how)


def _convert(data: bytes, name: str, most: int, how: Parameters | FloodConversion) -> Shape:
    """Convert an upload, in the process."""
    from vexture.texture.ktx2 import TEXEL_BYTES
    from vexture.texture.load import texture_from

    if isinstance(how, FloodConversion):
        shape = how.shape_of(data, name)
    elif not data.strip():
        raise LimitError(f"{name}: the upload is empty; send an SVG, GeoJSON, a picture or a packed texture")
    else:
        shape = shape_of(data, name + SUFFIXES.get(kind_of(start_of(data)), ""), name, how)
    size = texture_from(shape.texture.data, name).nbytes
    if size > most:
        raise LimitError(
            f"{name}: its texture has {size // TEXEL_BYTES} texels; the limit is {most // TEXEL_BYTES}; simplify it"
        )
    return shape
