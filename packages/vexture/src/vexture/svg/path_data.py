"""Path data of SVG (SVG 2, 9.3), read command by command up to the first error."""

import re
from cmath import isclose
from typing import Final

import numpy as np

from vexture.bezier.convert import arc_cubics
from vexture.svg.outline import ShapeOutline

# atomic groups, so that backtracking never splits a number
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
"""Arguments after the letter of each command, which may be repeated."""


def repeated_arguments(arguments: list[str]) -> re.Pattern[str]:
    """Compile a pattern for all arguments after the letter of a command, and trailing white space."""
    one = GAP.join(arguments)
    more = rf"{SPACE}({one}(?:{GAP}{one})*+)" if arguments else "()"
    return re.compile(more + SPACE)


COMMANDS: Final = {letter: repeated_arguments(arguments) for letter, arguments in ARGUMENTS.items()}
NUMBERS: Final = re.compile(NUMBER)
ARC: Final = re.compile(GAP.join(f"({argument})" for argument in ARGUMENTS["A"]))

HUGE = 1e100
"""Limit beyond which numbers, and inverse radii, overflow in the arithmetic of an arc, which becomes a line."""

Point = tuple[float, float]


def path_outlines(data: str, tolerance: float) -> tuple[list[ShapeOutline], int]:
    """Return the outlines of path data (the attribute `d`) up to the first error, and the number of valid characters.

    `tolerance` is the largest distance of a cubic from its arc, in the units of the path.

    Examples
    --------
    >>> (square, line), valid = path_outlines("M0 0h2v2h-2z m4 0v1 !", 1e-3)
    >>> square.closed, len(square.cubics), line.closed, line.cubics[0, 0].tolist(), valid
    (True, 4, False, [4.0, 0.0], 20)
    """
    pen = PathPen(tolerance)
    valid = pen.follow(data)
    return pen.outlines, valid


class PathPen:
    """Pen that draws commands as cubics."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance = tolerance
        self.outlines: list[ShapeOutline] = []
        self.cubics: list[tuple[float, ...]] = []
        self.at: tuple[float, float] = (0.0, 0.0)
        self.start: tuple[float, float] = (0.0, 0.0)
        self.control: tuple[float, float] = (0.0, 0.0)
        self.bend: str = ""  # kind of the last segment, as S and T mirror its control point
        self.down: bool = False

    def follow(self, data: str) -> int:
        """Draw path data up to the first error; return the number of valid characters."""
        at = len(data) - len(data.lstrip(" \t\n\r\f"))
        possible = "Mm"
        while at < len(data) and data[at] in possible:
            letter = data[at]
            match = COMMANDS[letter.upper()].match(data, at + 1)
            if match is None:
                break
            self.draw(letter, match[1])
            at, possible = match.end(), "MmLlTtHhVvCcSsQqAaZz"
        self.finish(closed=False)
        return at

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
            match command, values:
                case "L", (x, y):
                    self.line_to((dx + x, dy + y))
                case "C", (x1, y1, x2, y2, x, y):
                    self.cubic_to((dx + x1, dy + y1), (dx + x2, dy + y2), (dx + x, dy + y))
                case "H", (x,):
                    self.line_to((dx + x, self.at[1]))
                case "V", (y,):
                    self.line_to((self.at[0], dy + y))
                case "Q", (x1, y1, x, y):
                    self.quadratic_to((dx + x1, dy + y1), (dx + x, dy + y))
                case "S", (x2, y2, x, y):
                    self.cubic_to(self.mirrored_control("cubic"), (dx + x2, dy + y2), (dx + x, dy + y))
                case "T", (x, y):
                    self.quadratic_to(self.mirrored_control("quadratic"), (dx + x, dy + y))
                case "A", (rx, ry, rotation, large, sweep, x, y):
                    self.arc_to(rx, ry, rotation, bool(large), bool(sweep), (dx + x, dy + y))
                case "M", (x, y):
                    self.at = self.start = (dx + x, dy + y)
                    self.bend, command = "", "L"  # further pairs are lines

    def line_to(self, end: Point) -> None:
        """Draw a straight line."""
        (x0, y0), (x3, y3) = self.at, end
        dx, dy = x3 - x0, y3 - y0
        third, rest = 1.0 / 3.0, 2.0 / 3.0
        self.cubics.append((x0, y0, x0 + dx * third, y0 + dy * third, x0 + dx * rest, y0 + dy * rest, x3, y3))
        self.at, self.bend = end, ""

    def mirrored_control(self, bend: str) -> Point:
        """Return the first control point of a smooth curve: the last one, mirrored, if that was of a `bend`."""
        (x, y), (u, v) = self.at, self.control
        return (x + x - u, y + y - v) if self.bend == bend else self.at

    def cubic_to(self, first: Point, second: Point, end: Point) -> None:
        """Draw a cubic curve."""
        self.cubics.append((*self.at, *first, *second, *end))
        self.at, self.control, self.bend = end, second, "cubic"

    def quadratic_to(self, control: Point, end: Point) -> None:
        """Draw a quadratic curve."""
        (x0, y0), (x, y), (x3, y3) = self.at, control, end
        k = 2.0 / 3.0
        self.cubics.append((x0, y0, x0 + (x - x0) * k, y0 + (y - y0) * k, x3 + (x - x3) * k, y3 + (y - y3) * k, x3, y3))
        self.at, self.control, self.bend = end, control, "quadratic"

    def arc_to(self, rx: float, ry: float, rotation: float, large: bool, sweep: bool, end: Point) -> None:
        """Draw an arc of an ellipse."""
        larger = max(abs(rx), abs(ry))
        if 0.0 < larger < 1.0 / HUGE:  # too small to join the points: only their ratio counts
            small = abs(complex(*end) - complex(*self.at)) / 8.0
            rx, ry = rx / larger * small, ry / larger * small
        largest = max(map(abs, (rx, ry, rotation, *self.at, *end)))
        if not (largest <= HUGE and min(abs(rx), abs(ry)) >= 1.0 / HUGE):
            self.line_to(end)
            return
        for step in arc_cubics(self.at, (rx, ry), rotation, large, sweep, end, self.tolerance):
            self.cubics.append((*self.at, *step))
            self.at = step[4:]
        self.at, self.bend = end, ""

    def close(self) -> None:
        """Close the outline, unless nothing has been drawn since the last close."""
        if not self.down:
            return
        if not isclose(complex(*self.at), complex(*self.start), rel_tol=1e-15, abs_tol=1e-15):
            self.line_to(self.start)
        self.finish(closed=True)
        self.at, self.bend, self.down = self.start, "", False

    def finish(self, closed: bool) -> None:
        """Store the outline; a closed point, which only a round or square cap shows, is a cubic of zero length."""
        if closed and not self.cubics:
            self.cubics.append(self.at * 4)
        if self.cubics:
            self.outlines.append(ShapeOutline(np.array(self.cubics).reshape(-1, 4, 2), closed))
            self.cubics = []
