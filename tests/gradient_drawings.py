"""Drawings with gradients of all kinds."""

import numpy as np

from degenerate import circle, polygon
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Gradient, Paint, Spread, Stop

SQUARE = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
WARM = (Stop(0, (1, 1, 1)), Stop(0.4, (0.9, 0.2, 0.1)), Stop(1, (0.2, 0, 0.3)))
FADING = (Stop(0, (1, 1, 0.2), 0.9), Stop(0.6, (0.1, 0.7, 1), 0.5), Stop(1, (0, 0, 0.4), 0))
BANDS = tuple(
    Stop(at, colour) for at, colour in ((0.3, (1, 0, 0)), (0.3, (1, 1, 1)), (0.6, (1, 1, 1)), (0.6, (0, 0, 1)))
)


def linear(start, end, stops, spread=Spread.PAD) -> Gradient:
    """Linear gradient from one point of the unit square to another."""
    start, way = np.array(start), np.subtract(end, start)
    x, y = way / (way @ way)
    return Gradient(((x, y, -(start @ (x, y))), (-y, x, 0.0)), tuple(stops), spread)


def radial(middle, radius, stops, spread=Spread.PAD, focus=None, focal_radius=0.0) -> Gradient:
    """Radial gradient about a point, with another focal point; the focal radius is a share of the radius."""
    away = np.subtract(middle if focus is None else focus, middle)
    x, y = away / np.hypot(*away) if away.any() else (1.0, 0.0)
    rows = np.array([(x, y), (-y, x)]) / radius
    moved = -rows @ np.array(middle)
    to_ramp = tuple((*row, at) for row, at in zip(rows.tolist(), moved.tolist(), strict=True))
    return Gradient(to_ramp, tuple(stops), spread, (float(np.hypot(*away) / radius), focal_radius))


def painted_path(contour, paint, group=-1) -> Path:
    """A path of one contour; a gradient is a paint."""
    return Path((contour,), paint=Paint.from_gradient(paint) if isinstance(paint, Gradient) else paint, group=group)


DISC, LENS, OTHER = circle((0.5, 0.5), 0.45), circle((0.4, 0.45), 0.33), circle((0.62, 0.58), 0.3)
UPWARDS = painted_path(SQUARE, linear((0, 0), (0, 1), WARM))
DRAWINGS: dict[str, Drawing] = {
    "highlight": Drawing((painted_path(DISC, radial((0.5, 0.5), 0.45, WARM, focus=(0.35, 0.7))),)),
    "overlay": Drawing(
        (
            painted_path(SQUARE, linear((0, 0), (1, 1), WARM)),
            painted_path(LENS, linear((0.1, 0.2), (0.7, 0.8), FADING)),
            painted_path(OTHER, radial((0.6, 0.6), 0.3, FADING)),
        )
    ),
    "bands": Drawing((painted_path(DISC, linear((0.1, 0.2), (0.9, 0.7), BANDS)),)),
    "repeated": Drawing((painted_path(DISC, linear((0.4, 0.4), (0.52, 0.46), WARM[:2], Spread.REPEAT)),)),
    "reflected": Drawing((painted_path(SQUARE, radial((0.4, 0.6), 0.17, WARM, Spread.REFLECT, (0.45, 0.65), 0.2)),)),
    "cone": Drawing(
        (
            painted_path(SQUARE, Paint((0.9, 0.9, 0.9))),
            painted_path(SQUARE, radial((0.6, 0.5), 0.2, WARM, focus=(0.2, 0.4))),
        )
    ),
    "groups": Drawing(
        (
            UPWARDS,
            painted_path(LENS, radial((0.4, 0.5), 0.3, WARM), 0),
            painted_path(OTHER, Paint((0.1, 0.8, 0.3)), 0),
            painted_path(circle((0.5, 0.3), 0.2), linear((0.3, 0.3), (0.7, 0.3), FADING), 1),
        ),
        groups=(Group(opacity=0.6), Group(blend=Blend.MULTIPLY, opacity=0.9)),
    ),
    "faded": Drawing(
        (
            UPWARDS,
            painted_path(SQUARE, linear((0, 0.2), (0, 0.8), (Stop(0, (1, 1, 1)), Stop(1, (0, 0, 0)))), 1),
            painted_path(LENS, Paint((0.1, 0.8, 0.3)), 0),
            painted_path(OTHER, linear((0.3, 0.3), (0.7, 0.3), FADING), 0),
            painted_path(DISC, radial((0.5, 0.5), 0.5, FADING), 2),
        ),
        groups=(Group(opacity=0.9), Group(0, mask=Mask.LUMINANCE), Group(0, 0.8, mask=Mask.OPACITY)),
    ),
}


def blend_drawing(blend: Blend) -> Drawing:
    """Drawing of a gradient that blends with another."""
    return Drawing((UPWARDS, painted_path(LENS, linear((0, 0), (1, 0), WARM[1:]), 0)), groups=(Group(-1, 0.8, blend),))
