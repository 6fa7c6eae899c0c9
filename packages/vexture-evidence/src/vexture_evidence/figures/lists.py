"""The quad-tree as the lists that a texture holds: quads and curves by depth, and the coverage of each."""

from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.texture.texture import Texture
from vexture.thesis.texture import ThesisTexture
from vexture_evidence.figures.cells import draw_cells, draw_level_lines
from vexture_evidence.figures.style import COLOURS, GRID, INK, MUTED, SMALL, panels, unit_axes
from vexture_evidence.measures.leaves import LeafArrays, QuadArrays, Tree, leaves, quads, tree_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HALVES: Final = np.array([(0, 0), (1, 0), (0, 1), (1, 1)]) / 2.0
SQUARE: Final = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])

WIDER: Final = 1.75
"""Ratio of the width of the tree's axes to their height, and to the width of the subdivision's axes."""

LEVEL: Final = 1.9
"""Distance from one depth of a tree to the next, in sides of a quad."""

MARGIN: Final = 4.1
"""Width of the text beside a tree, in sides of a quad."""

REFERENCE: Final = "#c3cad4"
"""Colour of a cell that refers to a quad."""

CELL: Final = "#f4f6f9"

IN_ROW: Final = 8
"""Quads or curves in one row of a list."""

MOST_ROWS: Final = 4
"""Largest number of rows for one depth in a list; a number tells how many entries are not shown."""

MOST_ACROSS: Final = 28
"""Largest number of quads for one depth in a tree; a number tells how many quads are not shown."""


class Counts(NamedTuple):
    """The counts of section 3.4 of the thesis: quads, curves, cells of both lists, cells of the uniform grid."""

    quads: int
    curves: int
    cells: int
    grid: int


def counts(shape: Tree | ThesisTexture | Texture, root: str | int | None = None) -> Counts:
    """Count the cells of a tree's lists, four for each quad and one for each curve, and of the grid they replace.

    The uniform grid has the size of the smallest cells.

    Examples
    --------
    >>> import vexture
    >>> from vexture.drawing.drawing import Drawing
    >>> counts(vexture.convert(Drawing.polygon([(0, 0), (0.5, 0), (0, 0.5)]), encoding="thesis"))
    Counts(quads=1, curves=1, cells=5, grid=4)
    """
    tree = tree_of(shape, root)
    number, curves = len(tree.coverage), len(tree.curves)
    return Counts(number, curves, 4 * number + curves, 4 ** int(1 + quads(tree).depth.max()))


def hierarchy(shape: Tree | ThesisTexture | Texture, *, root: str | int | None = None) -> "Figure":
    """Show the subdivision, with the size of the grid that it replaces, and beside it the tree of its quads.

    Grey cells in the tree refer to the quad below them; light cells are leaves, with their curves.

    Parameters
    ----------
    shape : CellTree, Tree, ThesisTexture or Texture
    root : str or int, optional
        Name or place of the shape in a packed texture; not needed if there is only one.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.shape import example
    >>> figure = hierarchy(vexture.convert(example("duck"), encoding="thesis"))
    >>> figure.axes[0].get_title(loc="left")
    '49 cells for a grid of 32 x 32'
    """
    tree = tree_of(shape, root)
    above, found = quads(tree), leaves(tree)
    side = 2 ** int(found.depth.max())
    titles = (
        f"{len(found.x):,} cells for a grid of {side:,} x {side:,}",
        f"{len(above.x):,} quads and {len(found.curves):,} curves by depth",
    )
    figure, axes = panels(1, 2, side=5.6, height=4.2, titles=titles)
    axes[0, 0].get_gridspec().set_width_ratios([1.0, WIDER])
    draw_cells(axes[0, 0], found)
    if isinstance(shape, Texture):
        draw_level_lines(axes[0, 0], shape, root)
    unit_axes(axes[0, 0])
    _draw_tree(axes[0, 1], above, found)
    return figure


def lists(shape: Tree | ThesisTexture | Texture, *, root: str | int | None = None) -> "Figure":
    """Show the list of quads and the list of curves, by their depth in the tree, and the coverage of each entry.

    Parameters
    ----------
    shape : CellTree, Tree, ThesisTexture or Texture
    root : str or int, optional
        Name or place of the shape in a packed texture; not needed if there is only one.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.shape import example
    >>> figure = lists(vexture.convert(example("duck"), encoding="thesis"))
    >>> [axes.get_title(loc="left") for axes in figure.axes]
    ['quads', 'curves', 'coverage of quads', 'coverage of leaves with curves']
    """
    tree = tree_of(shape, root)
    above, found = quads(tree), leaves(tree)
    depths = range(int(above.depth.max()) + 1)
    quads_at = [np.flatnonzero(above.depth == depth) for depth in depths]
    curves_at = [np.flatnonzero(found.depth[found.owner] == depth + 1) for depth in depths]
    heights = [
        min(MOST_ROWS, max(1, -(-len(some) // IN_ROW), -(-len(others) // IN_ROW)))
        for some, others in zip(quads_at, curves_at, strict=True)
    ]
    tops = np.concatenate([[0.0], np.cumsum([1.25 * height + 0.35 for height in heights])])
    height = 0.5 + 0.23 * float(tops[-1])
    titles = ("quads", "curves", "coverage of quads", "coverage of leaves with curves")
    figure, axes = panels(1, 4, side=2.8, height=height, titles=titles)
    for panel in axes[0]:
        for top, rows, depth in zip(tops, heights, depths, strict=False):
            panel.axhline(top, color=GRID, linewidth=0.6)
            if panel is axes[0, 0]:
                middle = top + 0.1 + 0.625 * rows
                panel.text(-0.5, middle, f"depth {depth}", fontsize=SMALL, color=MUTED, ha="right", va="center")
        panel.set(xlim=(-0.3, 1.2 * IN_ROW + 1.6), ylim=(tops[-1], -0.1))
        panel.set_axis_off()
    for some, others, top, rows in zip(quads_at, curves_at, tops, heights, strict=False):
        room = IN_ROW * rows
        at = _places_in_list(room, top)
        for panel, members in zip(axes[0], (some, others, some, others), strict=True):
            if len(members) > room:
                panel.text(1.2 * IN_ROW, at[-1][1] + 1, f"+{len(members) - room:,}", fontsize=SMALL, color=MUTED)
        _draw_quads(axes[0, 0], above, found, some[:room], at, 1.0)
        _draw_curves(axes[0, 1], found, others[:room], at)
        _draw_values(axes[0, 2], above.coverage[some[:room]], at)
        _draw_values(axes[0, 3], found.coverage[found.owner[others[:room]]], at)
    return figure


def _places_in_list(room: int, top: float) -> NDArray[np.float64]:
    """Upper left corners of the squares for the entries of one depth, y down."""
    place = np.arange(room)
    return np.stack([1.2 * (place % IN_ROW), top + 0.25 + 1.25 * (place // IN_ROW)], axis=1)


def _squares(axes: "Axes", corners: NDArray[np.float64], side: float, **options: Any) -> None:
    """Draw squares from their upper left corners, y down."""
    from matplotlib.collections import PolyCollection

    squares = list(corners[:, None] + side * SQUARE)
    axes.add_collection(PolyCollection(squares, edgecolors=MUTED, linewidths=0.5, **options), autolim=False)


def _draw_quads(
    axes: "Axes", above: QuadArrays, found: LeafArrays, members: NDArray[np.int64], at: NDArray[np.float64], side: float
) -> None:
    """Draw quads as squares of four cells, y down: cells that refer to quads in grey, leaves with their curves."""
    at = at[: len(members)]
    cells = (at[:, None] + side * (HALVES * (1, -1) + (0, 0.5))).reshape(-1, 2)
    refers = (above.child[members] >= 0).ravel()
    _squares(axes, cells[~refers], side / 2, facecolors=CELL)
    _squares(axes, cells[refers], side / 2, facecolors=REFERENCE)
    place = np.full(len(above.x), -1)
    place[members] = np.arange(len(members))
    lines = found.lines(12)
    index = place[found.quad[found.owner]]
    lines, index = lines[index >= 0], index[index >= 0]
    quad = members[index]
    within = (lines - np.stack([above.x, above.y], axis=1)[quad][:, None]) / above.side[quad][:, None, None]
    points = at[index][:, None] + side * (within * (1, -1) + (0, 1))
    _plot(axes, points)


def _draw_curves(axes: "Axes", found: LeafArrays, members: NDArray[np.int64], at: NDArray[np.float64]) -> None:
    """Draw every curve in the square of its cell, y down."""
    at = at[: len(members)]
    _squares(axes, at, 1.0, facecolors=CELL)
    owner = found.owner[members]
    low = np.stack([found.x, found.y], axis=1)[owner]
    within = (found.lines(12, members) - low[:, None]) / found.side[owner][:, None, None]
    _plot(axes, at[:, None] + within * (1, -1) + (0, 1))


def _plot(axes: "Axes", lines: NDArray[np.float64]) -> None:
    points = np.pad(lines, ((0, 0), (0, 1), (0, 0)), constant_values=np.nan).reshape(-1, 2)
    axes.plot(*points.T, color=COLOURS["packed"], linewidth=1.0, scalex=False, scaley=False)


def _draw_values(axes: "Axes", values: NDArray[np.float64], at: NDArray[np.float64]) -> None:
    """Draw squares shaded by their values, with the values in percent as text."""
    shades = 1.0 - 0.5 * np.repeat(values[:, None], 3, axis=1)
    _squares(axes, at[: len(values)], 1.0, facecolors=shades)
    for value, (x, y) in zip(values, at, strict=False):
        axes.text(x + 0.5, y + 0.52, f"{100 * value:.0f}", fontsize=SMALL, color=INK, ha="center", va="center")


def _draw_tree(axes: "Axes", above: QuadArrays, found: LeafArrays) -> None:
    """Draw quads below the cells that refer to them, depth by depth."""
    depths = int(above.depth.max()) + 1
    most = min(MOST_ACROSS, int(np.bincount(above.depth).max()))
    width = max(1.35 * most, WIDER * LEVEL * depths - MARGIN)
    before: dict[int, tuple[float, float]] = {}
    members = np.zeros(1, np.int64)
    step = max(LEVEL, (width + MARGIN) / WIDER / depths)
    for depth in range(depths):
        if depth:  # in the order of the cells that refer to them, so that no two lines cross
            below = above.child[members].ravel()
            members = below[below >= 0]
        drawn = members[:MOST_ACROSS]
        x = (np.arange(len(drawn)) + 0.5) * width / len(drawn) - 0.5
        at = np.stack([x, np.full(len(drawn), step * depth)], axis=1)
        axes.text(-0.9, step * depth + 0.5, f"depth {depth}", fontsize=SMALL, color=MUTED, ha="right", va="center")
        for quad, (left, top) in zip(drawn, at, strict=True):
            for cell, child in enumerate(above.child[quad]):
                before[int(child)] = left + 0.25 + 0.5 * (cell & 1), top + (0.25 if cell >> 1 else 0.75)
            if quad in before:
                start = before[int(quad)]
                axes.plot([start[0], left + 0.5], [start[1], top], color=MUTED, linewidth=0.6, zorder=0.5)
        if len(members) > len(drawn):
            more = f"+{len(members) - len(drawn):,}"
            axes.text(width + 0.2, step * depth + 0.5, more, fontsize=SMALL, color=MUTED, va="center")
        _draw_quads(axes, above, found, drawn, at, 1.0)
    axes.set(xlim=(-2.6, width + 1.5), ylim=(step * (depths - 1) + 1.1, -0.1), aspect="equal")
    axes.set_axis_off()
