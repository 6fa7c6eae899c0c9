"""One shape in few pixels, by the thesis's methods and by ours (thesis 3.13), and an exaggerated cut-off (4.15)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

import numpy as np

from vexture_evidence.figures.style import COLOURS, panels, show
from vexture_evidence.measures.renderings import MIP, Rendered
from vexture_evidence.measures.thesis_ways import AsThesis

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

STORED: Final = "#8b94a3"
FROM_LEAF: Final = COLOURS["bands"]
"""Colours of pixels by the origin of their value: a stored MIP value, or a leaf."""

INSIDE: Final = COLOURS["packed"]
OUTSIDE: Final = COLOURS["sampled"]
"""Colours of pixels drawn from a leaf; the thesis uses green and red, which colour-blind readers confuse."""


def resolutions(rendered: Sequence[Rendered]) -> "Figure":
    """Show a shape at several sizes: a column for each size, a row for each method, the exact coverage in the last row.

    Parameters
    ----------
    rendered : sequence of Rendered
        What `vexture_evidence.measures.renderings.at_sizes` returns.

    Examples
    --------
    >>> from vexture_evidence.measures.renderings import at_sizes
    >>> from vexture_evidence.measures.shape import ConvertedDrawing, example
    >>> figure = resolutions(at_sizes(ConvertedDrawing(example("duck")), (1, 2)))
    >>> len(figure.axes)  # six rows of two
    12
    """
    rows = _rows(rendered[0])
    titles = [f"{len(view.truth)} × {len(view.truth)} px" for view in rendered]
    figure, axes = panels(len(rows), len(rendered), side=1.62, height=1.6, titles=titles)
    for column, view in enumerate(rendered):
        for panel, (name, label) in zip(axes[:, column], rows.items(), strict=True):
            if name == "origin":
                show(panel, _origin(view), pixels=False)
            else:
                show(panel, view.truth if name == "truth" else view.images[name], pixels=False)
                panel.set_xlabel(
                    f"error {view.errors[name].mae:.3g}" if name != "truth" else "", fontsize=8.0, labelpad=1.0
                )
            if column == 0:
                panel.set_ylabel(label, fontsize=9.0)
    return figure


def _rows(view: Rendered) -> dict[str, str]:
    """Keys and labels of the rows; the row of the values' origin is below the row of its method."""
    labels: dict[str, str] = {}
    for name in view.images:
        labels[name] = name.replace(", ", ",\n").replace(" of the ", "\nof the ")
        if name == MIP and view.from_mip is not None:
            labels["origin"] = "origin: grey\nMIP, blue leaf"
    return labels | {"truth": "truth"}


def _origin(view: Rendered) -> "NDArray[np.float64]":
    from matplotlib.colors import to_rgb

    assert view.from_mip is not None
    return np.where(view.from_mip[..., None], to_rgb(STORED), to_rgb(FROM_LEAF))


def exaggerated_cut_off(pictures: Sequence[AsThesis]) -> "Figure":
    """Show where MIP values would be drawn if quads of many pixels counted as small (thesis 4.15).

    Parameters
    ----------
    pictures : sequence of AsThesis
        What `vexture_evidence.measures.renderings.cut_off_at` returns.

    Examples
    --------
    >>> from vexture_evidence.measures.renderings import cut_off_at
    >>> from vexture_evidence.measures.shape import ConvertedDrawing, example
    >>> len(exaggerated_cut_off(cut_off_at(ConvertedDrawing(example("duck")), (8, 16))).axes)
    2
    """
    from matplotlib.colors import to_rgb

    titles = [f"{len(picture.image)} × {len(picture.image)} px" for picture in pictures]
    figure, axes = panels(1, len(pictures), side=11.2 / len(pictures), height=11.2 / len(pictures) + 0.5, titles=titles)
    for panel, picture in zip(axes[0], pictures, strict=True):
        stored = np.repeat(picture.image[..., None], 3, axis=2)  # lighter means fuller, as in the thesis
        leaf = np.where(picture.image[..., None] > 0.5, to_rgb(INSIDE), to_rgb(OUTSIDE))
        show(panel, np.where(picture.from_mip[..., None], 0.15 + 0.8 * stored, leaf), pixels=False)
        panel.set_xlabel(f"{100.0 * picture.from_mip.mean():.0f}% by MIP values", fontsize=9.0)
    return figure
