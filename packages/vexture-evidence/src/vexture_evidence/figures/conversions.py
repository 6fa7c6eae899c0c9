"""Conversions of many drawings side by side."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final

from vexture_evidence.figures.style import COLOURS, GRID, INK, panels

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MARKERS: Final = {"printed": "x", "sampled": "^", "direct": "s", "packed": "o"}
"""One marker for each method, so that methods can be distinguished without colours."""

NAME: Final = 20
"""Largest number of characters of a drawing's name; longer names would leave no room for the panels."""


def conversions(names: Sequence[str], quantities: Mapping[str, Mapping[str, Sequence[float | None]]]) -> "Figure":
    """Show quantities of drawings by method: a row for each drawing, a panel for each quantity, logarithmic.

    Parameters
    ----------
    names : sequence of str
        Names of the drawings.
    quantities : mapping
        From the title of each panel to a mapping from methods to one value for each drawing, or None if there is no
        value. The method ``"printed"`` stands for the thesis's own values.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> figure = conversions(["duck", "cake"], {"bytes": {"printed": [1462, 2496], "packed": [1092, None]}})
    >>> figure.axes[0].get_xscale()
    'log'
    """
    figure, axes = panels(
        1, len(quantities), side=11.2 / len(quantities), height=0.9 + 0.24 * len(names), titles=list(quantities)
    )
    rows = range(len(names))
    for panel, methods in zip(axes[0], quantities.values(), strict=True):
        some: list[float] = []
        for method, values in methods.items():
            points = [(value, row) for row, value in zip(rows, values, strict=True) if value]
            some += [value for value, _ in points]
            colour = COLOURS.get(method, INK)
            x, y = zip(*points, strict=True) if points else ((), ())
            panel.plot(x, y, linestyle="", marker=MARKERS.get(method, "d"), color=colour, markersize=6, label=method)
        panel.set_xscale("log")
        low, high = (min(some), max(some)) if some else (1.0, 1.0)
        panel.set_xlim(10.0 ** math.floor(math.log10(low) - 0.05), 10.0 ** math.ceil(math.log10(high) + 0.05))
        panel.set_ylim(max(1, len(names)) - 0.5, -0.5)
        panel.set_yticks(rows, [shorten_name(name) for name in names] if panel is axes[0, 0] else [""] * len(names))
        panel.minorticks_off()
        panel.grid(color=GRID, linewidth=0.4)
        panel.set_axisbelow(True)
        panel.tick_params(length=0)
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=len(labels), fontsize=9.0, frameon=False)
    return figure


def shorten_name(name: str) -> str:
    """A drawing's name as shown beside its row.

    Examples
    --------
    >>> shorten_name("duck"), shorten_name("a drawing with a long name")
    ('duck', 'a drawing with a lo…')
    """
    return name if len(name) <= NAME else f"{name[: NAME - 1]}…"
