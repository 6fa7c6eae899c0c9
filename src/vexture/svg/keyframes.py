"""Animations by style sheets (CSS Animations 1): what they declare when their document begins."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import cycle, islice
from math import floor, inf
from typing import Any, Final

import tinycss2

from vexture.svg.between import between
from vexture.svg.properties import PROPERTIES
from vexture.svg.timing import SHORTEST, bezier, seconds
from vexture.svg.values import TooLargeError, number

__all__ = [
    "KEYFRAMES",
    "LONGHANDS",
    "Keyframes",
    "animation_longhands",
    "declared_at_start",
    "names_of",
    "read_keyframes",
]

KEYFRAMES: Final = ("keyframes", "-webkit-keyframes")
"""At-rules that have them."""

OFFSETS: Final = {"from": 0.0, "to": 1.0}
EASES: Final = {
    "linear": "0 0 1 1",
    "ease": "0.25 0.1 0.25 1",
    "ease-in": "0.42 0 1 1",
    "ease-out": "0 0 0.58 1",
    "ease-in-out": "0.42 0 0.58 1",
}
STEPS: Final = {"step-start": (1, True), "step-end": (1, False)}
STEPPING: Final = re.compile(r"steps\(\s*(\d{1,9})\s*(?:,\s*([a-z-]+)\s*)?\)")

LISTED: Final = re.compile(r",(?![^()]*\))")
PARTED: Final = re.compile(r"\s+(?![^()]*\))")

WORDS: Final = {
    "animation-direction": {"normal", "reverse", "alternate", "alternate-reverse"},
    "animation-fill-mode": {"none", "forwards", "backwards", "both"},
    "animation-play-state": {"running", "paused"},  # which the start does not depend on
}
TIMES: Final = ("animation-duration", "animation-delay")
EASED: Final = "animation-timing-function"
COUNTED: Final = "animation-iteration-count"
NAMED: Final = "animation-name"
TIMED: Final = (*TIMES, COUNTED, "animation-direction", "animation-fill-mode", EASED)
LONGHANDS: Final = (NAMED, *TIMED)

MOST: Final = 1e9
"""Rounds of an animation."""

Keyframes = list[tuple[float, dict[str, str]]]
"""Declarations at each part of the way, in rising order."""


def read_keyframes(rule: Any, read: Callable[[Any], Iterable[tuple[str, str, bool]]]) -> tuple[str, Keyframes]:
    """Name and frames of a rule; `read` yields the declarations of a block. What is important is ignored in them."""
    name = tinycss2.serialize(rule.prelude).strip().strip("\"'")
    frames = dict[float, dict[str, str]]()
    for frame in tinycss2.parse_rule_list(rule.content or [], skip_comments=True, skip_whitespace=True):
        if frame.type != "qualified-rule":
            continue
        found = {name: value for name, value, important in read(frame.content) if not important}
        for text in tinycss2.serialize(frame.prelude).lower().split(","):
            offset = OFFSETS.get(text.strip())
            if offset is None and text.strip().endswith("%"):
                percent = count(text.strip()[:-1])
                offset = None if percent is None else percent / 100.0
            if offset is not None and 0.0 <= offset <= 1.0:
                frames.setdefault(offset, {}).update(found)
    return name, sorted(frames.items(), key=lambda frame: frame[0])


def count(text: str) -> float | None:
    """A number; None if the text is none, or it is too large."""
    try:
        return number(text)
    except TooLargeError:
        return None


def animation_longhands(text: str) -> Iterator[tuple[str, str]]:
    """Yield what the shorthand `animation` says, property by property, each a list.

    Examples
    --------
    >>> dict(animation_longhands("2s spin infinite, fade 1s -0.5s both"))["animation-delay"]
    '0s, -0.5s'
    """
    listed = [read_animation(part) for part in LISTED.split(text)]
    for name in LONGHANDS:
        yield name, ", ".join(one.get(name, PROPERTIES[name].initial) for one in listed)


def read_animation(text: str) -> dict[str, str]:
    """What one animation of the shorthand says."""
    found = dict[str, str]()
    for word in PARTED.split(text.strip()):
        low = word.lower()
        kinds = [name for name, words in WORDS.items() if low in words and name not in found]
        if seconds(low) is not None and low.endswith("s"):
            kinds = [name for name in TIMES if name not in found]
        elif low in EASES or low in STEPS or "(" in low:
            kinds = [EASED]
        elif low == "infinite" or count(low) is not None:
            kinds = [COUNTED]
        found.setdefault(kinds[0] if kinds else NAMED, word)
    return found


def names_of(style: Mapping[str, str]) -> list[str]:
    """Names of the animations of an element, by its declarations."""
    return [name.strip().strip("\"'") for name in LISTED.split(style.get(NAMED, "none"))]


@dataclass(frozen=True, slots=True)
class Timing:
    """How one animation of an element runs."""

    duration: float
    delay: float
    count: float
    direction: str
    fill: str
    ease: str

    @property
    def part(self) -> float | None:
        """Part of its way, 0..1, at which the animation is at the start; None if it has no effect then."""
        over = self.duration == 0.0 or -self.delay >= self.duration * self.count
        if (self.delay > 0.0 and self.fill not in ("backwards", "both")) or (
            self.delay <= 0.0 and over and self.fill not in ("forwards", "both")
        ):
            return None
        passed = 0.0
        if self.delay <= 0.0:
            passed = min(self.count, MOST) if over else -self.delay / self.duration
        rounds = floor(passed)
        if over and self.delay <= 0.0 and rounds == passed and rounds:
            rounds -= 1
        back = self.direction == "reverse"
        if self.direction.startswith("alternate"):
            back = (rounds % 2 == 1) != self.direction.endswith("reverse")
        part = min(passed - rounds, 1.0)
        return 1.0 - part if back else part


def timings(style: Mapping[str, str], so_many: int) -> Iterator[Timing]:
    """Yield how each of so many animations of an element runs."""
    columns = [
        islice(cycle(part.strip().lower() for part in LISTED.split(style.get(name, PROPERTIES[name].initial))), so_many)
        for name in TIMED
    ]
    for duration, delay, times, direction, fill, ease in zip(*columns, strict=True):
        length = seconds(duration) or 0.0
        rounds = inf if times == "infinite" else count(times)
        yield Timing(
            0.0 if length < SHORTEST else length,
            seconds(delay) or 0.0,
            1.0 if rounds is None else max(rounds, 0.0),
            direction,
            fill,
            ease,
        )


def declared_at_start(style: Mapping[str, str], known: Mapping[str, Keyframes]) -> Iterator[tuple[str, str]]:
    """Yield what the animations of an element declare at the start, by its own declarations, the last one last."""
    names = names_of(style)
    for name, timing in zip(names, timings(style, len(names)), strict=True):
        part = timing.part if name in known else None
        if part is None:
            continue
        for key in dict.fromkeys(key for _, frame in known[name] for key in frame if key != EASED):
            value = value_at(known[name], key, part, timing.ease, style.get(key))
            if value is not None:
                yield key, value


def value_at(frames: Keyframes, key: str, part: float, ease: str, base: str | None) -> str | None:
    """Value of a property at a part of the way; None for the base."""
    stops = [(offset, frame[key], frame.get(EASED, ease)) for offset, frame in frames if key in frame]
    before = [stop for stop in stops if stop[0] <= part]
    after = [stop for stop in stops if stop[0] > part]
    start, first, how = before[-1] if before else (0.0, None, ease)
    if start == part:
        return first
    stop, last, _ = after[0] if after else (1.0, None, ease)
    initial = PROPERTIES[key].initial
    eased = eased_part(how, (part - start) / (stop - start))
    value = between(first or base or initial, last or base or initial, eased)
    return value or (first if eased < 0.5 else last)


def eased_part(ease: str, part: float) -> float:
    """Part of the way at a part of the time."""
    stepping = STEPPING.fullmatch(ease.lower())
    steps, early = STEPS.get(ease.lower(), (0, False))
    if stepping is not None:
        steps, early = int(stepping[1]), stepping[2] in ("start", "jump-start")
    if steps:
        return min((floor(part * steps) + early) / steps, 1.0)
    curve = bezier(EASES.get(ease.lower(), ease.lower().removeprefix("cubic-bezier(").removesuffix(")")))
    return part if curve is None else curve(part)
