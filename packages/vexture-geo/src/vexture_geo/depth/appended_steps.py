"""Depths in a file that a model is writing: find new steps and changed ones."""

import hashlib
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import NamedTuple, Unpack

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import NETCDF, known_kind, start_of
from vexture.base.errors import ParameterError, SourceError
from vexture_geo.base.crs import gis_packages
from vexture_geo.base.extent import Bounds, Extent, Frame, Step
from vexture_geo.depth.depths import DepthOptions, DepthsInFrame, depths_in_frame
from vexture_geo.depth.partitions import partitions_beside
from vexture_geo.depth.series import Reading


class KnownStep(NamedTuple):
    """Record of a step that was read: its time, and a digest of its values."""

    time: datetime | None
    digest: str


class StepChange(NamedTuple):
    """A new or changed step; `bed` is the bed at its time over the frame, if the file has it."""

    number: int  # from 0
    known: KnownStep
    step: Step
    bed: NDArray[np.float32] | None


class GrowingFile:
    """An open file that grows.

    `known` are the known steps that still exist: all of them, or none if the run has started over, with fewer steps or
    other times.
    """

    def __init__(self, placed: DepthsInFrame, known: Sequence[KnownStep], rewritten: bool) -> None:
        self._placed, self._rewritten = placed, rewritten
        times = tuple(step.time for step in known)
        if any(times) and not any(placed.times):
            raise SourceError("its times cannot be read")  # a model writes the number of steps before their times
        self.started_over = placed.times[: len(times)] != times
        self.known = () if self.started_over else tuple(known)
        self.times = placed.times

    def changes(self) -> Iterator[StepChange]:
        """Yield changed steps and new ones, in order.

        New last steps are yielded only once they hold a number, because a model writes a step's time before its values.
        """
        for number in self._suspects():
            change = self._change(number)
            if change is not None:
                yield change
        empty: list[int] = []
        for number in range(len(self.known), len(self.times)):
            reading = self._placed.values(number)
            if not np.isfinite(reading.depth).any():
                empty.append(number)
                continue
            for before in empty:
                yield self._make_change(before, self._placed.values(before))
            empty.clear()
            yield self._make_change(number, reading)

    def _suspects(self) -> range:
        """Select known steps that may have changed.

        In a file that has only grown, at most the last known step has changed, because it may have been incomplete.
        """
        old = len(self.known)
        has_grown = len(self.times) > old and not self._rewritten
        if old and has_grown and _digest(self._placed.values(old - 1)) == self.known[-1].digest:
            return range(0)
        return range(old)

    def _change(self, number: int) -> StepChange | None:
        """Return a known step if its values have changed."""
        reading = self._placed.values(number)
        if _digest(reading) == self.known[number].digest:
            return None
        if not np.isfinite(reading.depth).any():
            raise SourceError(f"step {number + 1} holds no number any more")  # temporarily: it is being rewritten
        return self._make_change(number, reading)

    def _make_change(self, number: int, reading: Reading) -> StepChange:
        known = KnownStep(self.times[number], _digest(reading))
        ground = None if reading.bed is None else self._placed.heights(reading.bed)
        return StepChange(number, known, self._placed.step(number, reading), ground)


def share_files() -> None:
    """Allow NetCDF files to be read while a model writes them, which HDF5 prevents by locks. Call it before reading.

    Values read during a write may be wrong; they are read again when the file changes.
    """
    os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")


def files_of(path: Path) -> list[Path]:
    """Files to which a run is written: all partitions, if it is one of them."""
    return partitions_beside(path) or [path]


@contextmanager
def open_growing(
    path: Path,
    *,
    frame: Frame | None,
    known: Sequence[KnownStep] = (),
    rewritten: bool = False,
    **options: Unpack[DepthOptions],
) -> Iterator[GrowingFile]:
    """Open a growing NetCDF file; see `depths.read_depths` for options and errors.

    `rewritten` says that the file may have been replaced since the `known` steps were read.
    """
    with _open_growing(path, frame, None, options) as placed:
        yield GrowingFile(placed, known, rewritten)


@gis_packages()
def whole_run(
    path: Path, *, bounds: Bounds | None, **options: Unpack[DepthOptions]
) -> tuple[Extent, tuple[KnownStep, ...]]:
    """Read all steps that a file holds now, in a frame of its own, with a record of each.

    Raises
    ------
    SourceError
        If there is no such file, or no step of it can be read yet.
    ParameterError
        If it is of another kind, or the options do not fit it.
    """
    with _open_growing(path, None, bounds, options) as placed:
        changes = list(GrowingFile(placed, (), False).changes())
        if not changes:
            raise placed.without_numbers()
        bed = next((change.bed for change in changes if change.bed is not None), None)
        extent = Extent(placed.frame, tuple(change.step for change in changes), bed, placed.notes)
        return extent, tuple(change.known for change in changes)


@contextmanager
def _open_growing(
    path: Path, frame: Frame | None, bounds: Bounds | None, options: DepthOptions
) -> Iterator[DepthsInFrame]:
    if path.exists() and not path.is_file():
        raise ParameterError("is no file; name the NetCDF file that the model writes")
    start = start_of(path)
    if not start:
        raise SourceError("it is empty" if path.exists() else "there is no such file")
    if not start.startswith(NETCDF):
        kind = known_kind(start)  # a `SourceError` for an unknown kind, as the first bytes may be written last
        raise ParameterError(
            f"holds {kind}, and only NetCDF is followed; show it with `extent`, and push what is newer"
        )
    with depths_in_frame(path, path.name, frame=frame, bounds=bounds, **options) as placed:
        yield placed


def _digest(reading: Reading) -> str:
    """Digest of the values of a step."""
    digest = hashlib.blake2b(digest_size=16)
    for values in reading:
        if values is not None:
            digest.update(values.tobytes())
    return digest.hexdigest()
