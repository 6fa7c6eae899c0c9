"""Drawings with blurs of all kinds, and their closed forms."""

from math import erf, sqrt

import numpy as np

from degenerate import circle
from gradient_drawings import SQUARE, WARM, linear, painted_path
from vexture.drawing.blur import Blur
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Group, Mask
from vexture.drawing.paint import Paint

IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
WHOLE = (0.0, 0.0, 1.0, 1.0)
LOW, HIGH = 0.25, 0.75
"""Sides of the square that is blurred."""

INNER = Drawing.polygon([(LOW, LOW), (HIGH, LOW), (HIGH, HIGH), (LOW, HIGH)])
DISC = Drawing((painted_path(circle((0.5, 0.5), 0.3), Paint((0.2, 0.5, 0.9))),))
STRIPES = Drawing(
    tuple(
        Path(
            Drawing.polygon([(k / 4, 0), (k / 4 + 0.25, 0), (k / 4 + 0.25, 1), (k / 4, 1)]).paths[0].contours,
            paint=Paint(color),
        )
        for k, color in enumerate([(1.0, 0.0, 0.0), (0.0, 1.0, 0.2), (0.1, 0.0, 1.0), (0.9, 0.9, 0.9)])
    )
)


def box_integral(low: float, high: float, deviation: float, at: float) -> float:
    """Gaussian blur of an interval."""
    return 0.5 * (erf((at - low) / deviation / sqrt(2.0)) - erf((at - high) / deviation / sqrt(2.0)))


def blurred_square(deviations: tuple[float, float], x: float, y: float) -> float:
    """Opacity of the blurred inner square at a point."""
    return box_integral(LOW, HIGH, deviations[0], x) * box_integral(LOW, HIGH, deviations[1], y)


def soft_path(blur: Blur, color: tuple[float, float, float] = (0.0, 0.0, 0.0), opacity: float = 1.0) -> Path:
    """The unit square painted with a blur."""
    return painted_path(SQUARE, Paint(color, opacity, blur=blur))


def _drawings() -> dict[str, Drawing]:
    shadow = Blur(INNER, IDENTITY, (0.05, 0.03), WHOLE)
    turned = shadow.after(((0.8, -0.6, 0.4), (0.6, 0.8, -0.2)))
    inner = Blur(INNER, IDENTITY, (0.04, 0.04), (LOW, LOW, HIGH, HIGH), is_inverted=True)
    ramp = painted_path(SQUARE, linear((0, 0), (1, 1), WARM))
    disc = circle((0.5, 0.5), 0.45)
    return {
        "shadow": Drawing((soft_path(shadow, (0.1, 0.2, 0.6), 0.7), *INNER.paths)),
        "turned": Drawing((soft_path(turned, (1.0, 0.5, 0.0)),)),
        "inner shadow": Drawing((ramp, Path(INNER.paths[0].contours, paint=Paint((0.5, 0.0, 0.0), 0.9, blur=inner)))),
        "colours": Drawing((soft_path(Blur(STRIPES, IDENTITY, (0.06, 0.06), WHOLE, has_colors=True)),)),
        "linear light": Drawing(
            (soft_path(Blur(STRIPES, IDENTITY, (0.1, 0.06), WHOLE, has_colors=True, is_linear=True)),)
        ),
        "blurred mask": Drawing(
            (
                painted_path(disc, Paint((0.0, 0.6, 0.4)), 0),
                painted_path(SQUARE, Paint((1.0, 1.0, 1.0), blur=shadow), 1),
            ),
            groups=(Group(), Group(0, mask=Mask.OPACITY)),
        ),
        "two shadows": Drawing(
            (soft_path(shadow, (1.0, 0.0, 0.0), 0.5), soft_path(turned, (0.0, 0.0, 1.0), 0.5), *DISC.paths)
        ),
        "blur of a blur": Drawing(
            (
                soft_path(
                    Blur(Drawing((soft_path(shadow, (0.0, 0.4, 0.0)),)), IDENTITY, (0.05, 0.05), WHOLE, has_colors=True)
                ),
            )
        ),
    }


BLURS = _drawings()


def random_blur(rng: np.random.Generator) -> Blur:
    """A blur of a few squares, anywhere, turned and slanted."""
    squares = []
    for _ in range(int(rng.integers(1, 4))):
        low, high = np.sort(rng.uniform(0.0, 1.0, (2, 2)), axis=0).tolist()
        square = Drawing.polygon([(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])])
        squares.append(Path(square.paths[0].contours, paint=Paint(tuple(rng.random(3).tolist()), float(rng.random()))))
    rows = rng.normal(0.0, 1.0, (2, 3)).tolist()
    to_source = (rows[0][0], rows[0][1], rows[0][2]), (rows[1][0], rows[1][1], rows[1][2])
    left, low = rng.uniform(-0.5, 0.5, 2).tolist()
    window = left, low, left + float(rng.uniform(0.01, 1.5)), low + float(rng.uniform(0.01, 1.5))
    deviations = tuple(np.exp(rng.uniform(np.log(0.02), np.log(0.5), 2)).tolist())
    kind = int(rng.integers(4))
    return Blur(Drawing(tuple(squares)), to_source, deviations, window, kind >= 2, kind == 1, kind == 3)
