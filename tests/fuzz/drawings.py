"""Random drawings as people and programs make them, as SVG: the same text for the same seed.

Shared borders, coincident and nearly coincident outlines, cusps, self-crossings, slivers, both fill rules, strokes with
dashes, groups, blend modes, masks, clips, texts and, if asked for, gradients of all kinds.
"""

from collections.abc import Callable
from itertools import pairwise
from math import cos, pi, sin
from random import Random

from shadings import Shadings

FAMILY = "DejaVu Sans"
"""Of all texts, so that every machine draws the same ones."""

BLENDS = (
    *("multiply", "screen", "overlay", "darken", "lighten", "color-dodge", "color-burn", "hard-light", "soft-light"),
    *("difference", "exclusion", "hue", "saturation", "color", "luminosity", "plus-lighter"),
)

WORDS = ("aB31&amp;", "Wij", "%@&amp;", "office", "S8", "Qg.")
Point = tuple[float, float]


def drawing_of(seed: str, has_gradients: bool) -> str:
    """Return an SVG with a viewBox of 100 by 100."""
    return Sketch(Random(f"drawing {seed} {has_gradients}"), has_gradients).text()


class Sketch:
    """A drawing in the making: what later elements share with earlier ones is kept."""

    def __init__(self, rng: Random, has_gradients: bool) -> None:
        self.rng = rng
        self.shadings = Shadings(rng) if has_gradients else None
        self.definitions: list[str] = []
        self.outlines: list[str] = []  # values of `d`, to be drawn again
        self.points: list[Point] = []  # corners, to be met again
        self.digits = rng.choice((0, 1, 2, 3, 6))
        self.style = 0  # of a drawing that only fills, or only strokes, some are

    def text(self) -> str:
        """The whole file."""
        body = "\n".join(self.item(0) for _ in range(self.rng.choice((1, 2, 2, 3, 3, 4, 5, 7))))
        shadings = self.shadings.definitions if self.shadings else []
        definitions = "\n".join([*shadings, *self.definitions])
        head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"'
        return f'{head} color="{self.color()}" font-family="{FAMILY}">\n<defs>{definitions}</defs>\n{body}\n</svg>\n'

    def item(self, depth: int) -> str:
        """An element or a group."""
        rng = self.rng
        kind = rng.random()
        if depth < 3 and kind < 0.35:
            inside = "\n".join(self.item(depth + 1) for _ in range(rng.randint(1, 3)))
            return f"<g{self.grouping()}>\n{inside}\n</g>"
        if kind < 0.45:
            return self.patches()
        if kind < 0.53:
            return self.words()
        return self.shape()

    # --- outlines ----------------------------------------------------------------------------------------------

    def number(self, value: float) -> str:
        """A number as this drawing writes it; now and then exactly, so that points nearly meet."""
        return f"{value:.{9 if self.rng.random() < 0.05 else self.digits}f}"

    def point(self) -> Point:
        """A place: anywhere, on the lines of cells, at a corner that is known, or next to one."""
        rng, kind = self.rng, self.rng.random()
        if self.points and kind < 0.3:
            x, y = rng.choice(self.points)
            near = 0.0 if kind < 0.2 else 10.0 ** -rng.randint(1, 8)
            return x + near * rng.uniform(-1, 1), y + near * rng.uniform(-1, 1)
        if kind < 0.4:
            steps = 2 ** rng.randint(1, 6)
            found = 100.0 * rng.randint(0, steps) / steps, 100.0 * rng.randint(0, steps) / steps
        elif kind < 0.5:
            found = rng.uniform(-50, 150), rng.uniform(-50, 150)
        else:
            found = rng.uniform(5, 95), rng.uniform(5, 95)
        self.points.append(found)
        return found

    def at(self, *points: Point) -> str:
        """Coordinates of points."""
        return " ".join(f"{self.number(x)} {self.number(y)}" for x, y in points)

    def outline(self) -> str:
        """Value of `d`: a new outline, or one that is there already, or both."""
        rng, kind = self.rng, self.rng.random()
        if self.outlines and kind < 0.2:
            return rng.choice(self.outlines)
        kinds: tuple[Callable[[], str], ...] = (
            self.curves, self.curves, self.curves, self.cusp, self.star, self.ring, self.sliver, self.boxes,
        )  # fmt: skip
        found = rng.choice(kinds)()
        if self.outlines and kind > 0.9:
            found += rng.choice(self.outlines)
        self.outlines.append(found)
        return found

    def curves(self) -> str:
        """Lines, quadratics, cubics and arcs through a few points."""
        rng = self.rng
        parts = [f"M{self.at(self.point())}"]
        command = rng.choice("LLCCQAT*")
        for _ in range(rng.randint(2, 7)):
            match rng.choice("LCQA") if command == "*" else command:
                case "L":
                    parts.append(f"L{self.at(self.point())}")
                case "C":
                    parts.append(f"C{self.at(self.point(), self.point(), self.point())}")
                case "Q":
                    parts.append(f"Q{self.at(self.point(), self.point())}")
                case "T":
                    parts.append(f"T{self.at(self.point())}")
                case _:
                    radii = f"{self.number(rng.uniform(5, 60))} {self.number(rng.uniform(5, 60))}"
                    flags = f"{rng.randrange(180)} {rng.randrange(2)} {rng.randrange(2)}"
                    parts.append(f"A{radii} {flags} {self.at(self.point())}")
        return "".join(parts) + rng.choice(("z", "z", ""))

    def cusp(self) -> str:
        """A cubic that turns back in a point, or in a loop or bend that is nearly one."""
        (x0, y0), (x1, y1) = self.point(), self.point()
        way = x1 - x0, y1 - y0
        middle = (x0 + x1) / 2 + way[1] * self.rng.uniform(-0.4, 0.4), (y0 + y1) / 2 - way[0] * 0.3
        near = 0.5 + self.rng.choice((0.0, 0.0, 1e-6, -1e-4, 0.05))
        first = middle[0] + near * way[0], middle[1] + near * way[1]
        second = middle[0] - near * way[0], middle[1] - near * way[1]
        return f"M{self.at((x0, y0))}C{self.at(first, second, (x1, y1))}z"

    def star(self) -> str:
        """A polygon that crosses itself."""
        rng, (x, y) = self.rng, self.point()
        spikes, radius, turn = rng.choice((5, 7, 9)), rng.uniform(10, 60), rng.uniform(0, 7)
        step = rng.randint(2, spikes // 2)
        angles = [turn + 2 * pi * step * k / spikes for k in range(spikes)]
        return f"M{self.at(*((x + radius * cos(a), y + radius * sin(a)) for a in angles))}z"

    def ring(self) -> str:
        """Circles about one middle."""
        rng, (x, y) = self.rng, self.point()
        found, radius = "", rng.uniform(5, 55)
        for _ in range(rng.choice((1, 1, 2, 3))):
            size = self.number(radius)
            sweep = rng.randrange(2)
            found += f"M{self.at((x - radius, y))}a{size} {size} 0 1 {sweep} {self.number(2 * radius)} 0"
            found += f"a{size} {size} 0 1 {sweep} {self.number(-2 * radius)} 0z"
            radius *= rng.choice((0.5, 0.8, 0.99, 1.0))
        return found

    def sliver(self) -> str:
        """A shape far longer than wide."""
        (x0, y0), (x1, y1) = self.point(), self.point()
        wide = 10.0 ** self.rng.uniform(-4, 0.5)
        middle = (x0 + x1) / 2 + wide * self.rng.uniform(-1, 1), (y0 + y1) / 2 + wide * self.rng.uniform(-1, 1)
        return f"M{self.at((x0, y0))}Q{self.at(middle, (x1, y1))}L{self.at((x1 + wide, y1 - wide))}z"

    def boxes(self) -> str:
        """Rectangles side by side."""
        rng, (x, y) = self.rng, self.point()
        wide, high = rng.choice((12.5, 25, 50, rng.uniform(1, 60))), rng.choice((12.5, 25, rng.uniform(1, 60)))
        return "".join(
            f"M{self.at((x + k * wide, y))}h{self.number(wide)}v{self.number(high)}h{self.number(-wide)}z"
            for k in range(rng.choice((1, 1, 2, 3)))
        )

    # --- elements ----------------------------------------------------------------------------------------------

    def shape(self) -> str:
        """A path, or an element that is a shape."""
        rng, look = self.rng, self.look()
        (x, y), a, b = self.point(), self.number(rng.uniform(1, 60)), self.number(rng.uniform(1, 60))
        match rng.randrange(10):
            case 0:
                corner = rng.choice(("", f' rx="{self.number(rng.uniform(0, 30))}"'))
                place = f'x="{self.number(x)}" y="{self.number(y)}"'
                return f'<rect {place} width="{a}" height="{b}"{corner}{look}/>'
            case 1:
                return f'<circle cx="{self.number(x)}" cy="{self.number(y)}" r="{a}"{look}/>'
            case 2:
                return f'<ellipse cx="{self.number(x)}" cy="{self.number(y)}" rx="{a}" ry="{b}"{look}/>'
            case 3:
                name = rng.choice(("polygon", "polyline"))
                points = self.at(*(self.point() for _ in range(rng.randint(3, 8))))
                return f'<{name} points="{points}"{look}/>'
        return f'<path d="{self.outline()}"{look}/>'

    def patches(self) -> str:
        """Neighbours as on a map: each border is drawn twice, once in each direction."""
        rng = self.rng
        across, down = rng.randint(2, 4), rng.randint(1, 3)
        corners = {
            (i, j): (100 * (i + rng.uniform(-0.3, 0.3)) / across, 100 * (j + rng.uniform(-0.3, 0.3)) / down)
            for i in range(across + 1)
            for j in range(down + 1)
        }
        written = {key: self.at(point) for key, point in corners.items()}
        bends = {}

        def border(a: tuple[int, int], b: tuple[int, int]) -> str:
            low, high = min(a, b), max(a, b)
            if (low, high) not in bends:
                (x0, y0), (x1, y1) = corners[low], corners[high]
                thirds = [
                    (x0 + (x1 - x0) * t + rng.gauss(0, 4), y0 + (y1 - y0) * t + rng.gauss(0, 4)) for t in (0.3, 0.7)
                ]
                bends[low, high] = [self.at(third) for third in thirds]
            return f"C{' '.join(bends[low, high] if a == low else bends[low, high][::-1])} {written[b]}"

        found = []
        for i in range(across):
            for j in range(down):
                walk = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1), (i, j)]
                d = f"M{written[i, j]}" + "".join(border(a, b) for a, b in pairwise(walk)) + "z"
                found.append(f'<path d="{d}" fill="{self.paint()}"/>')
        return f"<g{self.grouping() if rng.random() < 0.3 else ''}>" + "\n".join(found) + "</g>"

    def words(self) -> str:
        """A text."""
        rng, (x, y) = self.rng, self.point()
        size = rng.choice((3, 8, 16, 40, 90))
        place = f'x="{self.number(x)}" y="{self.number(y)}" font-size="{size}"'
        return f"<text {place}{self.look()}>{rng.choice(WORDS)}</text>"

    # --- attributes --------------------------------------------------------------------------------------------

    def color(self) -> str:
        """A colour in one of the ways to write it; greys and pure colours are frequent."""
        rng = self.rng
        kinds: tuple[Callable[[], str], ...] = (
            lambda: rng.choice(("red", "black", "#fff", "#888", "teal", "orange", "navy", "lime")),
            lambda: f"#{rng.randrange(1 << 24):06x}",
            lambda: f"hsl({rng.randrange(360)} {rng.choice((0, 40, 80, 100))}% {rng.choice((20, 50, 80))}%)",
            lambda: f"rgb({rng.randrange(256)},{rng.randrange(256)},{rng.randrange(256)})",
            lambda: f"rgba({rng.randrange(256)},{rng.randrange(256)},{rng.randrange(256)},{rng.choice((0.3, 0.7))})",
            lambda: f"hwb({rng.randrange(360)} 20% 10%)",
            lambda: f"oklch(0.6 0.15 {rng.randrange(360)})",
        )
        return rng.choice(kinds)()

    def paint(self) -> str:
        """Value of `fill` or `stroke`."""
        if self.shadings and self.rng.random() < 0.6:
            return self.shadings.paint(self.color)
        return "currentColor" if self.rng.random() < 0.05 else self.color()

    def look(self) -> str:
        """Fill, stroke, and now and then more, as attributes."""
        rng, found = self.rng, {}
        kind = rng.random()
        found["fill"] = "none" if kind < 0.2 else self.paint()
        if rng.random() < 0.4:
            found["fill-rule"] = "evenodd"
        if kind < 0.45:
            found["stroke"] = self.paint()
            found["stroke-width"] = self.number(rng.choice((0.2, 1, 3, 8, 25)) * rng.uniform(0.6, 1.4))
            found["stroke-linejoin"] = rng.choice(("miter", "round", "bevel"))
            found["stroke-linecap"] = rng.choice(("butt", "round", "square"))
            if rng.random() < 0.4:
                found["stroke-dasharray"] = rng.choice(("5", "9 3", "14 2 0 6", "0 7", "3.3,1.7,8", "25%"))
                found["stroke-dashoffset"] = rng.choice(("0", "2.5", "-4"))
            if rng.random() < 0.2:
                found["paint-order"] = "stroke"
        if rng.random() < 0.2:
            found[rng.choice(("opacity", "fill-opacity", "stroke-opacity"))] = rng.choice(("0.3", "0.5", "0.9"))
        if rng.random() < 0.15:
            found["transform"] = self.transform()
        if rng.random() < 0.15:
            found["style"] = f"mix-blend-mode:{rng.choice(BLENDS)}"
        return "".join(f' {name}="{value}"' for name, value in found.items())

    def transform(self) -> str:
        """Value of `transform`, about the middle."""
        rng = self.rng
        angle = rng.choice((15, 30, 45, 90, rng.uniform(0, 360)))
        return rng.choice(
            (
                f"rotate({angle:g} 50 50)",
                f"translate({self.at(self.point())}) scale({rng.uniform(0.2, 1.5):.3f})",
                f"skewX({rng.uniform(-50, 50):.0f})",
                f"matrix(1 {rng.uniform(-0.5, 0.5):.2f} {rng.uniform(-0.5, 0.5):.2f} 0.8 0 0)",
                "matrix(-1 0 0 1 100 0)",
                f"rotate({angle:g} 50 50) scale(1 0.15) translate(0 250)",
            )
        )

    def grouping(self) -> str:
        """Attributes of a group."""
        rng, found, style = self.rng, {}, []
        if rng.random() < 0.35:
            found["opacity"] = rng.choice(("0.2", "0.5", "0.8"))
        if rng.random() < 0.3:
            style.append(f"mix-blend-mode:{rng.choice(BLENDS)}")
        if rng.random() < 0.2:
            style.append("isolation:isolate")
        if rng.random() < 0.25:
            found["transform"] = self.transform()
        if rng.random() < 0.2:
            found["clip-path"] = f"url(#{self.clip()})"
        if rng.random() < 0.2:
            found["mask"] = f"url(#{self.mask()})"
        if style:
            found["style"] = ";".join(style)
        return "".join(f' {name}="{value}"' for name, value in found.items())

    def clip(self) -> str:
        """Name of a new clip path, which another one may clip."""
        rng = self.rng
        outer = f' clip-path="url(#{self.clip()})"' if rng.random() < 0.15 else ""
        rules = ("", ' clip-rule="evenodd"')
        paths = "".join(f'<path d="{self.outline()}"{rng.choice(rules)}/>' for _ in range(rng.randint(1, 2)))
        return self.define(f"clipPath{outer}", paths, "clipPath")

    def mask(self) -> str:
        """Name of a new mask, by luminance or by opacity."""
        rng = self.rng
        kind = rng.choice(("", ' style="mask-type:alpha"'))
        area = rng.choice(("", ' maskUnits="userSpaceOnUse" x="5" y="5" width="80" height="90"'))
        return self.define(f"mask{kind}{area}", "".join(self.shape() for _ in range(rng.randint(1, 3))), "mask")

    def define(self, head: str, inside: str, name: str) -> str:
        key = f"{name[0]}{len(self.definitions)}"
        self.definitions.append(f'<{head} id="{key}">{inside}</{name}>')
        return key
