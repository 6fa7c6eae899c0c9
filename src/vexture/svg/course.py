"""The course of an animation: the values that its attributes say, one after another, and the one at a time."""

from collections.abc import Callable
from typing import Final

from lxml import etree

from vexture.svg.between import UnclearError, added
from vexture.svg.mixing import BY_HALF, attribute_between
from vexture.svg.timing import Progress, bezier
from vexture.svg.values import number

__all__ = ["Mix", "along", "known", "said", "values_of"]

HALF: Final = 0.5

Mix = Callable[[str, str, float], str | None]
"""What makes a value at a part of the way from one to another."""


def said(element: etree._Element) -> set[str]:
    """Which of the attributes for values an animation has; `values` override all others, `to` overrides `by`."""
    given = {name for name in ("values", "from", "to", "by") if element.get(name) is not None}
    if "values" in given:
        return {"values"}
    return given - {"by"} if "to" in given else given


def values_of(element: etree._Element, base: str | None) -> list[str | None]:
    """Values of an animation, one after another; None is the base, where it is not known."""
    given = said(element)
    if given == {"values"}:
        values = [value.strip() for value in element.get("values", "").split(";")]
        return [*values[:-1], *filter(None, values[-1:])]
    first, last = element.get("from", "").strip(), element.get("to", "").strip()
    if "to" in given:
        return [first if "from" in given else base, last]
    if "by" not in given:
        return []
    first_value = first if "from" in given else base
    return [first_value, first_value and added(first_value, element.get("by", "").strip())]


def along(element: etree._Element, values: list[str | None], how: Progress, mix: Mix | None = None) -> str | None:
    """The value of an animation as far as it is; None for the base, raises an `UnclearError` if it is not known.

    `mix` makes the value at a part of the way from one to another, or None where they jump.
    """
    times = times_of(element, len(values))
    if times is None:
        return None
    name = element.get("attributeName", "").strip()
    value = at(element, values, times, how.part, mix or (lambda *pair: attribute_between(name, *pair)))
    if how.round and element.get("accumulate") == "sum":
        value = known(added(known(value), known(values[-1]), how.round))
    return value


def at(element: etree._Element, values: list[str | None], times: list[float], part: float, mix: Mix) -> str | None:
    """The value at a part of the simple duration, by the times of the values."""
    mode = element.get("calcMode", "linear")
    if part == 0.0 or len(values) == 1:
        return values[0]
    if mode == "discrete":
        return values[max(k for k, time in enumerate(times) if time <= part)]
    if part == 1.0:
        return known(values[-1])
    if mode == "paced" and len(values) > 2:
        raise UnclearError
    k = max(k for k, time in enumerate(times[:-1]) if time <= part)
    way = (part - times[k]) / (times[k + 1] - times[k])
    ease = bezier(element.get("keySplines", "").split(";")[k]) if mode == "spline" else None
    way = way if ease is None else ease(way)
    first, second = known(values[k]), known(values[k + 1])
    value = mix(first, second, way)
    if value is not None:
        return value
    if element.get("attributeName") in BY_HALF:
        return first if way < HALF else second
    if element.get("keyTimes") is None:
        return values[min(int(part * len(values)), len(values) - 1)]
    return values[max(k for k, time in enumerate(times) if time <= part)]


def known(value: str | None) -> str:
    """A value; raises an `UnclearError` if it is not known."""
    if value is None:
        raise UnclearError
    return value


def times_of(element: etree._Element, count: int) -> list[float] | None:
    """Parts of its simple duration at which an animation has its values; None if it is in error."""
    mode, text = element.get("calcMode", "linear"), element.get("keyTimes")
    if mode == "spline" and len([*filter(str.strip, element.get("keySplines", "").split(";"))]) != count - 1:
        return None
    if text is None or mode == "paced":
        return (
            [k / count for k in range(count)] if mode == "discrete" else [k / max(count - 1, 1) for k in range(count)]
        )
    times = [number(time) for time in text.rstrip("; \t\n").split(";")]
    found = [time for time in times if time is not None]
    ends = len(found) == len(times) == count and found[0] == 0.0 and (mode == "discrete" or found[-1] == 1.0)
    return found if ends and sorted(found) == found and found[-1] <= 1.0 else None
