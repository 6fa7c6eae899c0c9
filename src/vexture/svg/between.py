"""Values between two others, and sums of two, as texts of attributes and properties (SMIL 3.0, 5; CSS Values 4, 3)."""

import re
from collections.abc import Callable

from vexture.svg.colors import Color, parse_color
from vexture.svg.path_data import NUMBER

__all__ = ["added", "between"]

TERM = re.compile(rf"({NUMBER})([a-zA-Z]+|%)?")

LONGEST = 1_000_000
"""Characters of a value."""


def between(first: str, second: str, part: float) -> str | None:
    """The value at a part of the way from one to another; None if there is nothing between them.

    Examples
    --------
    >>> between("rotate(0)", "rotate(90deg)", 0.5), between("1 20px", "3,40px", 0.25), between("red", "#00f", 0.5)
    ('rotate(45.0deg)', '1.5 25.0px', 'rgb(50.0% 0.0% 50.0% / 1.0)')
    >>> between("none", "block", 0.5)
    """
    return mixed(first, second, lambda a, b: a + part * (b - a))


def added(first: str, second: str, times: int = 1) -> str | None:
    """The sum of a value and another one, so many times; None if they have none.

    Examples
    --------
    >>> added("10px", "5"), added("#100", "#200")
    ('15.0px', 'rgb(20.0% 0.0% 0.0% / 1.0)')
    """
    return mixed(first, second, lambda a, b: a + times * b)


def mixed(first: str, second: str, mix: Callable[[float, float], float]) -> str | None:
    """A value made of two whose texts differ in numbers only."""
    if len(first) + len(second) > LONGEST:
        return None
    colors = parse_color(first), parse_color(second)
    if isinstance(colors[0], Color) and isinstance(colors[1], Color):
        rgb = (min(max(mix(a, b), 0.0), 1.0) for a, b in zip(colors[0].rgb, colors[1].rgb, strict=True))
        alpha = min(max(mix(colors[0].alpha, colors[1].alpha), 0.0), 1.0)
        return f"rgb({' '.join(f'{100.0 * value!r}%' for value in rgb)} / {alpha!r})"
    words = TERM.sub(" ", first).replace(",", " ").split(), TERM.sub(" ", second).replace(",", " ").split()
    terms = list(TERM.finditer(first)), TERM.findall(second)
    if words[0] != words[1] or len(terms[0]) != len(terms[1]) or not terms[1]:
        return None
    made, at = list[str](), 0
    for term, (value, unit) in zip(*terms, strict=True):
        own, mine, theirs = term[2] or "", float(term[1]), float(value)
        if own != unit and {own, unit} != {"", "px"} and (own or mine) and (unit or theirs):
            return None
        number = mix(mine, theirs)
        made += [first[at : term.start()], term[1] if number == mine else repr(number), own or unit]
        at = term.end()
    return "".join([*made, first[at:]])
