"""The exact picture of the tests' cells as a camera sees them: borders go to the screen in float64 and are filtered."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Final

import numpy as np
import shapely
import tile_pyramid
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact_colours

RIM: Final = 6.0
"""Pixels by which more is drawn than is seen."""

STEPS: Final = 200
"""Parts of a view's side, in which a border on a sphere is straight."""


def draw_exactly(size: int, project: Callable[[Any], Any], unproject: Callable[[Any], Any], *, is_curved: bool) -> Any:
    """The exact picture on white of a view that the map fills; `project` and `unproject` take lists of pairs."""
    along = np.linspace(-RIM, size + RIM, 33)
    low, high = np.full_like(along, -RIM), np.full_like(along, size + RIM)
    rim = np.concatenate([np.c_[along, low], np.c_[high, along], np.c_[along[::-1], high], np.c_[low, along[::-1]]])
    lng, lat = np.array(unproject(rim.tolist())).T
    around = np.c_[lng / 360 + 0.5, 0.5 - np.arcsinh(np.tan(np.radians(lat))) / (2 * np.pi)]
    view = shapely.make_valid(shapely.Polygon(around))
    paths = []
    for name, cell in tile_pyramid.cells().items():
        part = shapely.intersection(cell, view)
        if not isinstance(part, shapely.Polygon) or part.is_empty:
            continue
        if is_curved:
            part = shapely.segmentize(part, np.sqrt(view.area) / STEPS)
        places = [tile_pyramid.lng_lat(*place) for place in shapely.get_coordinates(part.exterior)]
        ring = shapely.Polygon(np.array(project(places)))
        on_screen = shapely.intersection(shapely.make_valid(ring), shapely.box(0, 0, size, size))
        for piece in shapely.get_parts(on_screen):
            if isinstance(piece, shapely.Polygon) and piece.area > 1e-9:
                corners = np.clip(shapely.get_coordinates(shapely.orient_polygons(piece).exterior)[:-1] / size, 0, 1)
                points = [(float(x), float(1 - y)) for x, y in corners]
                colour = Paint(tile_pyramid.colour(name))
                paths += [replace(path, paint=colour, element=name) for path in Drawing.polygon(points).paths]
    picture = render_exact_colours(Drawing(tuple(paths), name="seen"), size=size)
    return picture[..., :3] + 1.0 - picture[..., 3:]


def edges(picture: NDArray[np.float64], truth: Any) -> float:
    """Mean difference along edges, in steps of a byte, from the truth in bytes."""
    inside = (np.abs(truth[..., None, :] - np.array([*tile_pyramid.COLOURS, (1, 1, 1)])).max(axis=-1) < 1e-6).any(
        axis=-1
    )
    assert np.count_nonzero(~inside) > 100
    return float(np.abs(255 * picture - np.rint(255 * truth))[~inside].mean())
