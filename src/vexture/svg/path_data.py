"""SVG path data (SVG 2, 9.3): the grammar decides how far it is valid, fontTools interprets it.

fontTools reads over what is not a number and needs every command complete. A path that breaks off must be drawn up
to the error, so the text is first cut to its longest valid beginning.
"""

import re

import numpy as np
from fontTools.svgLib.path import parse_path

from vexture.bezier.convert import Step, arc_cubics
from vexture.svg.outline import Outline

__all__ = ["GAP", "NUMBER", "POINTS", "SPACE", "path_outlines", "valid_length"]

# atomic: a number is never given up in part to make two of it
NUMBER = r"(?>[+-]?(?:[0-9]*\.[0-9]+|[0-9]+)(?:[eE][+-]?[0-9]+)?)"
SPACE = r"[ \t\n\r\f]*+"
GAP = rf"(?>{SPACE},?{SPACE})"


def command(letters: str, *arguments: str) -> str:
    """Pattern of a command with its arguments once or more."""
    one = GAP.join(arguments)
    return rf"[{letters}]{SPACE}{one}(?:{GAP}{one})*+"


MOVE = command("Mm", NUMBER, NUMBER)
DRAW = "|".join(
    (
        command("LlTt", NUMBER, NUMBER),
        command("HhVv", NUMBER),
        command("Cc", *[NUMBER] * 6),
        command("SsQq", *[NUMBER] * 4),
        command("Aa", NUMBER, NUMBER, NUMBER, "[01]", "[01]", NUMBER, NUMBER),
        "[Zz]",
    )
)
PATH = re.compile(rf"{SPACE}(?:{MOVE}(?:{SPACE}(?:{DRAW}|{MOVE}))*+)?+{SPACE}")
POINTS = re.compile(rf"{SPACE}(?:{NUMBER}{GAP}{NUMBER}(?:{GAP}{NUMBER}{GAP}{NUMBER})*+)?+{SPACE}")

ZEROS = re.compile(r"(?<![0-9.])0+(?=[0-9])")
ARC = re.compile(r"[Aa][^MmZzLlHhVvCcSsQqTt]*+")
ARC_ARGUMENTS = re.compile(GAP.join([f"({NUMBER})"] * 3 + ["([01])"] * 2 + [f"({NUMBER})"] * 2) + GAP)

HUGE = 1e100
"""Numbers beyond this would overflow in the arithmetic of an arc; such a radius draws a line anyway."""


def valid_length(data: str) -> int:
    """Count the characters up to the first error in path data.

    Examples
    --------
    >>> valid_length("M0 0h1v1z"), valid_length("M0 0 L1 1 2 !")
    (9, 10)
    """
    match = PATH.match(data)
    return match.end() if match else 0


def path_outlines(data: str, tolerance: float) -> list[Outline]:
    """Outlines of path data, drawn as far as it is valid.

    Parameters
    ----------
    data : str
        The `d` attribute of a path.
    tolerance : float
        Largest distance of a cubic from the arc it stands for, in the units of the path.

    Examples
    --------
    >>> square, line = path_outlines("M0 0h2v2h-2z m4 0v1", 1e-3)
    >>> square.closed, len(square.cubics), line.closed, line.cubics[0, 0].tolist()
    (True, 4, False, [4.0, 0.0])
    """
    valid = data[: valid_length(data)]
    pen = CubicPen(tolerance)
    parse_path(without_leading_zeros(valid) if ZEROS.search(valid) else valid, pen)
    return pen.outlines


def without_leading_zeros(data: str) -> str:
    """Path data in which fontTools cannot take "007" for three numbers; the flags of arcs are set apart before.

    Examples
    --------
    >>> without_leading_zeros("M007 0a1 1 0 00010 020")
    'M7 0a1 1 0 0 0 10 20 '
    """
    spaced = ARC.sub(lambda arc: ARC_ARGUMENTS.sub(r"\1 \2 \3 \4 \5 \6 \7 ", arc[0]), data)
    return ZEROS.sub("", spaced)


class CubicPen:
    """Receives what fontTools reads and keeps it as cubics."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance = tolerance
        self.outlines: list[Outline] = []
        self.cubics: list[tuple[float, ...]] = []
        self.at = (0.0, 0.0)

    def moveTo(self, point: tuple[float, float]) -> None:  # noqa: N802 (fontTools' name, as are those below)
        self.at = point

    def lineTo(self, end: tuple[float, float]) -> None:  # noqa: N802
        (x0, y0), (x3, y3) = self.at, end
        dx, dy = x3 - x0, y3 - y0
        third, rest = 1.0 / 3.0, 2.0 / 3.0
        self.cubics.append((x0, y0, x0 + dx * third, y0 + dy * third, x0 + dx * rest, y0 + dy * rest, x3, y3))
        self.at = end

    def curveTo(self, *points: tuple[float, float]) -> None:  # noqa: N802
        (x1, y1), (x2, y2), end = points
        self.cubics.append((*self.at, x1, y1, x2, y2, *end))
        self.at = end

    def qCurveTo(self, *points: tuple[float, float]) -> None:  # noqa: N802
        (x, y), end = points
        (x0, y0), (x3, y3) = self.at, end
        k = 2.0 / 3.0
        self.cubics.append((x0, y0, x0 + (x - x0) * k, y0 + (y - y0) * k, x3 + (x - x3) * k, y3 + (y - y3) * k, x3, y3))
        self.at = end

    def arcTo(  # noqa: N802
        self, rx: float, ry: float, rotation: float, large: bool, sweep: bool, end: tuple[float, float]
    ) -> None:
        if not max(map(abs, (rx, ry, rotation, *self.at, *end))) <= HUGE:
            self.lineTo(end)
            return
        steps: list[Step] = arc_cubics(self.at, (rx, ry), rotation, large, sweep, end, self.tolerance)
        for step in steps:
            self.cubics.append((*self.at, *step))
            self.at = step[4:]
        self.at = end

    def closePath(self) -> None:  # noqa: N802
        self.finish(closed=True)

    def endPath(self) -> None:  # noqa: N802
        self.finish(closed=False)

    def finish(self, closed: bool) -> None:
        """Keep what was drawn; a closed point, which only a round or square cap shows, is a cubic without length."""
        if closed and not self.cubics:
            self.cubics.append(self.at * 4)
        if self.cubics:
            self.outlines.append(Outline(np.array(self.cubics).reshape(-1, 4, 2), closed))
            self.cubics = []
