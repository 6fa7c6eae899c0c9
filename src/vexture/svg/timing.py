"""Times of animations: clock values, what of an animation is seen at the start, and how it goes on (SMIL 3.0)."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from math import floor, inf
from typing import Final

from lxml import etree

from vexture.svg.path_data import NUMBER
from vexture.svg.values import LARGEST, number

__all__ = ["END", "SHORTEST", "Progress", "bezier", "progress", "seconds"]

CLOCK: Final = re.compile(r"([+-]?)\s*(?:(?:(\d+):)?(\d\d?):(\d\d?(?:\.\d*)?)|(\d+(?:\.\d*)?|\.\d+)(h|min|s|ms)?)")
SECONDS: Final = {None: 1.0, "h": 3600.0, "min": 60.0, "s": 1.0, "ms": 0.001}

CUBIC: Final = re.compile(rf"\s*({NUMBER})[\s,]+({NUMBER})[\s,]+({NUMBER})[\s,]+({NUMBER})\s*")
HALVINGS: Final = 40
DIGITS: Final = 9
"""Of a part of a way, so that half of one is half."""

SHORTEST: Final = 1e-6
"""Seconds: what is to last less has no duration, and stays as it begins."""


@dataclass(frozen=True, slots=True)
class Progress:
    """How far an animation is."""

    part: float  # of its simple duration, 0..1
    round: int = 0  # how often that has passed before
    begin: float = -inf  # when it began, in seconds, 0 at most


END: Final = Progress(1.0)
"""Where every animation ends."""


def seconds(text: str) -> float | None:
    """Value of a clock in seconds; None if the text is none.

    Examples
    --------
    >>> seconds("-0.5s"), seconds("1:30"), seconds("20ms"), seconds("click")
    (-0.5, 90.0, 0.02, None)
    """
    match = CLOCK.fullmatch(text.strip())
    if match is None:
        return None
    sign, hours, minutes, rest, count, unit = match.groups()
    time = float(count) * SECONDS[unit] if count else 3600.0 * float(hours or 0) + 60.0 * float(minutes) + float(rest)
    return None if time > LARGEST else -time if sign == "-" else time


def progress(element: etree._Element) -> Progress | None:
    """How far the animation by an element is when its document begins; None if it has no effect then.

    Events do not happen before, and what begins or ends with another animation does so later.

    Examples
    --------
    >>> progress(etree.fromstring('<animate begin="-3s; click; 2s" dur="4s"/>'))
    Progress(part=0.75, round=0, begin=-3.0)
    """
    begins = clocks(element.get("begin", "0"))
    end = element.get("end", "")
    ends, open_ended = clocks(end), len(clocks(end)) < len(end.split(";")) or not end
    duration = seconds(element.get("dur", "")) or 0.0
    duration = duration if duration >= SHORTEST else inf
    restart = element.get("restart", "always")
    begin, length = None, 0.0
    for time in begins:
        free = begin is None or restart == "always" or (restart == "whenNotActive" and time >= begin + length)
        if time <= 0.0 and free:
            last = next((end - time for end in ends if end >= time), inf if open_ended else 0.0)
            begin, length = time, min(active(element, duration), last)
    if begin is None or -begin >= length:  # what is over before the start has never been (SMIL 3.0, 5.6.4)
        return None
    passed = -begin / duration
    return Progress(passed - floor(passed), floor(passed), begin)


def clocks(text: str) -> list[float]:
    """Values of the clocks in a list of begins or ends, in rising order."""
    return sorted(time for time in map(seconds, text.split(";")) if time is not None)


def active(element: etree._Element, duration: float) -> float:
    """How long an animation lasts, with its repetitions, in seconds."""
    count, whole = element.get("repeatCount"), seconds(element.get("repeatDur", ""))
    times = number(count) if count and count != "indefinite" else None
    limits = [duration * times if times and times > 0.0 else inf, whole or inf]
    return min(limits) if count or whole or element.get("repeatDur") else duration


def bezier(text: str) -> Callable[[float], float] | None:
    """How a part of a time becomes one of a way, by the inner points of a cubic; None if they are not four numbers.

    Examples
    --------
    >>> ease = bezier("0.5 0 0.5 1")
    >>> round(ease(0.5), 3), round(ease(0.25), 3)
    (0.5, 0.106)
    """
    match = CUBIC.fullmatch(text)
    if match is None:
        return None
    x1, y1, x2, y2 = map(float, match.groups())
    if not (0.0 <= x1 <= 1.0 and 0.0 <= x2 <= 1.0):
        return None
    if x1 == y1 and x2 == y2:
        return lambda part: part

    def at(first: float, second: float, t: float) -> float:
        return 3.0 * t * (1.0 - t) * ((1.0 - t) * first + t * second) + t**3

    def ease(part: float) -> float:
        low, high = 0.0, 1.0
        for _ in range(HALVINGS):
            middle = (low + high) / 2.0
            low, high = (middle, high) if at(x1, x2, middle) < part else (low, middle)
        return round(at(y1, y2, (low + high) / 2.0), DIGITS)

    return ease
