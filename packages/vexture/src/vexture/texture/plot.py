"""A texture as a figure for a notebook: its cells, their coverage, and the picture."""

from io import BytesIO
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base import layout
from vexture.base.errors import DeviceError
from vexture.texture.walk import HALVES, walk

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PICTURE: Final = 256
"""Side of the picture in pixels."""

RESOLUTION: Final = 160
"""Pixels per inch in a notebook."""

FINEST: Final = 256
"""Quads with a side below 1/256 of the unit square are shown as one cell with their mean coverage."""


def cells_of(flat: NDArray[np.uint32], quad: int) -> NDArray[np.float64]:
    """Cells of one shape that are leaves, or whose parts are too small to be visible, (n, 5).

    The columns are left, bottom and side in unit-square units, depth, and coverage in 0..1.
    """
    corners, side, found = np.zeros((1, 2)), 0.5, []
    for depth, level in enumerate(walk(flat, np.array([quad])), 1):
        low = (corners[:, None] + side * HALVES).reshape(-1, 2)
        divided = level.is_quad.ravel() & (side * FINEST > 1.0)
        coverage = level.coverages.ravel() / layout.COVERAGE_ONE
        cells = np.column_stack([low, np.full(len(low), side), np.full(len(low), depth), coverage])
        found.append(cells[~divided])
        if not divided.any():
            break
        corners, side = low[level.is_quad.ravel()], side / 2
    return np.concatenate(found)


def plot_shape(flat: NDArray[np.uint32], quad: int, picture: NDArray[np.float32], title: str) -> "Figure":
    """Draw the three panels; `picture` (height, width) is the coverage of the shape, `title` the last panel's title."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ModuleNotFoundError:
        raise DeviceError("plot needs the package matplotlib: pip install 'vexture[plot]'") from None

    class Shown(Figure):
        """A figure that notebooks show without pyplot."""

        def _repr_png_(self) -> bytes:
            data = BytesIO()
            self.savefig(data, format="png", dpi=RESOLUTION)
            return data.getvalue()

    cells = cells_of(flat, quad)
    figure = Shown(figsize=(11.0, 3.6), layout="constrained")
    FigureCanvasAgg(figure)
    depths, coverages, image = figure.subplots(1, 3)
    _draw(figure, depths, cells, 3, "cells", cmap="YlOrBr", label="depth")
    _draw(figure, coverages, cells, 4, "coverage", cmap="Blues", label="covered part", clim=(0.0, 1.0))
    image.imshow(picture, cmap="gray_r", vmin=0.0, vmax=1.0, extent=(0.0, 1.0, 0.0, 1.0))
    image.set_title(title, loc="left")
    return figure


def _draw(
    figure: "Figure", axes: "Axes", cells: NDArray[np.float64], column: int, title: str, label: str, **style: Any
) -> None:
    from matplotlib.collections import PolyCollection

    x, y, side = cells[:, 0], cells[:, 1], cells[:, 2]
    squares = np.stack([x, y, x + side, y, x + side, y + side, x, y + side], axis=1).reshape(-1, 4, 2)
    drawn = PolyCollection(list(squares), array=cells[:, column], edgecolors="#00000030", linewidths=0.5, **style)
    axes.add_collection(drawn)
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0), aspect="equal")
    axes.set_title(title, loc="left")
    figure.colorbar(drawn, ax=axes, label=label)
