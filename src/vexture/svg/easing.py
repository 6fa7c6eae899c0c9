"""Easing functions of CSS (CSS Easing 2): what part of a way an animation has gone at a part of its time."""

import re
from itertools import pairwise
from math import floor
from typing import Final

from vexture.svg.timing import bezier
from vexture.svg.values import TooLargeError, number, words

__all__ = ["EASES", "STEPS", "eased"]

EASES: Final = {
    "linear": "0 0 1 1",
    "ease": "0.25 0.1 0.25 1",
    "ease-in": "0.42 0 1 1",
    "ease-out": "0 0 0.58 1",
    "ease-in-out": "0.42 0 0.58 1",
}
STEPS: Final = {"step-start": (1, "start"), "step-end": (1, "end")}
STEPPING: Final = re.compile(r"steps\(\s*(\d{1,9})\s*(?:,\s*(?:jump-)?(start|end|none|both)\s*)?\)")
BENT: Final = re.compile(r"cubic-bezier\((.*)\)", re.DOTALL)
BROKEN: Final = re.compile(r"linear\((.*)\)", re.DOTALL)
COMMA: Final = re.compile(",")

DIGITS: Final = 9
"""Of a part of the time: a third of three steps is one of them."""


def eased(text: str, part: float, waits: bool = False) -> float | None:
    """Part of the way at a part of the time; None if the text is no easing function.

    `waits` says that the animation has not begun: steps that jump at their start have not, then.

    Examples
    --------
    >>> eased("step-start", 0.0), eased("steps(4, jump-none)", 0.5), eased("linear(0, 0.9 50%, 1)", 0.25)
    (1.0, 0.6666666666666666, 0.45)
    """
    low = text.strip().lower()
    stepping = STEPPING.fullmatch(low)
    steps, jump = (int(stepping[1]), stepping[2] or "end") if stepping else STEPS.get(low, (0, ""))
    if jump:
        return stepped(steps, jump, part, waits)
    broken = BROKEN.fullmatch(low)
    if broken:
        points = points_of(broken[1])
        return None if points is None else on_line(points, part)
    bent = BENT.fullmatch(low)
    curve = bezier(EASES.get(low, bent[1].replace(",", " ") if bent else ""))
    return None if curve is None else curve(part)


def stepped(steps: int, jump: str, part: float, waits: bool) -> float | None:
    """Part of the way in so many steps; None if they are too few."""
    jumps = steps + {"both": 1, "none": -1}.get(jump, 0)
    if steps < 1 or jumps < 1:
        return 0.0 if steps == 1 and jump == "none" else None  # browsers take that one step
    at = floor(round(part * steps, DIGITS)) + (jump in ("start", "both")) - waits
    return min(max(at, 0), jumps) / jumps


def points_of(text: str) -> list[tuple[float, float]] | None:
    """Parts of the time and of the way of a broken line; None if the text is none."""
    ways, times = list[float](), list[float | None]()
    for listed in words(text, COMMA):
        try:
            parts = [(part.endswith("%"), number(part.removesuffix("%"))) for part in listed.split()]
        except TooLargeError:
            return None
        way = [value for percent, value in parts if not percent and value is not None]
        at = [value / 100.0 for percent, value in parts if percent and value is not None]
        if len(way) != 1 or len(way) + len(at) != len(parts) or len(at) > 2:
            return None
        ways += way * max(len(at), 1)
        times += at or [None]
    return None if len(ways) < 2 else [*zip(spread(times), ways, strict=True)]


def spread(times: list[float | None]) -> list[float]:
    """Times that rise, with those between others at equal distances where they are not said."""
    times[0] = 0.0 if times[0] is None else times[0]
    times[-1] = 1.0 if times[-1] is None else times[-1]
    found = [(place, time) for place, time in enumerate(times) if time is not None]
    made, latest = [found[0][1]], found[0][1]
    for (first, _), (last, end) in pairwise(found):
        start, latest = latest, max(latest, end)
        made += [start + (latest - start) * k / (last - first) for k in range(1, last - first + 1)]
    return made


def on_line(points: list[tuple[float, float]], part: float) -> float:
    """Height of a line through points, which goes on beyond its ends."""
    before = sum(time <= part for time, _ in points)
    first = min(max(before - 1, 0), len(points) - 2)
    (start, low), (end, high) = points[first : first + 2]
    if end == start:
        return high if part >= end else low
    return low + (high - low) * (part - start) / (end - start)
