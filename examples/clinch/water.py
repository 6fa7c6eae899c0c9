"""Shallow water over a grid without its advection: the local inertial equations of Bates, Horritt and Fewtrell (2010).

Journal of Hydrology 387, equation 12, with a time step that follows the deepest water.
"""

from collections.abc import Callable

import numba
import numpy as np
from scenery.grid import Array

GRAVITY = 9.81
COURANT = 0.6
DRY = 1e-3  # metres of water that do not flow
LEAST_WAVE = 2.0  # metres of water from which the time step is computed, at least
PARTS = 4  # of an hour, in which what comes in is steady
OUT = 1e-3  # slope of the water where it leaves the grid


@numba.njit
def discharge(old, here, there, bed, beside, drag, step, cell):  # type: ignore[no-untyped-def]
    """Square metres per second between a cell and the next: depths, beds, and g n² of the place."""
    if here <= DRY and there <= DRY:
        return 0.0
    deep = max(bed + here, beside + there) - max(bed, beside)
    if deep <= DRY:
        return 0.0
    fall = (beside + there - bed - here) / cell
    new = (old - GRAVITY * deep * step * fall) / (1.0 + step * drag * abs(old) / (deep * deep * np.cbrt(deep)))
    most = 0.2 * cell / step  # so that no cell gives more than it has
    return min(max(new, -most * there), most * here)


@numba.njit
def advanced(depth, bed, across, down, exits, supply, drag, seconds, cell):  # type: ignore[no-untyped-def]
    """Let water flow for some seconds; depths and discharges, to the east and to the south, change."""
    rows, columns = depth.shape
    left = seconds
    while left > 0.0:
        step = min(left, COURANT * cell / (GRAVITY * max(depth.max(), LEAST_WAVE)) ** 0.5)
        left -= step
        for r in range(rows):
            for c in range(columns):
                here, low = depth[r, c], bed[r, c]
                if c < columns - 1:
                    there, next_low = depth[r, c + 1], bed[r, c + 1]
                    across[r, c] = discharge(across[r, c], here, there, low, next_low, drag[r, c], step, cell)
                if r < rows - 1:
                    there, next_low = depth[r + 1, c], bed[r + 1, c]
                    down[r, c] = discharge(down[r, c], here, there, low, next_low, drag[r, c], step, cell)
        for r in range(rows):
            for c in range(columns):
                into = across[r, c - 1] - across[r, c] + down[r - 1, c] - down[r, c] + supply[r, c] / cell
                if exits[r, c] and depth[r, c] > DRY:  # as it would flow steadily
                    into -= depth[r, c] ** (5.0 / 3.0) * (OUT * GRAVITY / drag[r, c]) ** 0.5
                depth[r, c] = max(depth[r, c] + into * step / cell, 0.0)


def simulated(
    bed: Array, start: Array, roughness: Array, exits: Array, cell: float, supply: Callable[[float], Array],
    hours: tuple[int, int],
) -> Array:  # fmt: skip
    """Depths hour after hour, the first after some hours of warming up; the supply is in cubic metres per second."""
    warm, count = hours
    depth = start.copy()
    across, down = np.zeros(bed.shape), np.zeros(bed.shape)  # nothing flows over the last column and row: 0 is before 1
    drag = GRAVITY * roughness**2
    found = []
    for part in range(PARTS * (warm + count - 1) + 1):
        hour = part / PARTS - warm
        if part % PARTS == 0 and hour >= 0:
            found.append(depth.copy())
        come = supply(max(hour, 0.0))
        advanced(depth, bed, across, down, exits, come, drag, 3600.0 / PARTS, cell)
    return np.array(found)
