"""Our textures beside rivals: errors over bytes, and pictures at equal bytes."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from vexture.conversion.images import coverage
from vexture.renderers.view import fit
from vexture_evidence.figures.style import COLOURS, GRID, INK, panels, show
from vexture_evidence.measures.closeups import closeup, sharpest_corner
from vexture_evidence.measures.metrics import errors
from vexture_evidence.measures.rivals import MAGNIFICATION, NARROW, SMALL, WHOLE, MeasuredRival, Rival

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from vexture.drawing.drawing import Drawing

FLOOR: Final = 1e-3
"""Smallest error shown, in 1/255; smaller errors are drawn here, because a logarithmic scale has no 0."""

SHOWN: Final = 144
"""Pixels along a side of the pictures in the strip."""

CORNER: Final = 16
"""How many times the corner is enlarged."""

MARKERS: Final = {"packed": "D", "direct": "s", "sampled": "^", "bands": "v"}

SCENES: Final = {
    "whole": f"whole drawing, {WHOLE} px",
    "outline": f"outline, {MAGNIFICATION}× closer",
    "small": f"whole drawing, {SMALL} px",
}
"""Titles of the fields of `MeasuredRival`."""

FRAME: Final = COLOURS["sampled"]


def error_over_bytes(measured: Sequence[MeasuredRival]) -> "Figure":
    """Show mean errors over bytes, both logarithmic: bytes of files above, bytes on the GPU below.

    Parameters
    ----------
    measured : sequence of MeasuredRival
        Several measurements with the same label make a line; a single one makes a mark.

    Examples
    --------
    >>> from vexture import Drawing
    >>> from vexture_evidence.measures.rivals import measure_rival, raster_rival, scene_of
    >>> drawing = Drawing.polygon([(0.1, 0.2), (0.9, 0.3), (0.5, 0.8)])
    >>> found = [measure_rival(raster_rival(drawing, side), scene_of(drawing)) for side in (16, 64)]
    >>> error_over_bytes(found).axes[0].get_title(loc="left")
    'whole drawing, 256 px'
    """
    figure, axes = panels(2, 3, side=3.7, height=2.75, titles=(*SCENES.values(),) * 2)
    for row, what in enumerate(("file_bytes", "gpu_bytes")):
        for column, scene in enumerate(SCENES):
            _curves(axes[row, column], measured, what, scene)
        axes[row, 0].set_ylabel("mean error (1/255)")
        for panel in axes[row]:
            panel.set_xlabel("bytes of the file" if row == 0 else "bytes on the GPU")
    handles, labels = axes[1, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels), frameon=False)
    return figure


def _curves(axes: "Axes", measured: Sequence[MeasuredRival], quantity: str, scene: str) -> None:
    labels = dict.fromkeys(one.rival.label for one in measured)
    for label in labels:
        ones = [one for one in measured if one.rival.label == label and getattr(one.rival, quantity)]
        if not ones:
            continue
        method = ones[0].rival.method
        bytes_ = [getattr(one.rival, quantity) for one in ones]
        wrong = [max(FLOOR, getattr(one, scene).mae) for one in ones]
        drawn = axes.plot(bytes_, wrong, color=COLOURS[method], label=label)[0]
        if len(ones) > 1:
            narrow = ones[0].rival.label == f"distance, spread {NARROW:g}"
            drawn.set(marker="o", markersize=3.5, linestyle="--" if narrow else "-", linewidth=1.4)
        else:
            drawn.set(marker=MARKERS.get(method, "o"), markersize=7.5, linestyle="none", zorder=3)
    axes.set(xscale="log", yscale="log", ylim=(0.4 * FLOOR, 120.0))
    axes.minorticks_off()  # drawing them takes a third of the figure's time
    axes.grid(color=GRID, linewidth=0.4)


def equal_bytes(drawing: "Drawing", rivals: Sequence[Rival], *, magnification: float = CORNER) -> "Figure":
    """Show each rival's picture of the whole drawing and of its sharpest corner, beside the exact coverage.

    Parameters
    ----------
    drawing : Drawing
    rivals : sequence of Rival
        From left to right; the exact coverage comes last.
    magnification : float
        How many times the corner is enlarged, which is framed in the picture of the whole drawing.

    Examples
    --------
    >>> from vexture import Drawing
    >>> from vexture_evidence.measures.rivals import raster_rival
    >>> drawing = Drawing.polygon([(0.1, 0.2), (0.9, 0.3), (0.5, 0.8)])
    >>> [axes.get_xlabel() for axes in equal_bytes(drawing, [raster_rival(drawing, 16)]).axes][:2]
    ['mean error 32.6', '']
    """
    size = (SHOWN, SHOWN)
    place = sharpest_corner(drawing)
    views = (fit(size), closeup(size, place, magnification))
    truths = [coverage(drawing, size, view, "exact") for view in views]
    figure, axes = panels(2, len(rivals) + 1, side=11.2 / (len(rivals) + 1), height=2.5)
    for column, rival in enumerate(rivals):
        axes[0, column].set_title(_title(rival), loc="left", fontsize=9.0)
        for row, (view, truth) in enumerate(zip(views, truths, strict=True)):
            image = rival.draw(size, view)
            show(axes[row, column], image)
            axes[row, column].set_xlabel(f"mean error {errors(image, truth).mae:.3g}")
    axes[0, -1].set_title("truth\nexact coverage", loc="left", fontsize=9.0)
    for row, truth in enumerate(truths):
        show(axes[row, -1], truth)
    for panel in axes[0]:
        _frame(panel, place, SHOWN / magnification)
    axes[0, 0].set_ylabel("whole drawing", color=INK)
    axes[1, 0].set_ylabel(f"corner, {magnification:g}× closer", color=INK)
    return figure


def _title(rival: Rival) -> str:
    texels = [] if rival.side is None else [f"{rival.side}² texels"]
    file = [] if rival.file_bytes is None else [f"file {rival.file_bytes:,} B"]
    return "\n".join([rival.label, *texels, *file, f"GPU {rival.gpu_bytes:,} B"])


def _frame(axes: "Axes", place: "NDArray[np.float64]", side: float) -> None:
    """Frame the enlarged part in a picture of the whole drawing."""
    from matplotlib.patches import Rectangle

    x, y = place[0] * SHOWN - 0.5 - side / 2, (1.0 - place[1]) * SHOWN - 0.5 - side / 2
    axes.add_patch(Rectangle((x, y), side, side, fill=False, edgecolor=FRAME, linewidth=1.4, clip_on=False))
