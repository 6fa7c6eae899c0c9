"""Path data of SVG (SVG 2, 9.3), read command by command: it is drawn as far as it is valid."""

import re
from cmath import isclose
from collections.abc import Callable
from typing import Final

import numpy as np

from vexture.bezier.convert import arc_cubics
from vexture.svg.outline import Outline

__all__ = ["GAP", "NUMBER", "POINTS", "SPACE", "path_outlines"]

# atomic: a number is never given up in part to make two of it
NUMBER = r"(?>[+-]?(?:[0-9]*\.[0-9]+|[0-9]+)(?:[eE][+-]?[0-9]+)?)"
SPACE = r"[ \t\n\r\f]*+"
GAP = rf"(?>{SPACE},?{SPACE})"

POINTS = re.compile(rf"{SPACE}(?:{NUMBER}{GAP}{NUMBER}(?:{GAP}{NUMBER}{GAP}{NUMBER})*+)?+{SPACE}")

FLAG: Final = "[01]"
ARGUMENTS: Final[dict[str, list[str]]] = {
    "M": [NUMBER] * 2,
    "L": [NUMBER] * 2,
    "T": [NUMBER] * 2,
    "H": [NUMBER],
    "V": [NUMBER],
    "C": [NUMBER] * 6,
    "S": [NUMBER] * 4,
    "Q": [NUMBER] * 4,
    "A": [NUMBER, NUMBER, NUMBER, FLAG, FLAG, NUMBER, NUMBER],
    "Z": [],
}
"""What follows the letter of each command, once or more."""


def repeated(arguments: list[str]) -> re.Pattern[str]:
    """Pattern of all that follows the letter of a command, and of the blanks after it."""
    one = GAP.join(arguments)
    more = rf"{SPACE}({one}(?:{GAP}{one})*+)" if arguments else "()"
    return re.compile(more + SPACE)


def once(arguments: list[str]) -> re.Pattern[str]:
    """Pattern that finds arguments, each time those of one segment, in a text of which all is valid."""
    return re.compile(GAP.join(f"({argument})" for argument in arguments))


COMMANDS: Final = {letter: repeated(arguments) for letter, arguments in ARGUMENTS.items()}
NUMBERS: Final = re.compile(NUMBER)
ARC: Final = once(ARGUMENTS["A"])

HUGE = 1e100
"""Numbers beyond this would overflow in the arithmetic of an arc; such a radius draws a line anyway."""

Point = tuple[float, float]


def path_outlines(data: str, tolerance: float) -> tuple[list[Outline], int]:
    """Outlines of path data, drawn as far as it is valid.

    Parameters
    ----------
    data : str
        The `d` attribute of a path.
    tolerance : float
        Largest distance of a cubic from the arc it stands for, in the units of the path.

    Returns
    -------
    list of Outline, int
        And how many characters are valid.

    Examples
    --------
    >>> (square, line), valid = path_outlines("M0 0h2v2h-2z m4 0v1 !", 1e-3)
    >>> square.closed, len(square.cubics), line.closed, line.cubics[0, 0].tolist(), valid
    (True, 4, False, [4.0, 0.0], 20)
    """
    pen = Pen(tolerance)
    at = len(data) - len(data.lstrip(" \t\n\r\f"))
    possible = "Mm"
    while at < len(data) and data[at] in possible:
        letter = data[at]
        match = COMMANDS[letter.upper()].match(data, at + 1)
        if match is None:
            break
        pen.draw(letter, match[1])
        at, possible = match.end(), "MmLlTtHhVvCcSsQqAaZz"
    pen.finish(closed=False)
    return pen.outlines, at


class Pen:
    """Draws commands as cubics."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance = tolerance
        self.outlines: list[Outline] = []
        self.cubics: list[tuple[float, ...]] = []
        self.at: tuple[float, float] = (0.0, 0.0)
        self.start: tuple[float, float] = (0.0, 0.0)
        self.control: tuple[float, float] = (0.0, 0.0)
        self.bend: str = ""  # what the last segment was, whose control point S or T mirrors
        self.down: bool = False

    def draw(self, letter: str, text: str) -> None:
        """Draw a command with all its arguments."""
        command = letter.upper()
        if command == "Z":
            self.close()
            return
        if command == "M":
            self.finish(closed=False)
        self.down = True
        if command == "A":
            segments = [tuple(map(float, found)) for found in ARC.findall(text)]
        else:
            numbers, count = list(map(float, NUMBERS.findall(text))), len(ARGUMENTS[command])
            segments = [tuple(numbers[k : k + count]) for k in range(0, len(numbers), count)]
        for values in segments:
            dx, dy = self.at if letter.islower() else (0.0, 0.0)
            DRAWN[command](self, dx, dy, *values)
            command = "L" if command == "M" else command

    def move(self, dx: float, dy: float, x: float, y: float) -> None:
        """Begin an outline."""
        self.at = self.start = (dx + x, dy + y)
        self.bend = ""

    def line(self, dx: float, dy: float, x: float, y: float) -> None:
        """Straight on."""
        self.line_to((dx + x, dy + y))

    def across(self, dx: float, dy: float, x: float) -> None:
        """To the left or right."""
        self.line_to((dx + x, self.at[1]))

    def down_or_up(self, dx: float, dy: float, y: float) -> None:
        """Down or up."""
        self.line_to((self.at[0], dy + y))

    def line_to(self, end: Point) -> None:
        """Straight on, to a place."""
        (x0, y0), (x3, y3) = self.at, end
        dx, dy = x3 - x0, y3 - y0
        third, rest = 1.0 / 3.0, 2.0 / 3.0
        self.cubics.append((x0, y0, x0 + dx * third, y0 + dy * third, x0 + dx * rest, y0 + dy * rest, x3, y3))
        self.at, self.bend = end, ""

    def mirrored(self, bend: str) -> Point:
        """First control point of a curve that goes on smoothly."""
        (x, y), (u, v) = self.at, self.control
        return (x + x - u, y + y - v) if self.bend == bend else self.at

    def cubic(self, dx: float, dy: float, *values: float) -> None:
        """Cubic curve."""
        x1, y1, x2, y2, x, y = values
        self.cubic_to((dx + x1, dy + y1), (dx + x2, dy + y2), (dx + x, dy + y))

    def smooth_cubic(self, dx: float, dy: float, *values: float) -> None:
        """Cubic curve without a corner before it."""
        x2, y2, x, y = values
        self.cubic_to(self.mirrored("cubic"), (dx + x2, dy + y2), (dx + x, dy + y))

    def cubic_to(self, first: Point, second: Point, end: Point) -> None:
        """Cubic curve, by places."""
        self.cubics.append((*self.at, *first, *second, *end))
        self.at, self.control, self.bend = end, second, "cubic"

    def quadratic(self, dx: float, dy: float, *values: float) -> None:
        """Quadratic curve."""
        x1, y1, x, y = values
        self.quadratic_to((dx + x1, dy + y1), (dx + x, dy + y))

    def smooth_quadratic(self, dx: float, dy: float, x: float, y: float) -> None:
        """Quadratic curve without a corner before it."""
        self.quadratic_to(self.mirrored("quadratic"), (dx + x, dy + y))

    def quadratic_to(self, control: Point, end: Point) -> None:
        """Quadratic curve, by places."""
        (x0, y0), (x, y), (x3, y3) = self.at, control, end
        k = 2.0 / 3.0
        self.cubics.append((x0, y0, x0 + (x - x0) * k, y0 + (y - y0) * k, x3 + (x - x3) * k, y3 + (y - y3) * k, x3, y3))
        self.at, self.control, self.bend = end, control, "quadratic"

    def arc(self, dx: float, dy: float, *values: float) -> None:
        """Arc of an ellipse."""
        rx, ry, rotation, large, sweep, x, y = values
        end = (dx + x, dy + y)
        if not max(map(abs, (rx, ry, rotation, *self.at, *end))) <= HUGE:
            self.line_to(end)
            return
        for step in arc_cubics(self.at, (abs(rx), abs(ry)), rotation, bool(large), bool(sweep), end, self.tolerance):
            self.cubics.append((*self.at, *step))
            self.at = step[4:]
        self.at, self.bend = end, ""

    def close(self) -> None:
        """Go back to the start, unless that was done and nothing has been drawn since."""
        if not self.down:
            return
        if not isclose(complex(*self.at), complex(*self.start), rel_tol=1e-15, abs_tol=1e-15):
            self.line_to(self.start)
        self.finish(closed=True)
        self.at, self.bend, self.down = self.start, "", False

    def finish(self, closed: bool) -> None:
        """Keep what was drawn; a closed point, which only a round or square cap shows, is a cubic without length."""
        if closed and not self.cubics:
            self.cubics.append(self.at * 4)
        if self.cubics:
            self.outlines.append(Outline(np.array(self.cubics).reshape(-1, 4, 2), closed))
            self.cubics = []


DRAWN: Final[dict[str, Callable[..., None]]] = {
    "M": Pen.move,
    "L": Pen.line,
    "H": Pen.across,
    "V": Pen.down_or_up,
    "C": Pen.cubic,
    "S": Pen.smooth_cubic,
    "Q": Pen.quadratic,
    "T": Pen.smooth_quadratic,
    "A": Pen.arc,
}
"""What draws one segment of a command: given the place that its numbers are relative to, and the numbers."""
