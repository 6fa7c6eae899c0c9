"""Views of the page, chosen by the scene (a coast, a river or a flooded town), from the air and from dry ground."""

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Extent, Frame
from vexture_geo.flood.grids import coverage_over, size_for
from vexture_geo.flood.open_water import cells_of, openness_at
from vexture_geo.flood.relief import first_wet, widest

CELLS: Final = 96
"""Cells of the search grid on the frame's longer side."""

REACH: Final = 10
"""Cells around a place within which water in front and land behind are rated."""

BEHIND: Final = 4
"""Cells behind the shore in which a dry place is searched."""

EDGE: Final = 4
"""Cells along the frame's borders that are excluded, unless there is no other shore."""

ZOOMS: Final = 4
WINDOW: Final = 32
"""Zoom levels, and pixels of each, by which a place is refined to 1e-6 of the frame."""

FAR_REACH, NEAR_REACH = 0.2, 0.065
"""Half the width of a view of a coast and of a shore, as fractions of the longer side."""

FLOODED_REACH: Final = (0.04, 0.25)
"""Smallest and largest half width of a view of flooded land."""

LEAST_FLOODED: Final = 0.002
"""Least fraction of the frame that must be flooded for a view of it."""

TOWN_ISLANDS: Final = 12
"""Number of outlines from which a flood counts as standing between buildings."""

NEAR: Final = 4
"""Samples around a place whose highest water level counts."""

LOCAL: Final = 1 / 300
"""Radius within which the direction of the shore is measured, as a fraction of the frame."""


class FloodView(NamedTuple):
    """A view of the page.

    `place` is where the viewer stands, or what is looked at, and `toward` the unit vector from there to the water, in
    unit-square units, y up. `reach` is half the width of the view, in metres, and `above` the highest water there, in
    metres above the still water.
    """

    name: str
    kind: str  # over, far, near: from the air, lower and lower; eye: from the ground
    place: tuple[float, float]
    toward: tuple[float, float]
    reach: float
    above: float

    def as_json(self) -> dict[str, Any]:
        """Return the view as the page's JSON."""
        return {**self._asdict(), "place": list(self.place), "toward": list(self.toward)}


class Shore(NamedTuple):
    """A place on the shore and the unit vector towards the water, in unit-square units, y up."""

    place: tuple[float, float]
    seaward: tuple[float, float]


def views_of(
    extent: Extent,
    openness: NDArray[np.float64] | None,
    highest: NDArray[np.float64] | None,
    beyond: NDArray[np.bool_] | None = None,
) -> tuple[FloodView, ...]:
    """Choose views besides those of the whole box, the farthest first.

    `openness` says where waves are (`vexture_geo.flood.open_water`). `highest` is the highest level of all steps on the
    grid of the relief, NaN where it is always dry; None without any water. `beyond` says where the sea continues beyond
    the source (`vexture_geo.flood.relief.beyond_of`).
    """
    frame, first, most = extent.frame, first_wet(extent), widest(extent)
    if first is None or most is None or openness is None or highest is None:
        return ()
    longest = max(frame.metres)
    views = []

    def add(name: str, kind: str, shore: Shore | None, reach: float) -> None:
        if shore is not None:
            views.append(FloodView(name, kind, *shore, reach, _level_near(highest, frame, shore.place)))

    at_rest, safe = (viewpoint(step.drawing, frame, beyond=beyond) for step in (first, most))
    flooded = _flooded_land(first.drawing, most.drawing, frame)
    if flooded is not None:
        place, share, is_town = flooded
        toward = at_rest.seaward if at_rest else (0.0, -1.0)
        add("Town" if is_town else "Flooded land", "over", Shore(place, toward), share * longest)
    if openness.any():
        shore = viewpoint(first.drawing, frame, openness=openness, beyond=beyond)
        add("Coast", "far", shore, FAR_REACH * longest)
        add("Shore", "near", shore, NEAR_REACH * longest)
        beach = viewpoint(first.drawing, frame, dry=most.drawing, openness=openness, beyond=beyond)
        add("Beach", "eye", beach or safe, 0.0)
    else:
        add(_name_of_bank(first.drawing, frame), "near", at_rest, NEAR_REACH * longest)
        add("Waterline", "eye", safe, 0.0)
    return tuple(views)


def viewpoint(
    drawing: Drawing,
    frame: Frame,
    *,
    dry: Drawing | None = None,
    openness: NDArray[np.float64] | None = None,
    beyond: NDArray[np.bool_] | None = None,
) -> Shore | None:
    """Find a place on the shore near the middle of the frame, with open water in front and dry land behind.

    With `dry`, a drawing of more water, it is a place behind the shore that stays dry. With `openness`, only water open
    to waves counts. The sea continues where it is `beyond` the source. None if all is dry or all is wet.
    """
    x0, y0, x1, y1 = frame.box
    size = size_for(frame, CELLS)
    sea = cells_of(beyond, size)
    wet = np.where(sea, np.float32(1.0), coverage_over(drawing, frame.box, size))
    if openness is not None:
        x, y = np.meshgrid(np.linspace(x0, x1, 2 * size[0] + 1)[1::2], np.linspace(y1, y0, 2 * size[1] + 1)[1::2])
        wet = wet * openness_at(openness, frame, np.stack([x, y], axis=-1)).astype(np.float32)
    step = max(x1 - x0, y1 - y0) / CELLS
    found = _best(wet, None if dry is None else np.where(sea, np.float32(1.0), coverage_over(dry, frame.box, size)))
    if found is None:
        return None
    row, column, across, up = found
    place = np.array([x0 + (column + 0.5) * (x1 - x0) / size[0], y1 - (row + 0.5) * (y1 - y0) / size[1]])
    seaward = np.array([across, up])
    place = _on_the_line(drawing if dry is None else dry, place, seaward, 1.5 * step)
    near = _seaward(drawing, place, LOCAL * max(x1 - x0, y1 - y0))
    if near is not None and near @ seaward > 0.0:
        seaward = near
    return Shore((float(place[0]), float(place[1])), (float(seaward[0]), float(seaward[1])))


def _level_near(levels: NDArray[np.float64], frame: Frame, place: tuple[float, float]) -> float:
    """Highest level within some samples of a place, 0 if there is none."""
    x0, y0, x1, y1 = frame.box
    rows, columns = levels.shape
    column = round((place[0] - x0) / (x1 - x0) * (columns - 1))
    row = round((y1 - place[1]) / (y1 - y0) * (rows - 1))
    around = levels[max(row - NEAR, 0) : row + NEAR + 1, max(column - NEAR, 0) : column + NEAR + 1]
    known = around[np.isfinite(around)]
    return float(known.max()) if known.size else 0.0


def _flooded_land(first: Drawing, most: Drawing, frame: Frame) -> tuple[tuple[float, float], float, bool] | None:
    """Middle of the flooded land, half its size as a fraction of the longer side, and whether buildings stand in it.

    The middle is the flooded place with the most flooded land around it. Water around many islands is taken to stand
    between buildings. None if hardly any land is flooded.
    """
    x0, y0, x1, y1 = frame.box
    size = size_for(frame, CELLS)
    before, after = (coverage_over(drawing, frame.box, size) for drawing in (first, most))
    flooded = np.clip(after - before, 0.0, 1.0)
    if flooded.mean() < LEAST_FLOODED:
        return None
    around = _blur(flooded, REACH) * (flooded >= flooded.max() / 2.0)
    row, column = np.unravel_index(int(np.argmax(around)), around.shape)
    place = (x0 + (float(column) + 0.5) * (x1 - x0) / size[0], y1 - (float(row) + 0.5) * (y1 - y0) / size[1])
    islands = sum(len(path.contours) for path in most.paths)
    share = float(np.clip(0.5 * np.sqrt(flooded.sum()) / CELLS, *FLOODED_REACH))
    return place, share, islands >= TOWN_ISLANDS


def _blur(grid: NDArray[np.float64], reach: int) -> NDArray[np.float64]:
    """Average boxes of cells, along one axis and then the other; beyond the grid values are 0."""
    width = 2 * reach + 1
    for axis in (0, 1):
        padded = np.pad(grid, [(reach + 1, reach) if axis == k else (0, 0) for k in (0, 1)])
        sums = np.cumsum(padded, axis)
        count = grid.shape[axis]
        grid = (np.take(sums, range(width, width + count), axis) - np.take(sums, range(count), axis)) / width
    return grid


def _name_of_bank(drawing: Drawing, frame: Frame) -> str:
    """Return Riverside where the water crosses the border of the frame more than once, or else Waterside."""
    wet = coverage_over(drawing, frame.box, size_for(frame, CELLS)) >= 0.5
    border = np.concatenate([wet[0], wet[:, -1], wet[-1, ::-1], wet[::-1, 0]])
    return "Riverside" if int((border & ~np.roll(border, 1)).sum()) >= 2 else "Waterside"


def _best(wet: NDArray[np.float32], dry: NDArray[np.float32] | None) -> tuple[int, int, float, float] | None:
    """Row, column and direction of the best place: dry, beside water, open ahead, and near the middle.

    With `dry`, the place must also be outside of that water, at the shore or a few cells from it.
    """
    padded = np.pad(wet, 1, mode="edge")
    around = np.stack([padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]])
    shore = (wet < 0.5) & (around.max(axis=0) >= 0.5)
    if dry is not None:
        shore = (dry < 0.05) & (_blur((wet >= 0.5).astype(np.float64), BEHIND) > 0.0)
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
    """Move a place along a direction onto the shoreline, if that is within reach."""
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
    """Direction from the land to the water around a place; None if water and land are balanced."""
    wet = coverage_over(drawing, _around(place, reach), (WINDOW, WINDOW)) - 0.5
    middles = (np.arange(WINDOW) + 0.5) / WINDOW * 2.0 - 1.0
    pull = np.array([(wet * middles).mean(), (wet * -middles[:, None]).mean()])
    length = float(np.hypot(*pull))
    return pull / length if length > 1e-6 else None


def _around(place: NDArray[np.float64], reach: float) -> tuple[float, float, float, float]:
    x, y = (float(number) for number in place)
    return x - reach, y - reach, x + reach, y + reach
