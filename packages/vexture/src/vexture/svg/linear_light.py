"""Gradients in linear light, as more stops of one in sRGB (SVG 2, 13.9, `color-interpolation`)."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Final

from vexture.drawing.paint import Color, Stop

BEND: Final = 0.4 / 255
"""Largest distance of a component from the curve at a few points between two stops: 0.5/255 in between."""

PARTS: Final = (0.25, 0.5, 0.75)
"""Places between two stops where the distance is measured."""


def decode(part: float) -> float:
    """Return a component of sRGB in linear light."""
    return part / 12.92 if part <= 0.04045 else float(((part + 0.055) / 1.055) ** 2.4)


def encode(part: float) -> float:
    """Return a component in linear light as sRGB.

    Examples
    --------
    >>> round(encode(0.5), 3), round(encode(decode(0.5)), 9)
    (0.735, 0.5)
    """
    return 12.92 * part if part <= 0.0031308 else min(float(1.055 * part ** (1 / 2.4) - 0.055), 1.0)


def stops_in_linear_light(stops: tuple[Stop, ...], most: int) -> tuple[tuple[Stop, ...], float]:
    """Return stops, between which sRGB is interpolated, for ones between which linear light is, and their error.

    The error of a component is 0.5/255, or as large as is necessary for at most some number of stops.

    Examples
    --------
    >>> ends = Stop(0.0, (0.0, 0.0, 0.0)), Stop(1.0, (1.0, 1.0, 1.0))
    >>> [(len(stops), round(255 * error, 1)) for stops, error in (stops_in_linear_light(ends, n) for n in (128, 10))]
    [(24, 0.5), (10, 4.0)]
    """
    bend = BEND
    while True:
        found = list(stops[:1])
        for before, after in pairwise(stops):
            found += [*halves(before, after, bend), after] if after.offset > before.offset else [after]
        if len(found) <= max(most, len(stops)):
            return tuple(found), bend * 0.5 / 0.4
        bend *= 2.0


def halves(before: Stop, after: Stop, bend: float) -> Iterator[Stop]:
    """Yield the stops that are needed between two, in order: each one in the middle of others."""
    middle = mix_stops(before, after, 0.5)
    if before.offset < middle.offset < after.offset and distance(before, after) > bend:
        yield from halves(before, middle, bend)
        yield middle
        yield from halves(middle, after, bend)


def mix_stops(before: Stop, after: Stop, part: float) -> Stop:
    """Return the stop between two, in linear light; opacity is interpolated as it is."""
    red, green, blue = (
        encode(decode(one) + part * (decode(other) - decode(one)))
        for one, other in zip(before.color, after.color, strict=True)
    )
    color: Color = (red, green, blue)
    opacity = before.opacity + part * (after.opacity - before.opacity)
    return Stop(before.offset + part * (after.offset - before.offset), color, opacity)


def distance(before: Stop, after: Stop) -> float:
    """Return the largest distance of a component in linear light from the straight line between two stops."""
    found = 0.0
    for part in PARTS:
        color = mix_stops(before, after, part).color
        for k in range(3):
            found = max(found, abs(color[k] - before.color[k] - part * (after.color[k] - before.color[k])))
    return found
