"""Strangers' data in processes of their own: what a library does can be ended, and its crash is a line."""

import copyreg
import faulthandler
import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import vexture.base.apart as apart_module
from vexture.base.apart import apart, each_apart
from vexture.base.deadline import CLOCK, check_time, within
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.tree.parts import usual_threads

LINUX = pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")


@pytest.fixture
def short_grace(monkeypatch: pytest.MonkeyPatch) -> None:
    """End work that does not end soon after its limit."""
    monkeypatch.setattr(apart_module, "GRACE", 0.1)


def stop(seconds: float) -> str:
    """Do not come back, as a library that holds the interpreter's lock."""
    signal.pthread_sigmask(signal.SIG_BLOCK, signal.valid_signals())
    time.sleep(seconds)
    return "late"


def crash() -> None:
    faulthandler.disable()
    os.kill(os.getpid(), signal.SIGSEGV)


@pytest.mark.usefixtures("short_grace")
def test_work_that_does_not_end_is_ended() -> None:
    with pytest.raises(LimitError, match=r"^a\.nc: converting takes longer than 0\.1 s; simplify .*`max_seconds`$"):
        apart(stop, 1000.0, name="a.nc", seconds=0.1)


def test_a_crash_of_a_library_is_a_line() -> None:
    with pytest.raises(SourceError, match=r"^a\.nc: a library ended the process that read it \(Segmentation fault\); "):
        apart(crash, name="a.nc")


def moody(kind: str) -> str:
    """Work that does as it is told."""
    if kind == "endless":
        stop(1000.0)
    if kind == "crash":
        crash()
    if kind == "limit":
        with within(1e-9):
            check_time(kind)
    if kind == "parameter":
        raise ParameterError("no")
    return kind


@pytest.mark.usefixtures("short_grace")
@pytest.mark.parametrize("processes", [1, 2, 9])
def test_each_piece_of_work_has_its_own_end(processes: int) -> None:
    kinds = ["a", "crash", "b", "endless", "limit", "parameter", "c"]
    found = [*each_apart(moody, [(kind,) for kind in kinds], kinds, 1.0, processes)]
    assert [found[place] for place in (0, 2, 6)] == ["a", "b", "c"]
    assert [type(found[place]) for place in (1, 3, 4, 5)] == [SourceError, LimitError, LimitError, ParameterError]


def unexpected() -> None:
    raise ZeroDivisionError("a fault of ours")


def test_a_fault_of_ours_is_raised_with_its_place() -> None:
    with pytest.raises(ZeroDivisionError) as caught:
        apart(unexpected)
    assert "in unexpected" in "".join(caught.value.__notes__)


class CannotBeCopiedError(Exception):
    """As errors of GDAL in rasterio are."""

    args = property(lambda self: ("no",))  # type: ignore[assignment]


def refuse() -> None:
    try:
        raise CannotBeCopiedError
    except CannotBeCopiedError as error:
        raise SourceError("a.tif: no raster") from error


def test_a_cause_that_cannot_be_copied_hides_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """Dask, which xarray imports, has causes copied with their errors: a traceback came of it."""
    copying = pytest.importorskip("tblib.pickling_support", reason="tblib, which copies causes, is missing")
    for kind in (SourceError, CannotBeCopiedError):
        monkeypatch.setitem(copyreg.dispatch_table, kind, copying.pickle_exception)
    with pytest.raises(SourceError, match=r"^a\.tif: no raster\n"):
        apart(refuse)


@pytest.mark.parametrize("seconds", [0.0, -1.0, math.nan])
def test_a_limit_is_a_number_above_zero(seconds: float) -> None:
    with pytest.raises(ParameterError, match="`max_seconds`"):
        apart(max, 1, 2, seconds=seconds)


def alive(process: int) -> bool:
    """Whether a process runs; one that has ended and is not waited for does not."""
    try:
        return "State:\tZ" not in Path(f"/proc/{process}/status").read_text()
    except OSError:
        return False


PARENT = """
import os, time
from vexture.base.apart import apart
def tell_and_stop():
    print(os.getpid(), flush=True)
    time.sleep(1000)
apart(tell_and_stop)
"""


@LINUX
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_the_process_ends_with_its_parent(number: int) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", PARENT], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as parent:
        assert parent.stdout is not None
        child = int(parent.stdout.readline())
        assert alive(child)
        parent.send_signal(number)
        parent.wait()
        while alive(child):  # the limit of the test's time ends this
            time.sleep(0.01)


def stand_still(seconds: float) -> str:
    """Work of which most is not counted; it looks at the clock by itself as well."""
    with within(0.2):
        CLOCK.stop()
        CLOCK.stop()
        time.sleep(seconds)
        CLOCK.go_on()
        CLOCK.go_on()
        check_time()
    return "done"


def stop_and_go_on(seconds: float) -> None:
    CLOCK.stop()
    CLOCK.go_on()
    time.sleep(seconds)


@pytest.mark.usefixtures("short_grace")
def test_no_limit_counts_the_time_in_which_the_clock_stands() -> None:
    assert apart(stand_still, 1.0, seconds=0.2) == "done"
    with pytest.raises(LimitError):
        apart(stop_and_go_on, 100.0, seconds=0.2)


def test_no_limit_counts_the_compiling_of_kernels() -> None:
    """On a slow machine the first conversion never ended: compiling took longer than its limit."""
    import numba

    from vexture.bezier.roots import cubic_at

    cubic_at(0.0, 0.0, 1.0, 1.0, 0.5)  # Numba is heard from here on
    start, counted = time.monotonic(), CLOCK.seconds()
    numba.njit(lambda x: x + 1)(1)
    whole, counted = time.monotonic() - start, CLOCK.seconds() - counted
    assert counted < 0.9 * whole


def test_limits_within_limits_are_the_earlier_one() -> None:
    """A map had its limit three times: for reading, preparing and converting."""
    with pytest.raises(LimitError, match="longer than 1e-09 s"), within(1e-9), within(1000.0):
        check_time()
    with pytest.raises(LimitError, match="longer than 1e-09 s"), within(1000.0), within(1e-9):
        check_time()


@pytest.mark.parametrize("processes", [1, 2])
def test_a_process_beside_which_no_other_works_uses_all_processors(processes):
    found = [*each_apart(usual_threads, [(), ()], ["a", "b"], 60.0, processes)]
    assert found == [usual_threads() if processes == 1 else 1] * 2
