"""Parameters of `vexture flood`, checked before any file is read."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypedDict

from vexture.base.errors import ParameterError
from vexture.base.tolerance import HMIN

if TYPE_CHECKING:
    from vexture.base.workers import Workers
    from vexture_geo.depth.depths import DepthOptions

PERIOD: Final = 8.0
"""Default seconds between two waves on a beach."""

DEPTHS: Final = (0.0, 0.2, 0.5, 1.0, 2.0, 5.0)
"""Default depths, in metres, at which the classes of the map of depths begin."""

MOST_CLASSES: Final = 8

SHORTEST_PERIOD, LONGEST_PERIOD = 0.1, 600.0
MOST_AMPLITUDE: Final = 0.05
"""Largest amplitude, as a fraction of the frame's longer side."""

SHARE: Final = 0.002
"""Default amplitude, as a fraction of the longer side."""


@dataclass(frozen=True, slots=True)
class FloodOptions:
    """Parameters of one flood; see `vexture flood --help`. Values out of range raise `ParameterError`."""

    extent: Path
    crs: str | None = None
    bounds: tuple[float, float, float, float] | None = None
    time_dim: str | None = None
    hmin: float = HMIN
    variable: str | None = None
    layer: str | None = None
    ground: Path | None = None
    relief: Path | None = None
    amplitude: float | None = None
    period: float = PERIOD
    title: str | None = None
    source: str | None = None
    licence: str | None = None
    depths: tuple[float, ...] = DEPTHS
    workers: int = 1
    scheduler: str | None = None

    def __post_init__(self) -> None:
        if not (isfinite(self.hmin) and self.hmin > 0.0):
            raise ParameterError(f"`hmin` {self.hmin:g}: it is a depth in metres, above 0")
        if self.amplitude is not None and not (isfinite(self.amplitude) and self.amplitude >= 0.0):
            raise ParameterError(f"`amplitude` {self.amplitude:g}: it is a length in metres, 0 or more")
        if not (1 <= len(self.depths) <= MOST_CLASSES):
            raise ParameterError(f"`depths`: {len(self.depths)} classes; give 1 to {MOST_CLASSES} depths")
        if not all(isfinite(depth) and depth >= 0.0 for depth in self.depths) or any(
            below >= above for below, above in pairwise(self.depths)
        ):
            listed = ",".join(f"{depth:g}" for depth in self.depths)
            raise ParameterError(f"`depths` {listed}: they are metres, 0 or more, and each above the one before")
        if not SHORTEST_PERIOD <= self.period <= LONGEST_PERIOD:
            raise ParameterError(
                f"`period` {self.period:g}: it must be {SHORTEST_PERIOD:g} to {LONGEST_PERIOD:g} seconds"
            )

        if self.workers < 1:
            raise ParameterError(f"`workers` {self.workers}: it is a number of processes, 1 or more")

    def executor(self) -> "Workers":
        """Executor of the conversion: the workers of a scheduler, several processes, or this process."""
        from vexture.base.workers import Cluster, InProcess, Processes

        if self.scheduler is not None:
            return Cluster(self.scheduler)
        return Processes(self.workers) if self.workers > 1 else InProcess()

    @property
    def reading(self) -> dict[str, Any]:
        """Parameters of the reader that also apply to files uploaded later."""
        named = {"time_dim": self.time_dim, "variable": self.variable, "layer": self.layer}
        given: dict[str, Any] = {name: value for name, value in named.items() if value is not None}
        return {**given, "depths": self.contours}

    @property
    def of_depths(self) -> "DepthOptions":
        """Parameters of the reader of depths, which has no layers."""
        return {
            "crs": self.crs,
            "time_dim": self.time_dim,
            "hmin": self.hmin,
            "variable": self.variable,
            "depths": self.contours,
        }

    @property
    def contours(self) -> tuple[float, ...]:
        """Depths, in metres, between consecutive classes of the map of depths."""
        return contours_of(self.depths, self.hmin)

    def amplitude_in(self, longest: float) -> float:
        """Amplitude of the shoreline in metres, in a frame whose longer side has `longest` metres."""
        if self.amplitude is None:
            return SHARE * longest
        if self.amplitude > MOST_AMPLITUDE * longest:
            raise ParameterError(
                f"`amplitude` {self.amplitude:g}: the limit is {MOST_AMPLITUDE * longest:.3g} m, a twentieth of the "
                f"longer side of {longest:.3g} m; choose a smaller one"
            )
        return self.amplitude


class FloodParameters(TypedDict, total=False):
    """Parameters of `FloodOptions` that `flood_page` passes on."""

    crs: str | None
    bounds: tuple[float, float, float, float] | None
    time_dim: str | None
    hmin: float
    variable: str | None
    layer: str | None
    amplitude: float | None
    period: float
    title: str | None
    source: str | None
    licence: str | None
    workers: int
    scheduler: str | None


def contours_of(depths: tuple[float, ...], hmin: float) -> tuple[float, ...]:
    """Depths, in metres, between consecutive classes that begin at `depths`.

    Examples
    --------
    >>> contours_of((0.0, 0.2, 1.0), 0.05), contours_of((0.0, 0.2, 1.0), 0.5)
    ((0.2, 1.0), (1.0,))
    """
    return tuple(depth for depth in depths[1:] if depth > hmin)


def depths_of(text: str) -> tuple[float, ...]:
    """Parse depths that a user has written as 0.2,0.5,1; the first class begins at 0.

    Examples
    --------
    >>> depths_of("0.5,1,2")
    (0.0, 0.5, 1.0, 2.0)
    >>> depths_of("deep")
    Traceback (most recent call last):
    vexture.base.errors.ParameterError: `depths` deep: give metres with commas between them, as in 0.2,0.5,1,2
    """
    try:
        depths = tuple(float(part) for part in text.split(","))
    except ValueError:
        raise ParameterError(f"`depths` {text}: give metres with commas between them, as in 0.2,0.5,1,2") from None
    return classes_of(depths)


def classes_of(depths: Sequence[float]) -> tuple[float, ...]:
    """Add the class that begins at 0 to depths at which classes begin, unless it is there.

    Examples
    --------
    >>> classes_of([0.5, 2.0])
    (0.0, 0.5, 2.0)
    """
    return tuple(depths) if tuple(depths[:1]) == (0.0,) else (0.0, *depths)


def bounds_of(text: str) -> tuple[float, float, float, float]:
    """Parse bounds that a user has written as W,S,E,N.

    Examples
    --------
    >>> bounds_of("-122.1,36.9,-121.9,37")
    (-122.1, 36.9, -121.9, 37.0)
    >>> bounds_of("1,2,3")
    Traceback (most recent call last):
    vexture.base.errors.ParameterError: `bounds` 1,2,3: give four numbers, west,south,east,north, without spaces
    """
    try:
        west, south, east, north = (float(part) for part in text.split(","))
    except ValueError:
        raise ParameterError(f"`bounds` {text}: give four numbers, west,south,east,north, without spaces") from None
    if not all(map(isfinite, (west, south, east, north))):
        raise ParameterError(f"`bounds` {text}: every number must be finite")
    if west == east or south >= north:
        raise ParameterError(f"`bounds` {text}: the box is empty; the order is west,south,east,north")
    return west, south, east, north
