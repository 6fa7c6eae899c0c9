"""Folds that move a shoreline up and down the beach."""

import math
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.base.notes import Notes, warn_of
from vexture.fold.blend import fold as folded
from vexture.fold.fold import Fold, Kind
from vexture.fold.layout import FOLD_MOST_SECONDS, FOLD_MOST_SIDE, FOLD_TICKS
from vexture.renderers.exact import render_exact

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing

STEEPEST: Final = 0.5
"""Largest gradient of the displacements; at 1, two points could move to the same position."""

MOST_AMPLITUDE: Final = 0.25
LEAST_SIDE: Final = 8

REACH_TEXELS: Final = 2.0
REACH_AMPLITUDES: Final = 2.5
"""Factors of texel size and amplitude; the larger result is the default reach, inland and offshore."""

SOFT: Final = 0.35
"""Fraction of a straight shore's slope: where the blurred slope is this small, as on islets, shores move 2/3 as far."""

MARGIN: Final = 1 / 16
"""Fraction of the square's side, along its border, over which the movement grows from 0."""

PHASE_SLOPE: Final = 0.1
"""Largest contribution of the phases to the gradient of the displacements."""

WAVES: Final = ((0.19, 0.83, 0.37, 0.1), (0.15, -0.41, 1.13, 0.6), (0.07, 2.3, 1.7, 0.3))
"""Waves whose sum is the phase in periods: height, waves per side to the right and up, and phase."""

GRAIN: Final = 2.0**20
MOMENTS: Final = 1024
"""Steps of displacements per side, and of phases per period; the rounding is invisible and cuts the file to 1/3."""

cos, exp, sin = (np.vectorize(function, otypes=[float]) for function in (math.cos, math.exp, math.sin))
"""Functions of the C library: NumPy's differ in the last bit between processors, and so would files."""

TIMES: Final = 16
"""Number of times in half a period at which the gradient is measured."""


def shore_fold(
    drawing: "Drawing", *, amplitude: float, period: float, size: int = 64, reach: float | None = None
) -> Fold:
    """Make a fold that moves the outline of a drawing to and fro along its normals, like waves on a beach.

    The movement is largest at the outline, fades over `reach` on both sides, and is 0 at the border of the unit square.
    Its phase varies slowly with the position. Outlines that are closer together than the reach, as in a channel, move
    less. The shape never turns over: if the gradient of the displacements would exceed 0.5, the amplitude is reduced,
    with a warning.

    Parameters
    ----------
    drawing : Drawing
        The water; a drawing without paths does not move.
    amplitude : float
        Largest displacement to either side, in unit-square units.
    period : float
        Time between two waves in seconds.
    size : int
        Texels per side.
    reach : float, optional
        Width in unit-square units; by default two texels or 2.5 amplitudes, whichever is greater.

    Returns
    -------
    Fold
        Periodic, with a cycle of one period.

    Raises
    ------
    ParameterError
        If a parameter is out of range.

    Warns
    -----
    SourceWarning
        If the amplitude was reduced.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> sea = Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)])
    >>> moved = shore_fold(sea, amplitude=0.02, period=8.0)
    >>> bool(np.abs(moved.displacement[32, 32, 0]) > 0.018), moved.cycle
    (True, 8.0)
    """
    result = fold_of_shore(drawing, amplitude=amplitude, period=period, size=size, reach=reach)
    warn_of(drawing.name, result.notes)
    return result


def fold_of_shore(
    drawing: "Drawing", *, amplitude: float, period: float, size: int = 64, reach: float | None = None
) -> Fold:
    """Make the fold of `shore_fold`, without a warning: the fold contains the notes."""
    if not 0.0 < amplitude <= MOST_AMPLITUDE:
        raise ParameterError(
            f"`amplitude` is {amplitude:g}; it must be above 0 and at most {MOST_AMPLITUDE} (unit-square units)"
        )
    if not 0.01 <= period <= FOLD_MOST_SECONDS:
        raise ParameterError(f"`period` is {period:g}; it must be 0.01 to {FOLD_MOST_SECONDS} seconds")
    if not LEAST_SIDE <= size <= FOLD_MOST_SIDE:
        raise ParameterError(f"`size` is {size}; it must be {LEAST_SIDE} to {FOLD_MOST_SIDE} texels")
    if reach is None:
        reach = max(REACH_TEXELS / size, REACH_AMPLITUDES * amplitude)
    if not 1.0 / size <= reach <= 1.0:
        raise ParameterError(f"`reach` is {reach:g}; it must be a texel, {1.0 / size:g}, to 1")
    phase = _phases(size, amplitude)
    displacement = amplitude * _normals(drawing, size, reach)
    steep, notes = _steepest(displacement, phase), Notes()
    if steep > STEEPEST:
        displacement *= STEEPEST / steep
        reached = float(np.hypot(*np.moveaxis(displacement, 2, 0)).max())
        notes.remark(
            f"amplitude {amplitude:g} would turn the shore over; it is {reached:.2g}; use a larger reach or size"
        )
    displacement = np.rint(displacement * GRAIN) / GRAIN
    ticks = round(period * FOLD_TICKS)
    begin = np.rint(np.rint(phase * MOMENTS) * ticks / MOMENTS) % ticks / FOLD_TICKS
    begin[~displacement.any(axis=2)] = 0.0
    seconds = ticks / FOLD_TICKS
    return Fold(displacement, Kind.PERIODIC, begin, seconds, seconds, notes.in_order)  # type: ignore[arg-type]


def _middles(size: int) -> NDArray[np.float64]:
    """Return the centres of texels, from the left or from the bottom."""
    return (np.arange(size) + 0.5) / size


def _blur(size: int, reach: float) -> NDArray[np.float64]:
    """Return the matrix of a Gaussian blur of a column of texels, extended by its border values."""
    far = int(np.ceil(4.0 * reach * size))
    steps = np.arange(-far, far + 1)
    weights = exp(-0.5 * (steps / (reach * size)) ** 2)
    matrix = np.zeros((size, size))
    for step, weight in zip(steps, weights / weights.sum(), strict=True):
        np.add.at(matrix, (np.arange(size), np.clip(np.arange(size) + step, 0, size - 1)), weight)
    return matrix


def _normals(drawing: "Drawing", size: int, reach: float) -> NDArray[np.float64]:
    """Return normals towards the filled side, (rows, columns, 2): of length 1 at the outline, shorter far from it."""
    if not drawing.paths:
        return np.zeros((size, size, 2))
    blur = _blur(size, reach)
    image = render_exact(drawing, (size, size)).astype(np.float64)
    smooth = np.einsum("ij,kj->ik", np.einsum("ij,jk->ik", blur, image), blur)
    down, right = np.gradient(smooth, 1.0 / size)
    normals = np.stack([right, -down], axis=2) * (reach * np.sqrt(2.0 * np.pi))  # 1 on a straight shore
    length = np.hypot(normals[..., 0], normals[..., 1])[..., None]
    side = np.minimum(_middles(size), 1.0 - _middles(size)) - 0.5 / size
    rise = np.clip(side / MARGIN, 0.0, 1.0)
    taper = rise * rise * (3.0 - 2.0 * rise)
    strength = np.minimum((1.0 + SOFT) / (length + SOFT), 1.0 / np.maximum(length, 1.0))
    found: NDArray[np.float64] = normals * strength * (taper[:, None] * taper)[..., None]
    return found


def _phases(size: int, amplitude: float) -> NDArray[np.float64]:
    """Return the delay of each texel in periods, (rows, columns)."""
    x, y = _middles(size)[None, :], _middles(size)[::-1, None]
    slope = sum(2.0 * np.pi * height * float(np.hypot(right, up)) for height, right, up, _ in WAVES)
    phases = np.zeros((size, size))
    for height, right, up, start in WAVES:
        phases += height * sin(2.0 * np.pi * (right * x + up * y + start))
    return min(1.0, PHASE_SLOPE / (2.0 * np.pi * amplitude * slope)) * phases


def _steepest(displacement: NDArray[np.float64], phase: NDArray[np.float64]) -> float:
    """Return the largest singular value of the displacements' gradient over all positions and times.

    It is measured near knots and centres of texels, where the gradient of a quadratic spline is largest.
    """
    rows, columns, _ = displacement.shape
    x, y = np.meshgrid(np.arange(2 * columns + 1) / (2.0 * columns), np.arange(2 * rows + 1) / (2.0 * rows))
    places = np.stack([x.ravel(), y.ravel()], axis=1)
    base = np.zeros(places.shape, np.uint32)
    right, up = np.broadcast_to((1.0, 0.0), places.shape), np.broadcast_to((0.0, 1.0), places.shape)
    turn = 2.0 * np.pi * phase[..., None]
    parts = []
    for share in (cos(turn), -sin(turn)):
        found = folded(displacement * share, "none", base, places, right, up)
        parts.append(np.stack([found.dx - right, found.dy - up], axis=2))
    most = 0.0
    for angle in np.pi * np.arange(TIMES) / TIMES:
        gradient = sin(angle) * parts[0] + cos(angle) * parts[1]
        a, b, c, d = (gradient[:, i, j] for i in (0, 1) for j in (0, 1))
        largest = 0.5 * (np.hypot(a + d, c - b) + np.hypot(a - d, b + c))
        most = max(most, float(largest.max()))
    return most * 1.02  # margin for other positions and times
