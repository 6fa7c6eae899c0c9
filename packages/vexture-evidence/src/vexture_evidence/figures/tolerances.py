"""The effect of a tolerance that is too large, beside a packed texture, which needs none (thesis 5.12)."""

from typing import TYPE_CHECKING

import numpy as np

from vexture.drawing.drawing import Drawing
from vexture_evidence.figures.outlines import draw_outline
from vexture_evidence.figures.style import COLOURS, panels, show
from vexture_evidence.measures.renderings import Rendered

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def tolerances(drawing: Drawing, whole: Rendered, close: Rendered, square: tuple[float, float, float]) -> "Figure":
    """Show a shape by several conversions, and an enlarged part of it with the drawing's own outline over it.

    Parameters
    ----------
    drawing : Drawing
    whole, close : Rendered
        Pictures of the whole shape and of the enlarged part.
    square : tuple of float
        x, y and side of the enlarged part, in unit-square units. `vexture_evidence.measures.renderings.with_tolerances`
        returns these three arguments.

    Examples
    --------
    >>> from vexture_evidence.measures.renderings import with_tolerances
    >>> from vexture_evidence.measures.shape import ConvertedDrawing, example
    >>> duck = ConvertedDrawing(example("duck"))
    >>> _, *pictures = with_tolerances(duck, 32)
    >>> [panel.get_title(loc="left") for panel in tolerances(duck.drawing, *pictures).axes[:3]]
    ['sampled', 'sampled, ten times too loose', 'packed']
    """
    figure, axes = panels(2, len(whole.images), side=3.6, titles=tuple(whole.images))
    x, y, side = square
    errors = close.errors
    for (above, below), name in zip(axes.T, whole.images, strict=True):
        show(above, whole.images[name], extent=(0.0, 1.0, 0.0, 1.0))
        above.plot(*np.array([(x, y), (x + side, y), (x + side, y + side), (x, y + side), (x, y)]).T,
                   color=COLOURS["distance"], linewidth=1.2)  # fmt: skip
        show(below, 0.75 * close.images[name], extent=(x, x + side, y, y + side))
        draw_outline(below, drawing, (x, y, x + side, y + side), color=COLOURS["sampled"], linewidth=1.1)
        below.set(xlim=(x, x + side), ylim=(y, y + side))
        below.set_xlabel(
            f"error in this part: mean {errors[name].mae:.2f}, largest {errors[name].max:.0f}", fontsize=9.0
        )
        for panel in (above, below):
            panel.set_xticks(panel.get_xlim(), [f"{value:.3g}" for value in panel.get_xlim()])
            panel.set_yticks(panel.get_ylim(), [f"{value:.3g}" for value in panel.get_ylim()])
            panel.tick_params(length=2)
    return figure
