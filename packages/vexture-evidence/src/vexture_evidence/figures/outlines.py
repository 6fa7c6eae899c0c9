"""A drawing's own outline, drawn over any figure of the unit square."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from vexture.bezier.points import points_along
from vexture.drawing.drawing import Drawing
from vexture_evidence.measures.closeups import all_cubics

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CHORDS = 256
"""Straight lines for each cubic, enough for curves to look smooth when enlarged a thousand times."""


def draw_outline(axes: "Axes", drawing: Drawing, bounds: Sequence[float] = (0.0, 0.0, 1.0, 1.0), **style: Any) -> None:
    """Draw the curves of a drawing in the visible part.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Axes of the unit square.
    drawing : Drawing
    bounds : sequence of float
        The visible part: x0, y0, x1, y1.
    style
        Passed to ``Axes.plot``.

    Examples
    --------
    >>> from vexture_evidence.figures.style import panels
    >>> figure, axes = panels(1, 1)
    >>> draw_outline(axes[0, 0], Drawing.polygon([(0, 0), (1, 0), (0, 1)]), color="black")
    >>> len(axes[0, 0].lines)
    1
    """
    x0, y0, x1, y1 = bounds
    t = np.linspace(0.0, 1.0, CHORDS + 1)
    cubics = all_cubics(drawing)
    seen = (cubics.min(axis=1) <= (x1, y1)).all(axis=1) & (cubics.max(axis=1) >= (x0, y0)).all(axis=1)
    curves = points_along(cubics[seen], t)
    curves = np.pad(curves, ((0, 0), (0, 1), (0, 0)), constant_values=np.nan)  # a gap between curves
    axes.plot(*curves.reshape(-1, 2).T, **style)
