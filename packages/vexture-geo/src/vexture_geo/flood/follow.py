"""Follow a run: publish steps that its model writes as steps of the page."""

import asyncio
import time
from collections.abc import Callable, Sequence
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, NamedTuple, TypeAlias

from vexture.base.content import about
from vexture.base.errors import EXPECTED, SourceError, reason_of
from vexture.server.limited_shapes import LimitedShapes
from vexture.server.publish_file import load_kernels
from vexture.server.published import PublishedShape
from vexture.server.worker import Worker
from vexture_geo.base.crs import MissingReferenceError
from vexture_geo.base.extent import Bounds, Extent
from vexture_geo.depth.appended_steps import GrowingFile, KnownStep, StepChange, files_of, open_growing, whole_run
from vexture_geo.depth.depths import DepthOptions
from vexture_geo.depth.netcdf import MOST_STEPS
from vexture_geo.flood.conversion import FloodConversion
from vexture_geo.flood.credits import Credits, credits_of
from vexture_geo.flood.scene import labels, step_names

NAMES: Final = step_names(MOST_STEPS)
"""Names of the steps of a followed run: the first ones already allow for all that may come."""

CONTENT: Final = "content"
"""Key of a followed step's facts: a digest of the values that it was made from."""

LOOK_SECONDS: Final = 0.25
"""Interval between checks of the file; a file that has not changed in this time is read."""

SETTLING_LOOKS: Final = 8
"""Number of consecutive checks after which a file is read even if it keeps changing."""

RETRY_SECONDS, LONGEST_RETRY = 1.0, 30.0
"""Pause after a failure to read a file, and the longest pause: each further failure doubles it."""

BATCH_SECONDS: Final = 0.5
"""Steps converted within this time are published together; a slow step is published alone."""

_Stamp: TypeAlias = tuple[tuple[str, int, int, int], ...]
"""Name, inode, size and time of each file of a run, which change with its content."""

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
    options: DepthOptions

    @property
    def stamp(self) -> _Stamp:
        """Current state of the run's files; empty if there are none."""
        found = []
        for path in files_of(self.path):
            try:
                now = path.stat()
            except OSError:
                continue
            found.append((path.name, now.st_ino, now.st_size, now.st_mtime_ns))
        return tuple(found)


class _Found(NamedTuple):
    """Steps that were converted together; `is_whole` if none remain."""

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
            except (SourceError, OSError, RuntimeError) as error:  # netCDF4 raises each of them
                if not told:
                    report(f"{run.path}: waiting for its first step ({_reason(error)}); Ctrl-C ends it")
                    told = True
            again = time.monotonic() + RETRY_SECONDS  # a lock is released without a change of the file
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
    """Publish each new or changed step of a run, until it is cancelled.

    `fresh` are the first steps that are on the shelf, but not stored yet.
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
        """Store the first steps, and remove later steps of an earlier run."""
        try:
            for shape in fresh:
                await self._shelf.publish(shape)
            await self._withdraw_from(len(self._known))
        except EXPECTED as error:
            self._report_once(str(error))

    async def run(self) -> None:
        """Check the file repeatedly; the first check always reads it, which also warms up the worker process."""
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
                if has_failed:  # one failure is normal: the model may have been writing
                    self._report_once(f"{self._run.path}: no newer step was read ({_reason(error)}); it is tried again")
                has_failed = True
                await asyncio.sleep(pause)
                pause = min(2.0 * pause, LONGEST_RETRY)
            else:
                self._stamp, pause, has_failed = stamp, RETRY_SECONDS, False

    def _report_once(self, line: str) -> None:
        """Report a line unless it was reported before."""
        if line not in self._said:
            self._said.add(line)
            self._report(line)

    async def _wait_until_settled(self) -> _Stamp:
        """Wait until the file stops changing, so that no incomplete step is shown; return its state."""
        stamp = self._run.stamp
        for _ in range(SETTLING_LOOKS):
            await asyncio.sleep(LOOK_SECONDS)
            before, stamp = stamp, self._run.stamp
            if stamp == before:
                break
        return stamp

    async def _take(self, rewritten: bool) -> None:
        """Publish everything new in the file."""
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
                if found.started_over and place == 0:  # not earlier: the page would lose the step that it shows
                    await self._withdraw_from(1)
            is_whole = found.is_whole

    def _repeat(self, line: str) -> None:
        self._report(line)
        self._said.clear()

    async def _withdraw_from(self, number: int) -> None:
        for name in NAMES[number:]:
            await self._shelf.withdraw(name)


def _newer(run: FollowedRun, conversion: FloodConversion, known: Sequence[KnownStep], rewritten: bool) -> _Found:
    """Convert what is new in a file, in the worker process; after some time, leave the rest to another call."""
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
    """Add the digest of its values to a shape's facts."""
    return replace(shape, facts={**shape.facts, CONTENT: known.digest})


def is_made_of(shape: PublishedShape, known: KnownStep) -> bool:
    """Return whether a shape was made of these values at this time, by its facts."""
    time = None if known.time is None else known.time.isoformat()
    return (shape.facts.get(CONTENT), shape.facts.get("time")) == (known.digest, time)


def _inodes(stamp: _Stamp) -> list[tuple[str, int]]:
    return [(name, inode) for name, inode, _, _ in stamp]


def _reason(error: Exception) -> str:
    """Format an error without its remedy: the model that writes the file will fix it."""
    if isinstance(error, BrokenProcessPool):
        return "its reader crashed"
    return "out of memory" if isinstance(error, MemoryError) else reason_of(error).partition("; ")[0]
