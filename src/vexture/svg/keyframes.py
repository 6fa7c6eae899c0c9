"""Animations by style sheets (CSS Animations 1 and 2): their frames, and how far they are when a document begins.

What they declare then is in `first_frame.py`.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import cycle, islice
from math import floor, inf
from typing import Any, Final

import tinycss2

from vexture.svg.easing import EASES, STEPS
from vexture.svg.properties import PROPERTIES
from vexture.svg.timing import SHORTEST, seconds
from vexture.svg.values import TooLargeError, number, words

__all__ = [
    "COMPOSED",
    "EASED",
    "KEYFRAMES",
    "LONGHANDS",
    "Keyframes",
    "Timing",
    "animation_longhands",
    "names_of",
    "read_keyframes",
    "timings",
]

KEYFRAMES: Final = ("keyframes", "-webkit-keyframes")
"""At-rules that have them."""

OFFSETS: Final = {"from": 0.0, "to": 1.0}
COMMA: Final = re.compile(",")
BLANK: Final = re.compile(r"\s+")

WORDS: Final = {
    "animation-direction": {"normal", "reverse", "alternate", "alternate-reverse"},
    "animation-fill-mode": {"none", "forwards", "backwards", "both"},
    "animation-play-state": {"running", "paused"},  # which the start does not depend on
}
TIMES: Final = ("animation-duration", "animation-delay")
EASED: Final = "animation-timing-function"
COUNTED: Final = "animation-iteration-count"
NAMED: Final = "animation-name"
COMPOSED: Final = "animation-composition"
"""Which the shorthand leaves alone."""

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
    listed = [read_animation(part) for part in words(text, COMMA)]
    for name in LONGHANDS:
        yield name, ", ".join(one.get(name, PROPERTIES[name].initial) for one in listed)


def read_animation(text: str) -> dict[str, str]:
    """What one animation of the shorthand says."""
    found = dict[str, str]()
    for word in words(text, BLANK):
        low = word.lower()
        kinds = [name for name, words in WORDS.items() if low in words and name not in found]
        if seconds(low) is not None and low.endswith("s"):
            kinds = [name for name in TIMES if name not in found]
        elif low in EASES or low in STEPS or "(" in low:
            kinds = [EASED] if EASED not in found else []
        elif low == "infinite" or count(low) is not None:
            kinds = [COUNTED]
        found.setdefault(kinds[0] if kinds else NAMED, word)
    return found


def names_of(style: Mapping[str, str]) -> list[str]:
    """Names of the animations of an element, by its declarations."""
    return [name.strip().strip("\"'") for name in words(style.get(NAMED, "none"), COMMA)]


@dataclass(frozen=True, slots=True)
class Timing:
    """How one animation of an element runs."""

    duration: float
    delay: float
    count: float
    direction: str
    fill: str
    ease: str
    composition: str

    @property
    def waits(self) -> bool:
        """Whether the animation shows its first frame before it begins."""
        return self.delay > 0.0 and self.direction in ("normal", "alternate")

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
        islice(cycle(words(style.get(name, PROPERTIES[name].initial).lower(), COMMA) or [""]), so_many)
        for name in (*TIMED, COMPOSED)
    ]
    for duration, delay, times, direction, fill, ease, composition in zip(*columns, strict=True):
        length = seconds(duration) or 0.0
        rounds = inf if times == "infinite" else count(times)
        yield Timing(
            0.0 if length < SHORTEST else length,
            seconds(delay) or 0.0,
            1.0 if rounds is None else max(rounds, 0.0),
            direction,
            fill,
            ease,
            composition,
        )
