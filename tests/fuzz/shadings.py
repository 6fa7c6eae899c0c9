"""Random gradients for random drawings: all kinds, also those at the edge of what SVG allows."""

from collections.abc import Callable
from random import Random


class Shadings:
    """The gradients of a drawing."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.definitions: list[str] = []

    def paint(self, color: Callable[[], str]) -> str:
        """Reference to a gradient: a new one, or one that is there."""
        rng = self.rng
        if not self.definitions or rng.random() < 0.7:
            self.add(color)
        return f"url(#g{rng.randrange(len(self.definitions)) if rng.random() < 0.3 else len(self.definitions) - 1})"

    def add(self, color: Callable[[], str]) -> None:
        rng = self.rng
        is_radial, in_user_space = rng.random() < 0.5, rng.random() < 0.5
        scale = 100.0 if in_user_space else 1.0
        found = {"gradientUnits": "userSpaceOnUse"} if in_user_space else {}
        found |= self.radial(scale) if is_radial else self.linear(scale)
        if rng.random() < 0.5:
            found["spreadMethod"] = rng.choice(("pad", "reflect", "repeat", "repeat"))
        if rng.random() < 0.35:
            found["gradientTransform"] = self.transform(scale)
        stops = self.stops(color)
        if self.definitions and rng.random() < 0.2:
            found["href"], stops = f"#g{rng.randrange(len(self.definitions))}", ""
        name = "radialGradient" if is_radial else "linearGradient"
        attributes = "".join(f' {key}="{value}"' for key, value in found.items())
        self.definitions.append(f'<{name} id="g{len(self.definitions)}"{attributes}>{stops}</{name}>')

    def length(self, low: float, high: float, scale: float) -> str:
        return f"{scale * self.rng.uniform(low, high):.{self.rng.choice((2, 3, 6))}f}"

    def linear(self, scale: float) -> dict[str, str]:
        """Ends anywhere, at the sides, near one another, or in one point."""
        rng, kind = self.rng, self.rng.random()
        if kind < 0.15:
            return rng.choice(({}, {"x2": "0", "y2": "100%"}, {"x2": "100%", "y2": "100%"}))
        ends = {name: self.length(0, 1, scale) for name in ("x1", "y1", "x2", "y2")}
        if kind < 0.4:
            ends["x2"] = f"{float(ends['x1']) + scale * rng.choice((0.001, 0.02, 0.1)):.6f}"
            ends["y2"] = f"{float(ends['y1']) + scale * rng.uniform(-0.1, 0.1):.6f}"
        if kind > 0.97:
            ends |= {"x2": ends["x1"], "y2": ends["y1"]}
        return ends

    def radial(self, scale: float) -> dict[str, str]:
        """A focal point at the middle, inside, on the circle or outside, and its circle."""
        rng = self.rng
        radius, x, y = rng.choice((0.02, 0.1, 0.18, 0.5, 0.7)) * rng.uniform(0.7, 1.3), *(rng.uniform(0.2, 0.8),) * 2
        found = {"cx": f"{scale * x:.4f}", "cy": f"{scale * y:.4f}", "r": f"{scale * radius:.4f}"}
        away = rng.choice((0.0, 0.0, 0.4, 0.9, 0.999, 1.0, 1.001, 1.6)) * rng.choice((-1, 1))
        if away:
            share = rng.choice((0.0, 0.6, 1.0))
            found["fx"] = f"{scale * (x + radius * away * share):.6f}"
            found["fy"] = f"{scale * (y + radius * away * (1 - share * share) ** 0.5):.6f}"
        if rng.random() < 0.25:
            found["fr"] = f"{scale * radius * rng.choice((0.1, 0.5, 0.9, 1.0, 1.2)):.4f}"
        return found

    def transform(self, scale: float) -> str:
        rng, half = self.rng, f"{scale / 2:g} {scale / 2:g}"
        return rng.choice(
            (
                f"rotate({rng.randrange(360)} {half})",
                f"skewX({rng.randint(-50, 50)})",
                f"translate({scale * rng.uniform(-0.3, 0.3):.3f}) scale(1 {rng.choice((0.1, 0.5, 2))})",
                f"rotate({rng.randrange(360)} {half}) skewY({rng.randint(-30, 30)})",
            )
        )

    def stops(self, color: Callable[[], str]) -> str:
        """Stops in order or not, many of them at one place: hard ones."""
        rng = self.rng
        offsets = [
            rng.choice((0.0, 1.0, 0.5, rng.random(), rng.random())) for _ in range(rng.choice((1, 2, 2, 3, 4, 6)))
        ]
        if rng.random() < 0.9:
            offsets.sort()
        if rng.random() < 0.35:  # bands
            offsets = [each for offset in offsets for each in (offset, offset)]
        found, before = "", color()
        for k, offset in enumerate(offsets):
            before = color() if k == 0 or rng.random() < 0.8 else before
            opacity = f' stop-opacity="{rng.choice(("0", "0.5", "0.8"))}"' if rng.random() < 0.3 else ""
            found += f'<stop offset="{offset:.3f}" stop-color="{before}"{opacity}/>'
        return found
