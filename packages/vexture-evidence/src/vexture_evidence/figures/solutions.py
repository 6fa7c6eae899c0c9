"""The nine solution paths: one cubic for each, solved and drawn on the CPU and on the GPU (thesis 3.5, 4.9, 4.10)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from vexture.bezier.points import points_along
from vexture_evidence.figures.style import COLOURS, INK, MUTED, panels, show
from vexture_evidence.measures.solutions import BOX, SOLUTIONS, SolutionPath, by_cpu, by_gpu, solve

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ACROSS = 3
"""Curves in a row."""


def solutions(cases: Sequence[SolutionPath] = SOLUTIONS, *, side: int = 96, gpu: bool = True) -> "Figure":
    r"""Show cubics with their roots at one x, in front of the picture from the CPU, beside the picture from the GPU.

    Parameters
    ----------
    cases : sequence of SolutionPath
    side : int
        Side of the pictures in pixels.
    gpu : bool
        Whether to show the pictures from the GPU.

    Raises
    ------
    DeviceError
        If `gpu` is true and there is no GPU.

    Examples
    --------
    >>> figure = solutions(SOLUTIONS[:3], side=8, gpu=False)
    >>> figure.axes[0].get_xlabel()
    'x = 0.350\nt = 0.350, heights 0.280'
    """
    each = 2 if gpu else 1
    rows = -(-len(cases) // ACROSS)
    titles = [title for number, case in enumerate(cases, 1) for title in (f"{number} {case.name}", "GPU")[:each]]
    figure, axes = panels(rows, ACROSS * each, side=11.3 / (ACROSS * each), height=2.5 if gpu else 4.4, titles=titles)
    for number, case in enumerate(cases):
        row, column = divmod(number, ACROSS)
        first = axes[row, column * each]
        x, y, width, height = BOX
        extent = (x, x + width, y, y + height)
        show(first, 0.25 * by_cpu(case, side), extent=extent)
        _curve(first, case)
        found = solve(case)
        t, heights = (", ".join(f"{value:.3f}" for value in values) for values in (found.t, found.heights))
        first.set_xlabel(f"x = {case.x:.3f}\nt = {t}{'' if gpu else f', heights {heights}'}", fontsize=8.0, loc="left")
        if gpu:
            second = axes[row, column * each + 1]
            show(second, 0.25 * by_gpu(case, side), extent=extent)
            second.set_xticks([0.0, 1.0])
            second.set_yticks([])
            second.tick_params(length=2)
            second.set_xlabel(f"heights of the dots\n{heights}", fontsize=8.0, loc="left")
    for panel in axes.flat[each * len(cases) :]:
        panel.set_axis_off()
    return figure


def _curve(axes: "Axes", case: SolutionPath) -> None:
    """Draw the curve, its chord, the vertical line that it is solved for, and the roots."""
    (line,) = points_along(np.array([[(0.0, 0.0), case.p1, case.p2, (1.0, 0.0)]]), np.linspace(0.0, 1.0, 200))
    axes.plot([0.0, 1.0], [0.0, 0.0], color=MUTED, linewidth=0.8)
    axes.axvline(case.x, color=COLOURS["distance"], linewidth=0.8, linestyle="--")
    axes.plot(line[:, 0], line[:, 1], color=INK, linewidth=1.4)
    found = solve(case)
    axes.plot([case.x] * len(found.t), found.heights, "o", color=COLOURS["distance"], markersize=4.5)
    x, y, width, height = BOX
    axes.set(xlim=(x, x + width), ylim=(y, y + height), aspect="equal")
    axes.set_xticks([0.0, 1.0])
    axes.set_yticks([0.0])
    axes.tick_params(length=2)
