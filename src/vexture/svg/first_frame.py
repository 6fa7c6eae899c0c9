"""What the animations of an element by style sheets declare when its document begins (CSS Animations 1, 4)."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Final

from vexture.deadline import check_time
from vexture.svg.between import UnclearError
from vexture.svg.declarations import expanded, longhands
from vexture.svg.easing import eased
from vexture.svg.keyframes import COMPOSED, EASED, Keyframes, Timing, names_of, timings
from vexture.svg.mixing import composed, value_between
from vexture.svg.properties import KEYWORDS, PROPERTIES, UNSET
from vexture.svg.values import TooLargeError
from vexture.svg.variables import refers, substituted

__all__ = ["Around", "FirstFrame", "animated_variables", "first_frame"]

MOST: Final = 1_000
"""Animations of one element."""

ANIMATION: Final = "animation-"
"""Of properties that are not animated themselves."""

CUSTOM: Final = "--"

HALF: Final = 0.5

NO_FRAME: Final[dict[str, str]] = {}
"""What an animation without a first or a last frame has there."""

DEFAULT: Final = PROPERTIES[EASED].initial


@dataclass(frozen=True, slots=True)
class Around:
    """What the values of an element's properties depend on."""

    own: Mapping[str, str]  # what the element says without animations
    variables: Mapping[str, str]  # its custom properties
    inherited: Callable[[str], str]  # values of what is around it

    def value(self, name: str, text: str | None) -> str:
        """Value of a property without the keywords that all properties have."""
        entry = PROPERTIES[name]
        keyword = ("unset" if text is None else text).lower()
        if keyword == "inherit" or (keyword in UNSET and entry.inherited):
            return self.inherited(name)
        return entry.initial if text is None or keyword in KEYWORDS else text

    def base(self, name: str) -> str | None:
        """Value without animations; None if a custom property has none."""
        if name.startswith(CUSTOM):
            return self.variables.get(name)
        return self.value(name, self.own.get(name))


@dataclass(slots=True)
class FirstFrame:
    """What animations declare at the start."""

    values: dict[str, str] = field(default_factory=dict)
    invalid: dict[tuple[str, str], None] = field(default_factory=dict)
    is_unclear: bool = False  # whether there is something that is not known


def first_frame(around: Around, known: Mapping[str, Keyframes]) -> FirstFrame:
    """What the animations of an element declare at the start, the last one over those before it."""
    found, plain = FirstFrame(), dict[str, Keyframes]()
    for name, timing, part in running(around.own, known, found):
        if name not in plain:
            plain[name] = [(offset, dict(declared(frame, around, found))) for offset, frame in known[name]]
        animate(found, plain[name], timing, part, around)
    return found


def animated_variables(around: Around, known: Mapping[str, Keyframes]) -> dict[str, str]:
    """Custom properties that the animations of an element declare at the start."""
    found = FirstFrame()
    for called, timing, part in running(around.own, known, found):
        custom = [
            (offset, {name: text for name, text in frame.items() if name.startswith(CUSTOM) or name == EASED})
            for offset, frame in known[called]
        ]
        animate(found, custom, timing, part, around)
    return found.values


def running(
    style: Mapping[str, str], known: Mapping[str, Keyframes], found: FirstFrame
) -> Iterator[tuple[str, Timing, float]]:
    """Yield the names of the animations that have an effect at the start, how they run, and how far they are."""
    names = names_of(style)
    if len(names) > MOST:
        found.is_unclear = True
        return
    for name, timing in zip(names, timings(style, len(names)), strict=True):
        check_time()
        part = timing.part if name in known else None
        if part is not None:
            yield name, timing, part


def declared(frame: Mapping[str, str], around: Around, found: FirstFrame) -> Iterator[tuple[str, str]]:
    """Yield what a frame declares of properties that can be animated, without references and keywords."""
    for name, text in frame.items():
        if name in (EASED, COMPOSED):
            yield name, text
        elif not name.startswith((ANIMATION, CUSTOM)):
            plain = substituted(text, around.variables.get) if refers(text) else text
            for longhand, part in pairs_of(name, "unset" if plain is None else plain):
                if longhand in PROPERTIES and (part.lower() in KEYWORDS or PROPERTIES[longhand].allows(part)):
                    yield longhand, around.value(longhand, part)
                else:
                    found.invalid[longhand, part] = None


def pairs_of(name: str, text: str) -> list[tuple[str, str]]:
    """The properties that one and its value set; itself, if it is not valid."""
    if text.lower() in KEYWORDS:
        return [(longhand, text) for longhand in longhands(name)]
    return [*expanded(name, text)] or [(name, text)]


def animate(found: FirstFrame, frames: Keyframes, timing: Timing, part: float, around: Around) -> None:
    """Add what one animation declares over those before it."""
    for name in dict.fromkeys(name for _, frame in frames for name in frame if name not in (EASED, COMPOSED)):
        check_time()
        under = found.values.get(name, around.base(name))
        try:
            value = value_at(frames, name, part, timing, under)
        except (TooLargeError, UnclearError):
            found.is_unclear = True
            continue
        if value is not None:
            found.values[name] = value


def value_at(frames: Keyframes, name: str, part: float, timing: Timing, under: str | None) -> str | None:
    """Value of a property at a part of the way; None for the one under it."""
    stops = [(offset, frame) for offset, frame in frames if name in frame]
    start, before = next((one for one in reversed(stops) if one[0] <= part), (0.0, NO_FRAME))
    end, after = next((one for one in stops if one[0] > part), (1.0, NO_FRAME))
    first, last = (stop(frame, name, timing, under) for frame in (before, after))
    if start == end:
        return first
    how = before.get(EASED, timing.ease)
    passed = (part - start) / (end - start)
    way = next(way for text in (how, timing.ease, DEFAULT) if (way := eased(text, passed, timing.waits)) is not None)
    if way in (0.0, 1.0) or first == last or name.startswith(CUSTOM):
        return first if way < HALF else last
    value = value_between(name, first or under or "", last or under or "", way)
    return (first if way < HALF else last) if value is None else value


def stop(frame: Mapping[str, str], name: str, timing: Timing, under: str | None) -> str | None:
    """Value of a property in a frame, with the one under it if they are added; None where it says none."""
    value, how = frame.get(name), frame.get(COMPOSED, timing.composition)
    return value if value is None or under is None or name.startswith(CUSTOM) else composed(name, under, value, how)
