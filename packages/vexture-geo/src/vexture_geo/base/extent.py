"""`Extent`, the result of all readers of geographic data: wet places at each time, in a `Frame` of the world."""

from dataclasses import dataclass
from datetime import datetime
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.notes import Note
from vexture.drawing.drawing import Drawing
from vexture_geo.base.depth_ranges import DepthRange

Bounds: TypeAlias = tuple[float, float, float, float]
"""West, south, east, north."""

LARGEST: Final = 1e15
"""Largest coordinate, in the units of the file. Beyond it, float64 does not resolve a metre."""

MARGIN: Final = 1 / 32
"""Fraction of the unit square left free on each side, for what a fold moves in from beyond the frame."""


@dataclass(frozen=True, slots=True)
class Frame:
    """A rectangle of the world; drawings read into the same frame align.

    It lies in the middle of the unit square, at its aspect ratio on the ground, with `MARGIN` at the ends of its
    longer side. Drawings extend beyond it to the borders of the square.

    Parameters
    ----------
    bounds : tuple of float
        West, south, east, north, in the units of the reference system.
    crs : str
        Reference system, as text that pyproj understands: ``EPSG:32610``, WKT.
    metres : tuple of float
        Width and height on the ground.

    Examples
    --------
    >>> frame = Frame((0.0, 0.0, 2000.0, 1000.0), "EPSG:28992", (2000.0, 1000.0))
    >>> frame.box
    (0.03125, 0.265625, 0.96875, 0.734375)
    >>> frame.to_source @ (0.5, 0.5, 1.0)
    array([1000.,  500.])
    """

    bounds: Bounds
    crs: str
    metres: tuple[float, float]

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Place of the frame in the unit square: x0, y0, x1, y1."""
        share = 0.5 - MARGIN
        half_x, half_y = (share * side / max(self.metres) for side in self.metres)
        return (0.5 - half_x, 0.5 - half_y, 0.5 + half_x, 0.5 + half_y)

    @property
    def to_source(self) -> NDArray[np.float64]:
        """Return the affine matrix from the unit square to the units of the reference system, (2, 3)."""
        west, south, east, north = self.bounds
        x0, y0, x1, y1 = self.box
        across, up = (east - west) / (x1 - x0), (north - south) / (y1 - y0)
        return np.array([[across, 0.0, west - across * x0], [0.0, up, south - up * y0]])


def bounds_of_square(frame: Frame, margin: float = 0.0) -> Bounds:
    """Bounds of a frame's unit square, widened by a fraction of its sides, in the units of the reference system."""
    (across, _, west), (_, up, south) = frame.to_source.tolist()
    far = 1.0 + margin
    return (west - margin * across, south - margin * up, west + far * across, south + far * up)


@dataclass(frozen=True, slots=True, eq=False)
class DepthClasses:
    """Classes of depth at one time, from a file that holds classes in place of depths.

    Parameters
    ----------
    ranges : tuple of DepthRange
        Lower and upper limit of each class of water in metres, the shallowest first.
    ranks : (rows, columns) uint8 array
        Index of the class over the frame, the northernmost row first: 1 for the first range, 0 where dry or unknown.
    contours : tuple of float
        Limits between classes, in metres, from which the areas `Step.deeper` begin.
    """

    ranges: tuple[DepthRange, ...]
    ranks: NDArray[np.uint8]
    contours: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """Water at one time.

    Parameters
    ----------
    drawing : Drawing
        The area under water, in the frame; without paths if all is dry. Its notes are those of the file.
    time : datetime or None
        Time in the file (in UTC if it names no time zone).
    depth : (rows, columns) float32 array or None
        Depth in metres over the frame, the northernmost row first; NaN where unknown. None if the source has no depths,
        or only classes of them.
    deeper : tuple of Drawing
        For each requested depth, the area with at least that depth; for classes of depth, one for each of their
        `contours`; empty if the source has no depths.
    speed : (rows, columns) float32 array or None
        Speed of the water in metres a second, arranged like `depth`; None if the source has none.
    classes : DepthClasses or None
        Classes of depth, if the source holds them in place of depths.
    """

    drawing: Drawing
    time: datetime | None = None
    depth: NDArray[np.float32] | None = None
    deeper: tuple[Drawing, ...] = ()
    speed: NDArray[np.float32] | None = None
    classes: DepthClasses | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Extent:
    """Water at one time or several, in one frame.

    Parameters
    ----------
    frame : Frame
        Rectangle of the world into which all steps are read.
    steps : tuple of Step
        In order of time; one for a file without times.
    bed : (rows, columns) float32 array or None
        Height of the bed in metres over the frame, the northernmost row first; None if the source has none.
    notes : tuple of Note
        What was left out, simplified or chosen while reading.

    Examples
    --------
    >>> from vexture import read_extent
    >>> pond = b'{"type": "Polygon", "coordinates": [[[4, 52], [5, 52], [5, 53], [4, 53]]]}'
    >>> extent = read_extent(pond, "pond.geojson")
    >>> extent.steps[0].time, extent.bed, extent.frame.bounds
    (None, None, (4.0, 52.0, 5.0, 53.0))
    """

    frame: Frame
    steps: tuple[Step, ...]
    bed: NDArray[np.float32] | None = None
    notes: tuple[Note, ...] = ()
