"""Lines as strokes, and points as symbols: areas of a width in metres, or in pixels of a map of a given size."""

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Literal

import numpy as np
import shapely
from numpy.typing import NDArray

from vexture.errors import ParameterError
from vexture.geo.crs import system, transformed
from vexture.geo.geojson import WORLD

if TYPE_CHECKING:
    from vexture.drawing import Drawing

__all__ = ["Length", "strokes", "symbols"]

LENGTH: Final = re.compile(r"(\d+(?:\.\d*)?|\.\d+)\s*(px|m|km)")
ROUND: Final = 8
"""Straight pieces of a quarter of a round join: off by 0.5% of the width."""


@dataclass(frozen=True, slots=True)
class Length:
    """A width or size: in metres on the ground, or in pixels of a map whose longer side has so many."""

    value: float
    unit: Literal["m", "px"]

    @classmethod
    def parsed(cls, text: str, option: str) -> "Length":
        """Length of a text; a `ParameterError` names the option.

        Examples
        --------
        >>> Length.parsed("1.5px", "stroke"), Length.parsed("2km", "stroke")
        (Length(value=1.5, unit='px'), Length(value=2000.0, unit='m'))
        """
        match = LENGTH.fullmatch(text.strip())
        if match is None or not 0.0 < float(match[1]) < 1e9:
            raise ParameterError(f"`{option}` {text[:40]!r} is no length above 0; give one such as 500m, 2km or 1.5px")
        value = float(match[1])
        return cls(1000.0 * value if match[2] == "km" else value, "px" if match[2] == "px" else "m")

    def at(self, places: NDArray[np.float64], crs: str, size: float, pixels: float) -> NDArray[np.float64]:
        """The length at places (n, 2) of a map, in its units; the map's longer side is `size`."""
        if self.unit == "px":
            return np.full(len(places), self.value * size / pixels)
        return self.value / metres_per_unit(places, crs, size)


def metres_per_unit(places: NDArray[np.float64], crs: str, size: float) -> NDArray[np.float64]:
    """Metres on the ground in a unit of a map, at places (n, 2): of Web Mercator, the cosine of the latitude."""
    found = system(crs)
    geod = found.get_geod()
    if geod is None:
        return np.ones(len(places))
    step = 1e-6 * size
    start, end = (transformed(places + np.array([offset, 0.0]), crs, WORLD) for offset in (-step / 2, step / 2))
    _, _, metres = geod.inv(start[:, 0], start[:, 1], end[:, 0], end[:, 1])
    return np.maximum(np.nan_to_num(np.asarray(metres) / step, nan=1.0, posinf=1.0), 1e-12)


def strokes(lines: NDArray[Any], width: Length, crs: str, size: float, pixels: float) -> NDArray[Any]:
    """Areas of lines, each of the width at its middle, with round joins and ends."""
    middles = shapely.get_coordinates(shapely.line_interpolate_point(lines, 0.5, normalized=True))
    half = width.at(middles, crs, size, pixels) / 2.0
    return np.asarray(shapely.buffer(lines, half, quad_segs=ROUND), object)


def symbols(
    points: NDArray[np.float64], symbol: "Drawing", width: Length, crs: str, size: float, pixels: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where copies of a drawing stand, by their lower left corners (n, 2) and sides (n,), in units of the map.

    The middle of each is on its point.
    """
    side = width.at(points, crs, size, pixels) / max(symbol.sides)
    return points - side[:, None] / 2.0, side
