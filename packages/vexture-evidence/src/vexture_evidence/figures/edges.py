"""An enlarged piece of an outline, drawn by several methods, with their errors (thesis 4.14)."""

from typing import TYPE_CHECKING, Final

import numpy as np

from vexture_evidence.figures.style import error_map, panels, show
from vexture_evidence.measures.metrics import LEVELS
from vexture_evidence.measures.renderings import Rendered

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SHOWN: Final = 32.0
"""Error, in 1/255, that has the darkest colour."""


def edges(rendered: Rendered) -> "Figure":
    """Show the pixels of an outline by each method and their exact coverage; below, the error of each pixel.

    Parameters
    ----------
    rendered : Rendered
        What `vexture_evidence.measures.renderings.at_edge` returns.

    Examples
    --------
    >>> from vexture_evidence.measures.renderings import at_edge
    >>> from vexture_evidence.measures.shape import ConvertedDrawing, example
    >>> figure = edges(at_edge(ConvertedDrawing(example("duck")), 8))
    >>> [panel.get_title(loc="left") for panel in figure.axes[:4]]
    ['centre of the pixel', '16 samples', 'packed', 'truth']
    """
    images = {**rendered.images, "truth": rendered.truth}
    figure, axes = panels(2, len(images), side=11.2 / 4, height=2.75, titles=tuple(images))
    errors = rendered.errors
    for (above, below), (name, image) in zip(axes.T, images.items(), strict=True):
        show(above, image)
        if name == "truth":
            below.set_axis_off()
            continue
        off = LEVELS * np.abs(np.float64(image) - rendered.truth)
        scale = show(below, off, pixels=False, cmap=error_map(), vmax=SHOWN)
        below.set_xlabel(f"error: mean {errors[name].mae:.2f}, largest {errors[name].max:.1f}", fontsize=9.0)
    bar = axes[1, -1].inset_axes((0.0, 0.55, 0.9, 0.06))
    figure.colorbar(scale, cax=bar, orientation="horizontal", extend="max", label="error of a pixel, in 1/255")
    return figure
