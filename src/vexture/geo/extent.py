"""Where water is, at one time or at several: what all readers of geographic data give."""

from dataclasses import dataclass
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.geo.frame import Frame
from vexture.notes import Note

__all__ = ["Extent", "Step"]


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """Where water is at one time.

    Parameters
    ----------
    drawing : Drawing
        The area under water, in the frame; without paths if all is dry. Its notes are those of the file.
    time : datetime or None
        When, as the file says it (UTC where it says nothing).
    depth : (rows, columns) float32 array or None
        Depth in metres over the frame, the northernmost row first, NaN where nothing is known; None where the source
        has none.
    """

    drawing: Drawing
    time: datetime | None = None
    depth: NDArray[np.float32] | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Extent:
    """Where water is, in one frame.

    Parameters
    ----------
    frame : Frame
        Rectangle of the world that all steps are read into.
    steps : tuple of Step
        In the order of time; one for a file without time.
    bed : (rows, columns) float32 array or None
        Height of the bed in metres over the frame, the northernmost row first, where the source has it.
    notes : tuple of Note
        What was noticed while it was read.

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
