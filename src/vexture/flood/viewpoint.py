"""Where the page's camera first stands: on the shore, with open water in front."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing
from vexture.flood.grids import coverage_over, size_for
from vexture.geo.extent import Frame

__all__ = ["Shore", "viewpoint"]

CELLS: Final = 96
"""Cells of the search grid on the frame's longer side."""

REACH: Final = 10
"""Cells around a place in which water in front and land behind are rated."""

EDGE: Final = 4
"""Cells along the frame's borders that are excluded, unless there is no other shore."""

ZOOMS: Final = 4
WINDOW: Final = 32
"""Zoom levels, and pixels of each, by which a place is refined to 1e-6 of the frame."""

LOCAL: Final = 1 / 300
"""Radius in which the direction of the shore is measured, as a share of the frame."""


class Shore(NamedTuple):
    """A place on the shore and the unit vector towards the water, in unit-square units, y up."""

    place: tuple[float, float]
    seaward: tuple[float, float]


def viewpoint(drawing: Drawing, frame: Frame) -> Shore | None:
    """A place on the shore near the middle of the frame, with open water in front and dry land behind.

    None if the frame is all dry or all wet.
    """
    x0, y0, x1, y1 = frame.box
    size = size_for(frame, CELLS)
    wet = coverage_over(drawing, frame.box, size)
    step = max(x1 - x0, y1 - y0) / CELLS
    found = _best(wet)
    if found is None:
        return None
    row, column, across, up = found
    place = np.array([x0 + (column + 0.5) * (x1 - x0) / size[0], y1 - (row + 0.5) * (y1 - y0) / size[1]])
    seaward = np.array([across, up])
    place = _on_the_line(drawing, place, seaward, 1.5 * step)
    near = _seaward(drawing, place, LOCAL * max(x1 - x0, y1 - y0))
    if near is not None and near @ seaward > 0.0:
        seaward = near
    return Shore((float(place[0]), float(place[1])), (float(seaward[0]), float(seaward[1])))


def _best(wet: NDArray[np.float32]) -> tuple[int, int, float, float] | None:
    """Row, column and direction of the best place: dry, beside water, open ahead, near the middle."""
    padded = np.pad(wet, 1, mode="edge")
    around = np.stack([padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]])
    shore = (wet < 0.5) & (around.max(axis=0) >= 0.5)
    inner = np.zeros_like(shore)
    inner[EDGE:-EDGE, EDGE:-EDGE] = True
    places = np.argwhere(shore & inner)
    if not len(places):
        places = np.argwhere(shore)
    if not len(places):
        return None
    reach = np.arange(-REACH, REACH + 1)
    offsets = np.stack(np.meshgrid(reach, reach, indexing="ij"), axis=-1).reshape(-1, 2)
    offsets = offsets[(np.hypot(*offsets.T) <= REACH) & offsets.any(axis=1)]
    there = places[:, None] + offsets
    rows, columns = (np.clip(there[..., axis], 0, wet.shape[axis] - 1) for axis in (0, 1))
    values = wet[rows, columns] - 0.5
    units = offsets / np.hypot(*offsets.T)[:, None]
    pull = (values[..., None] * units).mean(axis=1)
    length = np.hypot(*pull.T)
    ways = pull / np.maximum(length, 1e-9)[:, None]
    ahead = ways @ units.T
    open_water = np.where(ahead > 0.7, values + 0.5, 0.0).sum(axis=1) / np.maximum((ahead > 0.7).sum(axis=1), 1)
    land = np.where(ahead < -0.7, 0.5 - values, 0.0).sum(axis=1) / np.maximum((ahead < -0.7).sum(axis=1), 1)
    off = np.hypot(*((places + 0.5) / wet.shape - 0.5).T)
    best = int(np.argmax(open_water + 0.7 * land - 0.8 * off))
    row, column = places[best]
    down, across = ways[best] if length[best] > 0.0 else (0.0, 1.0)
    return int(row), int(column), float(across), float(-down)


def _on_the_line(
    drawing: Drawing, place: NDArray[np.float64], seaward: NDArray[np.float64], reach: float
) -> NDArray[np.float64]:
    """Place moved along a direction onto the shoreline, if that is within reach."""
    for _ in range(ZOOMS):
        wet = coverage_over(drawing, _around(place, reach), (WINDOW, WINDOW))
        along = np.linspace(-reach, reach, 2 * WINDOW + 1)
        points = place + along[:, None] * seaward
        columns = np.clip(((points[:, 0] - place[0]) / reach + 1.0) * WINDOW / 2, 0, WINDOW - 1).astype(int)
        rows = np.clip((1.0 - (points[:, 1] - place[1]) / reach) * WINDOW / 2, 0, WINDOW - 1).astype(int)
        under = wet[rows, columns] >= 0.5
        crossings = np.flatnonzero(~under[:-1] & under[1:])
        if not len(crossings):
            break
        nearest = crossings[np.argmin(np.abs(along[crossings]))]
        place = place + seaward * (along[nearest] + along[nearest + 1]) / 2
        reach *= 3.0 / WINDOW
    return place


def _seaward(drawing: Drawing, place: NDArray[np.float64], reach: float) -> NDArray[np.float64] | None:
    """Direction from the land to the water around a place; None if there is no difference."""
    wet = coverage_over(drawing, _around(place, reach), (WINDOW, WINDOW)) - 0.5
    middles = (np.arange(WINDOW) + 0.5) / WINDOW * 2.0 - 1.0
    pull = np.array([(wet * middles).mean(), (wet * -middles[:, None]).mean()])
    length = float(np.hypot(*pull))
    return pull / length if length > 1e-6 else None


def _around(place: NDArray[np.float64], reach: float) -> tuple[float, float, float, float]:
    x, y = (float(number) for number in place)
    return x - reach, y - reach, x + reach, y + reach
