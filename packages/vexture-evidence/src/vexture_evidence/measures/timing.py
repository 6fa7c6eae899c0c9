"""Timing, by medians, so that other work on the machine, which makes some runs slower, has little influence."""

import time
from collections.abc import Callable
from statistics import median
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from vexture_evidence.measures.programs import Program

FRAME: Final = (1024, 1024)
"""Width and height in pixels of the picture that a frame rate is measured with, by default."""

LONG_ENOUGH: Final = 0.02
"""Least seconds of one measurement; on a fast device it contains several frames."""

MOST_DRAWS: Final = 1000
"""Most frames in one measurement."""


def median_seconds(action: Callable[[], object], repeat: int) -> float:
    """Median time of an action.

    Parameters
    ----------
    action : function
        Called once before the timed calls, so that nothing is compiled or loaded while it is timed.
    repeat : int
        Number of timed calls, at least 1.

    Returns
    -------
    float
        Seconds.

    Examples
    --------
    >>> 0.009 < median_seconds(lambda: time.sleep(0.01), 3)
    True
    """
    action()
    taken = []
    for _ in range(repeat):
        start = time.perf_counter()
        action()
        taken.append(time.perf_counter() - start)
    return median(taken)


def frames_per_second(program: "Program", size: tuple[int, int] = FRAME, repeat: int = 3) -> float:
    """Rate at which the device draws the whole unit square, the median of `repeat` measurements.

    Parameters
    ----------
    program : Program
        One of the programs of `vexture_evidence.measures.programs`.
    size : tuple of int
        Width and height of the picture in pixels.
    repeat : int
        Number of measurements.

    Returns
    -------
    float
        Frames per second, not limited by a display.

    Raises
    ------
    DeviceError
        If there is no GPU.
    """
    from vexture.renderers.view import fit
    from vexture_evidence.measures.programs import framebuffer, seconds

    drawn, to_unit = framebuffer(size), fit(size)
    seconds(program, drawn, to_unit, size, 1)  # drivers finish a program when it is first used
    once = seconds(program, drawn, to_unit, size, 1)
    draws = max(1, min(MOST_DRAWS, round(LONG_ENOUGH / max(once, LONG_ENOUGH / MOST_DRAWS))))
    return draws / median(seconds(program, drawn, to_unit, size, draws) for _ in range(repeat))
