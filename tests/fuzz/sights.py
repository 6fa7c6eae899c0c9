"""Views of a drawing: whole, turned, sheared, tilted to 6:1, and from nearby at a place where there is something."""

import json
from dataclasses import asdict, dataclass
from math import cos, pi, sin
from random import Random

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Gradient, Spread

SIZES = (37, 61, 113, 199)
TILT = 6.0


@dataclass(frozen=True, slots=True)
class Sight:
    """A view for a square image, and its name."""

    size: int  # pixels
    matrix: tuple[tuple[float, float, float], tuple[float, float, float]]  # from pixels to the unit square
    name: str
    is_part: bool = False  # the texture holds only what the view shows

    @property
    def pixel(self) -> float:
        """Shortest width of a pixel in the unit square."""
        return float(np.linalg.svd(np.array(self.matrix)[:, :2], compute_uv=False)[-1])

    def text(self) -> str:
        """A line of JSON."""
        return json.dumps(asdict(self))

    @classmethod
    def parsed(cls, text: str) -> "Sight":
        """The sight of a line of JSON."""
        given = json.loads(text)
        return cls(**given | {"matrix": tuple(map(tuple, given["matrix"]))})


def sight_of(rng: Random, drawing: Drawing) -> Sight:
    """A view at random; one of several ways to look is always taken."""
    size, names = rng.choice(SIZES), []
    times = rng.choice((1, 1, 1, 1, 1, 50, 2000))
    steps = np.array([(1.0, 0.0), (0.0, -1.0)]) / (size * times)
    if rng.random() < 0.3:
        steps = np.diag((TILT, 1.0)) @ steps if times == 1 else np.diag((1.0, 1.0 / TILT)) @ steps
        names.append("6:1")
    if rng.random() < 0.25:
        steps = np.array([(1.0, rng.uniform(-1.0, 1.0)), (0.0, 1.0)]) @ steps
        names.append("sheared")
    if rng.random() < 0.6:
        angle = rng.choice((0.3, pi / 4, pi / 2, rng.uniform(0, 2 * pi)))
        steps = np.array([(cos(angle), -sin(angle)), (sin(angle), cos(angle))]) @ steps
        names.append("turned")
    if times == 1:
        place, pixel = np.array((0.5, 0.5)), np.array((size, size)) / 2
        if names:
            place += np.array((rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1)))
    else:
        place = place_of(rng, drawing)
        pixel = size * np.array((rng.uniform(0.2, 0.8), rng.uniform(0.2, 0.8)))
        names.append(f"{times} times")
    away = place - steps @ pixel
    rows = [(float(a), float(b), float(c)) for (a, b), c in zip(steps, away, strict=True)]
    return Sight(size, (rows[0], rows[1]), " ".join(names) or "whole", times > 1000 and rng.random() < 0.8)


def place_of(rng: Random, drawing: Drawing) -> NDArray[np.float64]:
    """A point of the unit square: on an outline, or at a stop of a gradient."""
    shades = [path.paint.gradient for path in drawing.paths if path.paint.gradient is not None]
    if shades and rng.random() < 0.5:
        point = stop_of(rng, rng.choice(shades))
        if ((point > 0.0) & (point < 1.0)).all():
            return point
    cubic = rng.choice(rng.choice(rng.choice(drawing.paths).contours))
    t = rng.choice((0.0, rng.random()))
    s = 1.0 - t
    return np.array(s**3 * cubic[0] + 3 * s * s * t * cubic[1] + 3 * s * t * t * cubic[2] + t**3 * cubic[3])


def stop_of(rng: Random, gradient: Gradient) -> NDArray[np.float64]:
    """A point where a gradient has a stop, in some period; nowhere near if its map has no inverse."""
    t = rng.choice(gradient.stops).offset
    if gradient.spread == Spread.REPEAT:
        t += rng.randint(0, 3)
    elif gradient.spread == Spread.REFLECT:
        t = t + 2 * rng.randint(0, 1) if rng.random() < 0.5 else 2 * rng.randint(1, 2) - t
    if gradient.focus is None:
        there = np.array((t, rng.uniform(-2.0, 2.0)))
    else:
        x, focal = gradient.focus
        angle, radius = rng.uniform(0, 2 * pi), (1 - t) * focal + t
        there = np.array((x * (1 - t) + radius * cos(angle), radius * sin(angle)))
    rows = np.array(gradient.to_ramp)
    try:
        return np.linalg.solve(rows[:, :2], there - rows[:, 2])
    except np.linalg.LinAlgError:
        return np.full(2, -1.0)
