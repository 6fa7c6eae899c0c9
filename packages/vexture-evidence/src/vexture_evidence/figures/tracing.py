"""A raster image, the outline traced in it, and pictures drawn from this outline (thesis 4.2)."""

from typing import TYPE_CHECKING

import numpy as np

from vexture.conversion.images import coverage
from vexture.conversion.pipeline import convert
from vexture.drawing.drawing import Drawing
from vexture_evidence.figures.outlines import draw_outline
from vexture_evidence.figures.style import COLOURS, INK, MUTED, panels, show
from vexture_evidence.measures.closeups import closeup, sharpest_corner

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

SIDE = 320
"""Side of the pictures from the texture, in pixels."""

PIXELS = 14
"""Width of the enlarged part, in pixels of the traced picture."""


def tracing(image: "NDArray[np.float32]", traced: Drawing, true: Drawing | None = None) -> "Figure":
    """Show pixels, the traced outline over an enlarged part of them, and pictures from its packed texture.

    Parameters
    ----------
    image : (n, n) array
        Coverage of the unit square, 0..1, top row first.
    traced : Drawing
        The drawing that was traced in the picture.
    true : Drawing, optional
        The drawing that the pixels were made from; its outline is drawn below the traced one.

    Examples
    --------
    >>> from vexture.tracing.trace import trace
    >>> image = np.zeros((32, 32), np.float32)
    >>> image[8:24, 8:24] = 1.0
    >>> figure = tracing(image, trace(1.0 - image))
    >>> [panel.get_title(loc="left") for panel in figure.axes]
    ['32 pixels', 'traced', 'from its texture', 'the same part']
    """
    side = len(image)
    place = sharpest_corner(true or traced)
    half = PIXELS / side / 2
    x, y = (min(max(float(middle), half), 1.0 - half) for middle in place)
    bounds = (x - half, y - half, x + half, y + half)
    titles = (f"{side} pixels", "traced", "from its texture", "the same part")
    figure, (axes,) = panels(1, 4, side=2.8, height=3.2, titles=titles)
    unit = (0.0, 1.0, 0.0, 1.0)
    show(axes[0], image, extent=unit)
    show(axes[1], 0.35 * image, extent=unit)
    if true is not None:
        draw_outline(axes[1], true, bounds, color=COLOURS["sampled"], linewidth=5.0, label="the true outline")
    draw_outline(axes[1], traced, bounds, color=INK, linewidth=1.2, label="the traced one")
    texture = convert(traced, split=None)
    show(axes[2], coverage(texture, (SIDE, SIDE), renderer="cpu"), extent=unit)
    part = closeup((SIDE, SIDE), np.array([x, y]), side / PIXELS)
    show(axes[3], coverage(texture, (SIDE, SIDE), part, "cpu"), extent=(bounds[0], bounds[2], bounds[1], bounds[3]))
    for panel in axes[:3:2]:
        panel.plot(*np.array(bounds)[[[0, 2, 2, 0, 0], [1, 1, 3, 3, 1]]], color=COLOURS["distance"], linewidth=1.2)
    for panel in axes:
        low, high = ((0.0, 0.0), (1.0, 1.0)) if panel in axes[:3:2] else (bounds[:2], bounds[2:])
        panel.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
        panel.set_xticks([low[0], high[0]], [f"{low[0]:.3g}", f"{high[0]:.3g}"])
        panel.set_yticks([low[1], high[1]], [f"{low[1]:.3g}", f"{high[1]:.3g}"])
        panel.tick_params(length=2, color=MUTED)
    figure.legend(*axes[1].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
