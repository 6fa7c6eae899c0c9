"""A run that is followed: steps that its model writes become steps of the page."""

import asyncio
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final, NamedTuple, TypeAlias

from vexture.base.content import about
from vexture.base.errors import EXPECTED, SourceError, reason_of
from vexture.server.limited_shapes import LimitedShapes
from vexture.server.publish_file import load_kernels
from vexture.server.published import PublishedShape
from vexture.server.worker import Worker
from vexture_geo.base.crs import MissingReferenceError
from vexture_geo.base.extent import Bounds, Extent
from vexture_geo.depth.appended_steps import GrowingFile, KnownStep, StepChange, files_of, open_growing, whole_run
from vexture_geo.depth.netcdf import MOST_STEPS
from vexture_geo.flood.conversion import FloodConversion
from vexture_geo.flood.credits import Credits, credits_of
from vexture_geo.flood.scene import labels, step_names

NAMES: Final = step_names(MOST_STEPS)
"""Of the steps of a followed run: its first ones have names that fit all that may come."""

CONTENT: Final = "content"
"""Fact of a followed step: a digest of the values that it was made from."""

LOOK_SECONDS: Final = 0.25
"""Between two looks at the file; a file that has not changed in this time is read."""

SETTLING_LOOKS: Final = 8
"""A file that changes in so many looks one after another is read nevertheless."""

RETRY_SECONDS, LONGEST_RETRY = 1.0, 30.0
"""Pause after a file that could not be read, and twice as long after each further time, up to the longest."""

BATCH_SECONDS: Final = 0.5
"""Steps that are converted within this time are published together; a slow one is published alone."""

_Stamp: TypeAlias = tuple[tuple[str, int, int, int], ...]
"""Name, inode, size and time of each file of a run; they differ when its content does."""

Say: TypeAlias = Callable[[str], None]


class Start(NamedTuple):
    """First contents of a followed file."""

    extent: Extent
    known: tuple[KnownStep, ...]
    credits: Credits
    stamp: _Stamp


@dataclass(frozen=True, slots=True)
class FollowedRun:
    """A file that a model writes; `options` are those of `vexture_geo.depth.depths.read_depths`."""

    path: Path
    options: Mapping[str, Any]

    @property
    def stamp(self) -> _Stamp:
        """State of its files now; empty if there are none."""
        found = []
        for path in files_of(self.path):
            try:
                now = path.stat()
            except OSError:
                continue
            found.append((path.name, now.st_ino, now.st_size, now.st_mtime_ns))
        return tuple(found)


class _Found(NamedTuple):
    """Steps that were converted together; `is_whole` if there are no more."""

    started_over: bool
    steps: list[tuple[int, KnownStep, PublishedShape]]
    is_whole: bool


def first_steps(run: FollowedRun, bounds: Bounds | None, report: Say) -> Start:
    """Wait until a file holds a step that can be read; errors that waiting cannot fix are raised."""
    told = False
    with about(str(run.path)):
        while True:
            stamp = run.stamp
            try:
                return Start(*whole_run(run.path, bounds=bounds, **run.options), credits_of(run.path), stamp)
            except MissingReferenceError:
                raise
            except (SourceError, OSError, RuntimeError) as error:  # netCDF4 raises all of them
                if not told:
                    report(f"{run.path}: waiting for its first step ({_reason(error)}); Ctrl-C ends it")
                    told = True
            again = time.monotonic() + RETRY_SECONDS  # a lock is given up without a change of the file
            while run.stamp == stamp and time.monotonic() < again:
                time.sleep(LOOK_SECONDS)


async def follow(
    run: FollowedRun,
    start: Start,
    fresh: Sequence[PublishedShape],
    conversion: FloodConversion,
    shelf: LimitedShapes,
    report: Say,
) -> None:
    """Publish each new step of a run, and each that has changed; ends only when it is cancelled.

    `fresh` are those of the first steps that are on the shelf, but not kept yet.
    """
    worker = Worker()
    follower = _Follower(run, start, conversion, shelf, report, worker)
    try:
        await follower.keep(fresh)
        await follower.run()
    finally:
        worker.kill()


class _Follower:
    def __init__(
        self,
        run: FollowedRun,
        start: Start,
        conversion: FloodConversion,
        shelf: LimitedShapes,
        report: Say,
        worker: Worker,
    ) -> None:
        self._run, self._conversion, self._shelf, self._worker = run, conversion, shelf, worker
        self._known, self._stamp = list(start.known), start.stamp
        self._report, self._said = report, set[str]()

    async def keep(self, fresh: Sequence[PublishedShape]) -> None:
        """Keep the first steps, and none of an earlier run that had more."""
        try:
            for shape in fresh:
                await self._shelf.publish(shape)
            await self._withdraw_from(len(self._known))
        except EXPECTED as error:
            self._report_once(str(error))

    async def run(self) -> None:
        """Look at the file again and again; the first time it is read in any case, and the process is warm then."""
        pause = RETRY_SECONDS
        is_first, has_failed = True, False
        while True:
            await asyncio.sleep(LOOK_SECONDS)
            if self._run.stamp == self._stamp and not is_first:
                continue
            is_first = False
            stamp = await self._wait_until_settled()
            try:
                await self._take(rewritten=_inodes(stamp) != _inodes(self._stamp))
            except (*EXPECTED, BrokenProcessPool, MemoryError) as error:
                if isinstance(error, BrokenProcessPool):
                    self._worker.kill()
                if has_failed:  # once is no trouble: the model may have been writing
                    self._report_once(f"{self._run.path}: no newer step was read ({_reason(error)}); it is tried again")
                has_failed = True
                await asyncio.sleep(pause)
                pause = min(2.0 * pause, LONGEST_RETRY)
            else:
                self._stamp, pause, has_failed = stamp, RETRY_SECONDS, False

    def _report_once(self, line: str) -> None:
        """Report a line once."""
        if line not in self._said:
            self._said.add(line)
            self._report(line)

    async def _wait_until_settled(self) -> _Stamp:
        """Wait until the file stops changing, so that no half step is shown; return its state."""
        stamp = self._run.stamp
        for _ in range(SETTLING_LOOKS):
            await asyncio.sleep(LOOK_SECONDS)
            before, stamp = stamp, self._run.stamp
            if stamp == before:
                break
        return stamp

    async def _take(self, rewritten: bool) -> None:
        """Publish all that is new in the file."""
        is_whole = False
        while not is_whole:
            found = await self._worker.run(_newer, self._run, self._conversion, tuple(self._known), rewritten)
            if found.started_over and not found.steps:
                return
            if found.started_over:
                self._repeat(f"{self._run.path}: the run has started over; so does the page")
                self._known.clear()
            for place, (number, known, shape) in enumerate(found.steps):
                await self._shelf.publish(shape)
                self._known[number : number + 1] = [known]
                if found.started_over and place == 0:  # not before: the page would lose the step that it shows
                    await self._withdraw_from(1)
            is_whole = found.is_whole

    def _repeat(self, line: str) -> None:
        self._report(line)
        self._said.clear()

    async def _withdraw_from(self, number: int) -> None:
        for name in NAMES[number:]:
            await self._shelf.withdraw(name)


def _newer(run: FollowedRun, conversion: FloodConversion, known: Sequence[KnownStep], rewritten: bool) -> _Found:
    """Convert what is new in a file, in the process; after some time the rest is left to another call."""
    load_kernels()
    begun = time.monotonic()
    steps: list[tuple[int, KnownStep, PublishedShape]] = []
    with open_growing(run.path, frame=conversion.frame, known=known, rewritten=rewritten, **run.options) as opened:
        for change in opened.changes():
            steps.append((change.number, change.known, _shape(change, opened, conversion)))
            if time.monotonic() > begun + BATCH_SECONDS:
                return _Found(opened.started_over, steps, False)
        return _Found(opened.started_over, steps, True)


def _shape(change: StepChange, run: GrowingFile, conversion: FloodConversion) -> PublishedShape:
    label = labels(run.times[: change.number + 1])[-1]
    return with_digest(conversion.later(change.step, change.bed, NAMES[change.number], label), change.known)


def with_digest(shape: PublishedShape, known: KnownStep) -> PublishedShape:
    """Add the digest of its values to a shape."""
    return replace(shape, facts={**shape.facts, CONTENT: known.digest})


def is_made_of(shape: PublishedShape, known: KnownStep) -> bool:
    """Whether a shape says that it was made of these values, at this time."""
    time = None if known.time is None else known.time.isoformat()
    return (shape.facts.get(CONTENT), shape.facts.get("time")) == (known.digest, time)


def _inodes(stamp: _Stamp) -> list[tuple[str, int]]:
    return [(name, inode) for name, inode, _, _ in stamp]


def _reason(error: Exception) -> str:
    """Message of an error, without a remedy: the model that writes the file will fix it."""
    if isinstance(error, BrokenProcessPool):
        return "its reader crashed"
    return "out of memory" if isinstance(error, MemoryError) else reason_of(error).partition("; ")[0]
