"""Path data between two others (SVG 2, 9.3; CSS Shapes 2): commands of the same kinds, wherever they count from."""

import re
from typing import Final

from vexture.svg.between import Way
from vexture.svg.path_data import ARC, ARGUMENTS, COMMANDS, NUMBERS

__all__ = ["path_between"]

IN_CSS: Final = re.compile(r"path\(\s*(?:(evenodd|nonzero)\s*,\s*)?(['\"])(.*?)\2\s*\)", re.DOTALL | re.IGNORECASE)

Segment = tuple[str, tuple[float, ...]]
"""A command, in capitals, and its arguments, which count from the origin."""

FLAGS: Final = slice(3, 5)
"""Arguments of an arc that are no lengths."""

HALF: Final = 0.5


def path_between(first: str, second: str, way: Way) -> str | None:
    """Path data made of two; None if their commands are not of the same kinds.

    Examples
    --------
    >>> path_between("M0 0h10v10z", "m10 10H30v20Z", Way(0.5))
    'M5.0 5.0H20.0V20.0Z'
    """
    css = IN_CSS.fullmatch(first.strip()), IN_CSS.fullmatch(second.strip())
    rules = {(match[1] or "nonzero").lower() for match in css if match is not None}
    start, end = (segments(match[3] if match else text) for match, text in zip(css, (first, second), strict=True))
    if len(rules) > 1 or not start or [one for one, _ in start] != [one for one, _ in end]:
        return None
    made = list[str]()
    for (letter, mine), (_, theirs) in zip(start, end, strict=True):
        values = [way.number(a, b) for a, b in zip(mine, theirs, strict=True)]
        texts = [*map(repr, values)]
        if letter == "A":
            texts[FLAGS] = [f"{flag:.0f}" for flag in (mine if way.part < HALF else theirs)[FLAGS]]
        made.append(letter + " ".join(texts))
    data = "".join(made)
    return f'path("{data}")' if any(css) else data


def segments(data: str) -> list[Segment]:
    """Commands of path data, up to the first error."""
    found, at, possible = list[Segment](), len(data) - len(data.lstrip()), "Mm"
    place = start = (0.0, 0.0)
    while at < len(data) and data[at] in possible:
        letter, possible = data[at], "MmLlTtHhVvCcSsQqAaZz"
        command = letter.upper()
        match = COMMANDS[command].match(data, at + 1)
        if match is None:
            break
        at = match.end()
        if command == "Z":
            found.append(("Z", ()))
            place = start
            continue
        for values in arguments(command, match[1]):
            moved = absolute(command, values, place) if letter.islower() else values
            found.append((command, moved))
            x, y = place
            place = {"H": (moved[0], y), "V": (x, moved[0])}.get(command, (moved[-2:][0], moved[-1]))
            start = place if command == "M" else start
            command = "L" if command == "M" else command  # further pairs are lines
    return found


def arguments(command: str, text: str) -> list[tuple[float, ...]]:
    """Arguments of a command, once or more."""
    if command == "A":
        return [tuple(map(float, found)) for found in ARC.findall(text)]
    numbers, count = [*map(float, NUMBERS.findall(text))], len(ARGUMENTS[command])
    return [tuple(numbers[k : k + count]) for k in range(0, len(numbers), count)]


def absolute(command: str, values: tuple[float, ...], place: tuple[float, float]) -> tuple[float, ...]:
    """Arguments that count from a place, from the origin."""
    x, y = place
    if command in ("H", "V"):
        return (values[0] + (x if command == "H" else y),)
    if command == "A":
        return (*values[:-2], values[-2] + x, values[-1] + y)
    return tuple(value + (y if k % 2 else x) for k, value in enumerate(values))
