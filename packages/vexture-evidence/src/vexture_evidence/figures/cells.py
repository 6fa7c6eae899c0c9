"""The subdivision of a drawing: cells shaded by their coverage or depth, and the curves in them."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from vexture.texture.outlines import outlines
from vexture.texture.texture import Texture
from vexture.thesis.texture import ThesisTexture
from vexture_evidence.figures.style import GRID, INK, MUTED, SMALL, panels, unit_axes
from vexture_evidence.measures.leaves import LeafArrays, Tree, leaves

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

UNIT: Final = (0.0, 0.0, 1.0, 1.0)
"""The unit square: x0, y0, x1, y1."""

FINEST: Final = 256
"""Cells smaller than the visible part divided by this number are shown by their mean, in a picture of that side."""

BORDERED: Final = 128
"""Cells have no border if they are smaller than the visible part divided by this number."""

MANY: Final = 2000
"""This many curves or more are drawn with thinner lines."""

PAPER: Final = "#ffffff"
SHADE: Final = "#8fa9c4"
"""Colour of a full cell, light enough for curves to show on it."""

DEPTHS: Final = ("#fff7e0", "#fdd67e", "#ef8f3f", "#c2451e", "#6e0f1a")
"""Colours from the smallest depth to the largest; darker is deeper."""


def draw_cells(
    axes: "Axes",
    found: LeafArrays,
    *,
    shades: Literal["coverage", "depth"] = "coverage",
    curves: bool = True,
    colour: str = INK,
    bounds: Sequence[float] = UNIT,
    deepest: int | None = None,
) -> Any:
    """Draw leaves into axes of the unit square, or of a part of it.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    found : LeafArrays
        Returned by `vexture_evidence.measures.leaves.leaves`.
    shades : str
        ``"coverage"`` shades every cell by how much of it is filled, ``"depth"`` by its depth in the tree.
    curves : bool
        Whether to draw the curves.
    colour : str
        Colour of the curves.
    bounds : sequence of float
        The visible part: x0, y0, x1, y1. Cells smaller than 1/128 of it have no border.
    deepest : int, optional
        Depth that has the darkest shade, so that several trees share one scale; by default the leaves' largest depth.

    Returns
    -------
    matplotlib.collections.PolyCollection
        The cells, from which `add_scale` makes a colour bar.
    """
    from matplotlib.collections import PolyCollection

    x0, y0, x1, y1 = bounds
    seen = (found.x < x1) & (found.x + found.side > x0) & (found.y < y1) & (found.y + found.side > y0)
    relative = found.side / max(x1 - x0, y1 - y0)
    large = seen & (relative * FINEST >= 1.0)
    values = found.coverage if shades == "coverage" else found.depth.astype(np.float64)
    scale = _scale(shades, deepest or int(found.depth.max()))
    small = seen & ~large
    if small.any():
        axes.imshow(_means(found, values, small, bounds), extent=(x0, x1, y0, y1), interpolation="nearest", **scale)
    x, y, side = found.x[large], found.y[large], found.side[large]
    squares = np.stack([x, y, x + side, y, x + side, y + side, x, y + side], axis=1).reshape(-1, 4, 2)
    width = np.where(relative[large] * BORDERED >= 1.0, 0.5, 0.0)
    cells = PolyCollection(list(squares), array=values[large], edgecolors=GRID, linewidths=width, **scale)
    axes.add_collection(cells, autolim=False)
    if curves:
        points = curve_lines(found, bounds)
        axes.plot(
            *points.T,
            color=colour,
            linewidth=1.1 if len(found.curves) < MANY else 0.6,
            solid_joinstyle="round",
            scalex=False,
            scaley=False,
        )
    unit_axes(axes, bounds=bounds)
    return cells


def draw_level_lines(axes: "Axes", texture: Texture, root: str | int | None = None, *, colour: str = INK) -> None:
    """Draw the horizontal lines of a packed shape dotted: its leaves omit most, as they follow from other curves."""
    contours = outlines(texture.flat, texture.root(root).quad)
    arcs = np.concatenate([np.empty((0, 4, 2)), *contours])
    ends = arcs[arcs[:, 0, 1] == arcs[:, 3, 1]][:, [0, 3]]
    points = np.pad(ends, ((0, 0), (0, 1), (0, 0)), constant_values=np.nan).reshape(-1, 2)
    axes.plot(*points.T, color=colour, linewidth=0.9, linestyle=(0, (1, 1.5)), scalex=False, scaley=False)


def curve_lines(found: LeafArrays, bounds: Sequence[float] = UNIT) -> NDArray[np.float64]:
    """Points along the curves of the visible leaves, with NaN after each curve, (n, 2).

    Curves in small leaves have fewer points, because a picture does not show more.
    """
    x0, y0, x1, y1 = bounds
    ends = found.owner
    low, side = np.stack([found.x, found.y], axis=1)[ends], found.side[ends]
    seen = (low < (x1, y1)).all(axis=1) & (low + side[:, None] > (x0, y0)).all(axis=1)
    relative = side / max(x1 - x0, y1 - y0)
    parts = [np.empty((0, 2))]
    for chords, least, most in ((32, 1 / 64, np.inf), (8, 1 / 512, 1 / 64), (2, 0.0, 1 / 512)):
        points = found.lines(chords, seen & (relative >= least) & (relative < most))
        parts.append(np.pad(points, ((0, 0), (0, 1), (0, 0)), constant_values=np.nan).reshape(-1, 2))
    return np.concatenate(parts)


def subdivision(
    shape: Tree | ThesisTexture | Texture,
    *,
    root: str | int | None = None,
    shades: Literal["coverage", "depth"] = "coverage",
    bounds: Sequence[float] = UNIT,
) -> "Figure":
    """Show the cells that a shape was divided into, with the curves in each.

    For a packed texture, the horizontal lines of the shape are dotted, because its leaves hold few of them.

    Parameters
    ----------
    shape : CellTree, Tree, ThesisTexture or Texture
    root : str or int, optional
        Name or place of the shape in a packed texture; not needed if there is only one.
    shades : str
        ``"coverage"`` shades every cell by how much of it is filled, ``"depth"`` by its depth in the tree.
    bounds : sequence of float
        The visible part of the unit square: x0, y0, x1, y1.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.shape import example
    >>> figure = subdivision(vexture.convert(example("duck")))
    >>> tuple(map(float, figure.axes[0].get_xlim()))
    (0.0, 1.0)
    """
    found = leaves(shape, root)
    figure, axes = panels(1, 1, side=4.4, height=3.8, titles=(f"{len(found.x):,} cells, {len(found.curves):,} curves",))
    cells = draw_cells(axes[0, 0], found, shades=shades, bounds=bounds)
    if isinstance(shape, Texture):
        draw_level_lines(axes[0, 0], shape, root)
    add_scale(figure, axes[0, 0], cells, shades)
    return figure


def subdivisions(
    shapes: Mapping[str, Tree | ThesisTexture | Texture],
    *,
    shades: Literal["coverage", "depth"] = "coverage",
) -> "Figure":
    """Show the cells of several trees side by side, shaded by one scale.

    Parameters
    ----------
    shapes : mapping
        From titles to trees or textures. A packed texture must hold exactly one shape.
    shades : str
        As in `subdivision`.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.shape import example
    >>> pair = vexture.convert(example("duck"), encoding="thesis")
    >>> subdivisions({"direct": pair}, shades="depth").axes[0].get_title(loc="left")
    'direct: 49 cells'
    """
    found = {title: leaves(shape) for title, shape in shapes.items()}
    titles = [f"{title}: {len(each.x):,} cells" for title, each in found.items()]
    figure, axes = panels(1, len(found), side=11.2 / max(3, len(found)), height=3.5, titles=titles)
    deepest = max(int(each.depth.max()) for each in found.values())
    for panel, each, shape in zip(axes[0], found.values(), shapes.values(), strict=True):
        cells = draw_cells(panel, each, shades=shades, deepest=deepest)
        if isinstance(shape, Texture):
            draw_level_lines(panel, shape)
        unit_axes(panel, ticks=panel is axes[0, 0])
    add_scale(figure, list(axes[0]), cells, shades)
    return figure


def add_scale(figure: "Figure", axes: Any, cells: Any, shades: Literal["coverage", "depth"]) -> None:
    """Add a colour bar beside axes that explains the shades of the cells."""
    if shades == "coverage":
        bar = figure.colorbar(cells, ax=axes, shrink=0.7, ticks=[0.0, 0.5, 1.0])
        label = "filled part of the cell"
    else:
        least, most = (round(end) for end in cells.get_clim())
        bar = figure.colorbar(cells, ax=axes, shrink=0.7, ticks=range(least + 1, most + 1, 1 + most // 12))
        label = "depth of the cell"
    bar.set_label(label, fontsize=SMALL, color=INK)
    bar.outline.set_visible(False)
    bar.ax.tick_params(length=2, labelsize=SMALL, labelcolor=MUTED)


def _scale(shades: str, most: int) -> dict[str, Any]:
    """Colour map and range of the cells' shades."""
    from matplotlib.colors import LinearSegmentedColormap, Normalize

    if shades == "coverage":
        return {"cmap": LinearSegmentedColormap.from_list("cells", [PAPER, SHADE]), "norm": Normalize(0.0, 1.0)}
    steps = LinearSegmentedColormap.from_list("depths", list(DEPTHS), N=most)
    return {"cmap": steps, "norm": Normalize(0.5, most + 0.5)}


def _means(
    found: LeafArrays, values: NDArray[np.float64], small: NDArray[np.bool_], bounds: Sequence[float]
) -> NDArray[np.float64]:
    """Mean of the small leaves' values, weighted by area, in each pixel of the visible part; NaN if there are none."""
    x0, y0, x1, y1 = bounds
    half = found.side[small] / 2
    column = np.floor((found.x[small] + half - x0) / (x1 - x0) * FINEST).astype(np.int64)
    row = np.floor((y1 - found.y[small] - half) / (y1 - y0) * FINEST).astype(np.int64)
    pixel = np.clip(row, 0, FINEST - 1) * FINEST + np.clip(column, 0, FINEST - 1)
    area = np.bincount(pixel, half**2, FINEST**2)
    total = np.bincount(pixel, values[small] * half**2, FINEST**2)
    mean: NDArray[np.float64] = np.divide(total, area, out=np.full(FINEST**2, np.nan), where=area > 0.0)
    return mean.reshape(FINEST, FINEST)
