"""The colour of a gradient at a point, as SVG 2 defines it (14.2), and that of a picture over a box."""

from collections.abc import Sequence
from typing import Final, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import SourceError
from vexture.base.kernels import kernel
from vexture.base.layout import MOST_PICTURE_SIDE
from vexture.drawing.paint import Color, Gradient, Spread, Stop
from vexture.drawing.picture import Picture, Sampling
from vexture.drawing.unit_square import FARTHEST
from vexture.tree.planar.pixels import BYTE, IS_OPAQUE, SIDE_BITS, SIZE, list_pixels, mean_of_picture, pixels_at
from vexture.tree.planar.splines import INVERSE, OPACITY

REFLECT, REPEAT = int(Spread.REFLECT), int(Spread.REPEAT)

ONE_PIXEL: Final = 1 | 1 << SIDE_BITS
"""Size of a picture of one pixel."""


class Shades(NamedTuple):
    """Gradients and pictures in few arrays, because each array slows every call of a kernel."""

    rows: NDArray[np.float64]  # (n, 11): both rows of the map to the ramp, or to pixels; the columns from `FOCUS` on
    stops: NDArray[np.float64]  # (stops, 5): colours, not premultiplied, and `OFFSET`
    pixels: NDArray[np.uint32]  # the words of all pictures, as in `pixels`


FOCUS, RADIUS, SPREAD, FIRST, COUNT = range(6, 11)
"""Columns of a gradient: focal point and radius, -1 if it is linear; spread; first stop; number of stops.

Those of a picture: `PICTURE`; opacity; sampling, and above its `SAMPLING_BITS` the colour of a picture of opacities,
red, green and blue from the low byte up; where its words begin among the pixels; 0.
"""

SAMPLING_BITS: Final = 3

PICTURE = -2.0
"""Value of `FOCUS` in the row of a picture."""

OFFSET = 4
"""Column of a stop; the others are its colour and opacity."""

MOST_NUMBER: Final = MOST_PICTURE_SIDE * FARTHEST
"""Largest number of a map to pixels: shaders compute with 32-bit floats."""

Shade: TypeAlias = Gradient | Picture


def check_map(picture: Picture) -> None:
    """Raise a `SourceError` if a map to pixels has a number that is too large."""
    most = max(abs(number) for row in picture.to_pixels for number in row)
    if most > MOST_NUMBER:
        raise SourceError(
            f"a picture's map to pixels has the number {most:.3g}; the limit is {MOST_NUMBER:.3g}; "
            "make the picture larger or the view box smaller"
        )


def shades_of(listed: Sequence[Shade]) -> Shades:
    """Make the arrays of gradients and pictures."""
    rows: list[list[float]] = []
    stops: list[tuple[float, ...]] = []
    pixels, begins = list_pixels([one for one in listed if isinstance(one, Picture)])
    begin = iter(begins)
    for one in listed:
        if isinstance(one, Picture):
            check_map(one)
            sampling = one.sampling | pack_color(one.color or (0.0, 0.0, 0.0)) << SAMPLING_BITS
            rows.append([*one.to_pixels[0], *one.to_pixels[1], PICTURE, one.opacity, sampling, next(begin), 0])
            continue
        focus = one.focus or (-1.0, -1.0)
        rows.append([*one.to_ramp[0], *one.to_ramp[1], *focus, one.spread, len(stops), len(one.stops)])
        stops += [(*stop.color, stop.opacity, stop.offset) for stop in one.stops]
    return Shades(np.array(rows, np.float64).reshape(-1, 11), np.array(stops, np.float64).reshape(-1, 5), pixels)


def pack_color(color: Color) -> int:
    """Return a colour as a number: red, green and blue, from the low byte up."""
    return sum(round(BYTE * part) << 8 * c for c, part in enumerate(color))


def unpack_color(number: int) -> Color:
    """Return the colour that `pack_color` made a number."""
    red, green, blue = ((number >> 8 * c & BYTE) / BYTE for c in range(3))
    return red, green, blue


def shade_of(shades: Shades, number: int) -> Shade:
    """Gradient or picture with a number."""
    row = shades.rows[number].tolist()
    first, count = int(row[FIRST]), int(row[COUNT])
    rows = (row[0], row[1], row[2]), (row[3], row[4], row[5])
    if row[FOCUS] == PICTURE:
        word = int(row[SPREAD])
        sampling = Sampling(word & (1 << SAMPLING_BITS) - 1)
        color = unpack_color(word >> SAMPLING_BITS) if sampling.components == 1 else None
        return Picture(rows, pixels_at(shades.pixels, first, sampling.components), sampling, row[RADIUS], color)
    stops = [Stop(t, (r, g, b), a) for r, g, b, a, t in shades.stops[first : first + count].tolist()]
    focus = None if row[FOCUS] < 0.0 else (row[FOCUS], row[RADIUS])
    return Gradient(rows, tuple(stops), Spread(int(row[SPREAD])), focus)


@kernel(allocates=False)
def _ramp_place(focus: float, radius: float, x: float, y: float) -> float:
    """Greatest t whose circle goes through a point and has a radius of at least 0; NaN if there is none.

    With q from the focal point to the point: |q - t c|^2 = (fr + t dr)^2, where c = (-fx, 0) and dr = 1 - fr.
    """
    q, grows = x - focus, 1.0 - radius
    a = focus * focus - grows * grows
    b = radius * grows - q * focus
    c = q * q + y * y - radius * radius
    inside = b * b - a * c
    if inside < 0.0:
        return np.nan
    far = b + np.copysign(np.sqrt(inside), b)  # the roots are far / a and c / far, without cancellation
    first = far / a if a != 0.0 else -np.inf
    second = c / far if far != 0.0 else -np.inf
    for t in (max(first, second), min(first, second)):
        if abs(t) < np.inf and radius + t * grows >= 0.0:
            return t
    return np.nan


@kernel(allocates=False)
def _spread(spread: int, t: float) -> float:
    """Place on the ramp from 0 to 1; unchanged if padded, because the first and last colours continue."""
    if spread == REPEAT:
        return t - np.floor(t)
    if spread == REFLECT:
        return 1.0 - abs(1.0 - t % 2.0)
    return t


@kernel(allocates=False)
def flat_shade(shades: Shades, number: int, out: NDArray[np.float64]) -> bool:
    """Write the premultiplied colour (4,) of a gradient or picture and return True, if it is the same everywhere."""
    row = shades.rows[number]
    if row[FOCUS] == PICTURE:
        if shades.pixels[int(row[FIRST]) + SIZE] != ONE_PIXEL:
            return False
        shade_over(shades, number, (0.0, 0.0), (0.0, 0.0), out)
        return True
    if row[COUNT] != 1.0 or row[FOCUS] + row[RADIUS] >= 1.0:
        return False
    stop = shades.stops[int(row[FIRST])]
    for c in range(3):
        out[c] = stop[c] * stop[3]
    out[3] = stop[3]
    return True


@kernel(allocates=False)
def shade_at(shades: Shades, number: int, x: float, y: float, out: NDArray[np.float64]) -> None:
    """Write the premultiplied colour (4,) of a gradient at a point of the unit square."""
    row, stops = shades.rows[number], shades.stops
    t = row[0] * x + row[1] * y + row[2]
    if row[FOCUS] >= 0.0:
        t = _ramp_place(row[FOCUS], row[RADIUS], t, row[3] * x + row[4] * y + row[5])
    for c in range(4):
        out[c] = 0.0
    if np.isnan(t):
        return
    t = _spread(int(row[SPREAD]), t)
    first = int(row[FIRST])
    last = first + int(row[COUNT]) - 1
    k = first
    while k <= last and stops[k, OFFSET] <= t:
        k += 1
    low, high = max(k - 1, first), min(k, last)
    way = stops[high, OFFSET] - stops[low, OFFSET]
    share = (t - stops[low, OFFSET]) / way if low < high else 0.0
    for c in range(4):
        out[c] = stops[low, c] + share * (stops[high, c] - stops[low, c])
    for c in range(3):
        out[c] *= out[3]


@kernel(allocates=False)
def _length(x: float, y: float) -> float:
    """Length of a vector; `hypot` of the C library differs from platform to platform."""
    return np.sqrt(x * x + y * y)


@kernel(allocates=False)
def shade_over(
    shades: Shades,
    number: int,
    middle: tuple[float, float],
    size: tuple[float, float],
    out: NDArray[np.float64],
) -> None:
    """Write the premultiplied colour (4,) over a box of the unit square: a picture's mean, a gradient's in the middle.

    If the sides of the box are not parallel to those of the pixels, it is replaced by a box of pixels with the same
    variances.
    """
    row, (x, y), (width, height) = shades.rows[number], middle, size
    if row[FOCUS] != PICTURE:
        shade_at(shades, number, x, y, out)
        return
    place = row[0] * x + row[1] * y + row[2], row[3] * x + row[4] * y + row[5]
    across, down = _length(row[0] * width, row[1] * height), _length(row[3] * width, row[4] * height)
    word = int(row[SPREAD])
    sampling, color = word & (1 << SAMPLING_BITS) - 1, word >> SAMPLING_BITS
    mean_of_picture(shades.pixels, int(row[FIRST]), sampling, place, (across, down), out)
    if sampling >= OPACITY:
        opacity = 1.0 - out[0] if sampling == INVERSE else out[0]
        for c in range(3):
            out[c] = opacity * ((color >> 8 * c & BYTE) / BYTE)
        out[3] = opacity
    for c in range(4):
        out[c] *= row[RADIUS]


@kernel(allocates=False)
def is_opaque_shade(rows: NDArray[np.float64], stops: NDArray[np.float64], pixels: NDArray[np.uint32], k: int) -> bool:
    """Whether nothing below shows through any part of a gradient or picture, as `Paint.is_opaque` says."""
    row = rows[k]
    if row[FOCUS] == PICTURE:
        return row[RADIUS] >= 1.0 and pixels[int(row[FIRST]) + IS_OPAQUE] == 1
    for stop in range(int(row[FIRST]), int(row[FIRST] + row[COUNT])):
        if stops[stop, 3] < 1.0:
            return False
    return row[FOCUS] < 0.0 or row[FOCUS] + row[RADIUS] < 1.0  # otherwise it is a cone with nothing beside it
