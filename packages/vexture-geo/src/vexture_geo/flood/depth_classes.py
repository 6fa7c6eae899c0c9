"""Classes of depth: their colours, and a drawing of the areas of all of them."""

from dataclasses import replace
from typing import Final

from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture_geo.base.extent import Step
from vexture_geo.flood.options import contours_of

SEQUENCE: Final = ("#edf8b1", "#c7e9b4", "#7fcdbb", "#41b6c4", "#1d91c0", "#225ea8", "#253494", "#081d58")
"""ColorBrewer's YlGnBu (C. Brewer, 2002), whose order is also visible to colour-blind people and in gray.

Its palest colour is omitted, because it would not be visible on sand.
"""


def colors_of(count: int) -> list[str]:
    """Return `count` colours from pale to dark, as hexadecimal sRGB.

    Examples
    --------
    >>> colors_of(2), colors_of(1)
    (['#edf8b1', '#081d58'], ['#2fa4c2'])
    """
    last = len(SEQUENCE) - 1
    places = [last / 2] if count == 1 else [last * k / (count - 1) for k in range(count)]
    return [_between(*SEQUENCE[int(place) : int(place) + 2], share=place % 1.0) for place in places]


def _parts(color: str) -> list[int]:
    return [int(color[k : k + 2], 16) for k in (1, 3, 5)]


def _paint_of(color: str) -> Paint:
    red, green, blue = (part / 255.0 for part in _parts(color))
    return Paint((red, green, blue))


def _between(one: str, other: str | None = None, *, share: float) -> str:
    """Mix two colours."""
    parts = zip(_parts(one), _parts(other or one), strict=True)
    return "#" + "".join(f"{round(a + (b - a) * share):02x}" for a, b in parts)


def classes_shown(step: Step, depths: tuple[float, ...]) -> tuple[float, ...]:
    """Lower limits, in metres, of the classes shown for a step: `depths`, or those of a file of classes."""
    return depths if step.classes is None else (step.classes.ranges[0].low, *step.classes.contours)


def _is_of(step: Step, depths: tuple[float, ...], hmin: float) -> bool:
    """Return whether the areas of a step are those of the classes that begin at `depths`."""
    if step.classes is not None:
        return classes_shown(step, depths) == depths
    return len(step.deeper) == len(contours_of(depths, hmin)) and step.depth is not None


def class_drawing(step: Step, depths: tuple[float, ...], hmin: float, name: str) -> Drawing | None:
    """Draw the areas of a step's classes, each above the shallower ones, in their colours.

    None if all is dry, or the contours between the classes are unknown: for polygons, for an extent that was read with
    other contours, and for one with other classes.
    """
    if not step.drawing.paths or not _is_of(step, depths, hmin):
        return None
    areas = (step.drawing, *step.deeper)
    colors = colors_of(len(depths))[-len(areas) :]
    paths = (
        replace(path, paint=_paint_of(color), element=color)
        for area, color in zip(areas, colors, strict=True)
        for path in area.paths
    )
    return replace(step.drawing, paths=tuple(paths), name=name)
