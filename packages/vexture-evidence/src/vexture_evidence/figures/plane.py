"""A fine pattern on a receding plane, drawn from raster textures and from ours (thesis 2.7)."""

from typing import TYPE_CHECKING, Final

import numpy as np

from vexture_evidence.figures.style import error_map, panels, show
from vexture_evidence.measures.metrics import LEVELS
from vexture_evidence.measures.plane import Receding

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ENLARGED: Final = 4
"""How many times the far part is enlarged."""

SHOWN: Final = 64.0
"""Error, in 1/255, that has the darkest colour."""


def plane(receding: Receding) -> "Figure":
    """Show the plane by each method and its exact coverage: whole, with the far part enlarged, and the pixels' errors.

    Parameters
    ----------
    receding : Receding
        What `vexture_evidence.measures.plane.receding` returns.

    Examples
    --------
    >>> from vexture_evidence.measures.plane import receding
    >>> figure = plane(receding((40, 20), 4))
    >>> [panel.get_title(loc="left") for panel in figure.axes[:3]]
    ['raster', 'its far part, 4 times enlarged', 'error']
    """
    rendered = receding.rendered
    images = {**rendered.images, "truth": rendered.truth}
    height, width = rendered.truth.shape
    left, far = (width - width // ENLARGED) // 2, height // ENLARGED
    figure, axes = panels(
        len(images), 3, side=3.75, height=1.72, titles=[text for name in images for text in (name, _FAR, "error")]
    )
    errors = rendered.errors
    for (whole, part, off), (name, image) in zip(axes, images.items(), strict=True):
        show(whole, image, pixels=name == "truth")
        show(part, image[:far, left : left + width // ENLARGED], pixels=name == "truth")
        if name == "truth":
            off.set_axis_off()
            off.set_title("", loc="left")
            continue
        scale = show(
            off, LEVELS * np.abs(np.float64(image) - rendered.truth), pixels=False, cmap=error_map(), vmax=SHOWN
        )
        whole.set_title(f"{receding.nbytes[name]:,} bytes", loc="right", fontsize=8.0, fontweight="normal")
        off.set_title(f"mean {errors[name].mae:.2f}", loc="right", fontsize=8.0, fontweight="normal")
    bar = axes[-1, -1].inset_axes((0.0, 0.6, 1.0, 0.1))
    figure.colorbar(scale, cax=bar, orientation="horizontal", extend="max", label="error of a pixel, in 1/255")
    return figure


_FAR: Final = f"its far part, {ENLARGED} times enlarged"
