"""The limits that chapter 6 of the thesis names, before and after, one figure for each point."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.points import points_along
from vexture.drawing.drawing import Drawing
from vexture.texture.texture import Texture
from vexture.thesis.layout import LIST_LIMIT
from vexture.thesis.texture import ThesisTexture
from vexture_evidence.figures.cells import UNIT, curve_lines, draw_cells
from vexture_evidence.figures.outlines import draw_outline
from vexture_evidence.figures.style import COLOURS, GRID, INK, MUTED, error_map, panels, show, unit_axes
from vexture_evidence.figures.textures import draw_texture
from vexture_evidence.measures.closeups import all_cubics
from vexture_evidence.measures.editing import EditedTexture
from vexture_evidence.measures.leaves import LeafArrays, Tree, leaves, quads
from vexture_evidence.measures.metrics import LEVELS
from vexture_evidence.measures.outline import first_samples, off_outline
from vexture_evidence.measures.stored_coverage import StoredValues
from vexture_evidence.measures.thesis_limits import MOST_TEXELS, BeforeAfter, Lengths, unnecessary_quads

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIDE: Final = 2.75
"""Side of a panel in inches; four panels fill the page's column."""

MARK: Final = "#d55e00"
"""Colour of what a figure marks."""

SMALLEST: Final = 1e-9
"""Smallest distance shown, in unit-square units; smaller distances are drawn here."""


def before_after(rows: Sequence[BeforeAfter], labels: Sequence[tuple[str, str]]) -> "Figure":
    """Show rows of four panels: cells and picture before, cells and picture after.

    Parameters
    ----------
    rows : sequence of BeforeAfter
        Returned by `vexture_evidence.measures.thesis_limits.close_up`.
    labels : sequence of two str
        Names of the two ways in each row, before and after.

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.thesis_limits import close_up
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.3), (0, 0.6)])
    >>> close = close_up(half, vexture.convert(half, encoding="thesis"), vexture.convert(half), side=16)
    >>> figure = before_after([close], [("direct", "packed")])
    >>> [axes.get_title(loc="left") for axes in figure.axes][0]
    'direct: 3 curves'
    """
    found = [(leaves(close.before), leaves(close.after)) for close in rows]
    titles = []
    for close, pair, names in zip(rows, found, labels, strict=True):
        for name, one, error in zip(names, pair, close.errors, strict=True):
            titles += [f"{name}: {_visible_curves(one, close.bounds):,} curves", f"error {_short(error.mae)}/255"]
    figure, axes = panels(len(rows), 4, side=SIDE, titles=titles)
    for row, close, pair in zip(axes, rows, found, strict=True):
        for place, (one, image) in enumerate(zip(pair, close.images, strict=True)):
            _cells(row[2 * place], one, close.drawing, close.bounds)
            show(row[2 * place + 1], image)
    return figure


def lines_at_borders(close: BeforeAfter, labels: tuple[str, str]) -> "Figure":
    """Show the cells of a texture, and the errors of two pictures with the borders of these cells drawn over them.

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.thesis_limits import close_up
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.3), (0, 0.6)])
    >>> close = close_up(half, vexture.convert(half, encoding="thesis"), vexture.convert(half), side=16)
    >>> len(lines_at_borders(close, ("direct", "packed")).axes)  # the last is the scale of the errors
    4
    """
    figure, axes = panels(1, 3, side=3.6, height=3.3, titles=("cells of the thesis's texture", *labels))
    found = leaves(close.before)
    draw_cells(axes[0, 0], found, bounds=close.bounds)
    off = [LEVELS * np.abs(image.astype(np.float64) - close.truth) for image in close.images]
    top = max(float(np.quantile(off[0], 0.999)), 1.0)
    x0, y0, x1, y1 = close.bounds
    for panel, error in zip(axes[0, 1:], off, strict=True):
        _borders(panel, found)
        shown = show(panel, error, cmap=error_map(), vmin=0.0, vmax=top, extent=(x0, x1, y0, y1), zorder=0)
        unit_axes(panel, bounds=close.bounds)
    _add_scale(figure, axes[0, 1:], shown, "error, in 1/255")
    return figure


def density(drawing: Drawing, textures: Mapping[str, ThesisTexture | Texture]) -> "Figure":
    """Show how far the outlines in textures are from the drawing's own outline.

    Parameters
    ----------
    drawing : Drawing
        Not empty.
    textures : mapping
        From names of ways to textures. The first and the last are shown enlarged where the first is farthest off.

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.shape import example
    >>> shield = vexture.read_svg(example("simple-small"))
    >>> made = {"sampled": vexture.convert(shield, encoding="thesis", strategy="sampled")}
    >>> figure = density(shield, made | {"packed": vexture.convert(shield)})
    >>> figure.axes[2].get_yscale()
    'log'
    """
    points = {name: leaves(texture).lines().reshape(-1, 2) for name, texture in textures.items()}
    off = {name: off_outline(found, drawing) for name, found in points.items()}
    first, *_, last = textures
    worst = points[first][off[first].argmax()]
    half = 8.0 * max(float(off[first].max()), SMALLEST)
    times = f"{0.5 / half:,.0f} times"
    titles = (f"{first}, enlarged {times}", f"{last}, enlarged {times}", "distance from the drawing")
    figure, axes = panels(1, 3, side=3.6, height=3.4, titles=titles)
    bounds = (worst[0] - half, worst[1] - half, worst[0] + half, worst[1] + half)
    for panel, name in zip(axes[0], (first, last), strict=False):
        draw_outline(panel, drawing, bounds, color=GRID, linewidth=5.0, label="the drawing", zorder=1)
        lines = curve_lines(leaves(textures[name]), bounds)
        panel.plot(*lines.T, color=COLOURS[name], linewidth=1.6, label=name)
        if name == first:
            panel.plot(*first_samples(drawing).T, ".", color=INK, markersize=5, label="first samples")
        panel.set(xlim=bounds[::2], ylim=bounds[1::2], aspect="equal")
        panel.set(xticks=[], yticks=[])
        _ruler(panel, bounds, half)
        panel.legend(loc="upper left", fontsize=8, frameon=True, framealpha=0.9, edgecolor="none")
    chart = axes[0, 2]
    for name, distances in off.items():
        share = 100.0 * (np.arange(len(distances)) + 0.5) / max(len(distances), 1)
        chart.plot(share, np.maximum(np.sort(distances), SMALLEST), color=COLOURS[name], label=name, linewidth=1.6)
    chart.set(yscale="log", xlabel="% of the points of the outline", xlim=(0, 100))
    chart.set_ylabel("unit-square units")
    chart.grid(color=GRID, linewidth=0.4)
    chart.legend(loc="upper left", fontsize=8, frameon=False)
    return figure


def unneeded_divisions(
    shapes: Sequence[tuple[str, Drawing, Tree | ThesisTexture | Texture]],
) -> "Figure":
    """Show the cells of shapes, and mark the quads that divide a square through which only one cubic passes, once.

    Parameters
    ----------
    shapes : sequence of str, Drawing and tree or texture
        The name of each shape, its drawing, and what it was converted to.

    Examples
    --------
    >>> import vexture
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.3), (0, 0.6)])
    >>> unneeded_divisions([("half", half, vexture.convert(half))]).axes[0].get_title(loc="left")
    'half: 0 of 1'
    """
    from matplotlib.patches import Rectangle

    marked = [unnecessary_quads(drawing, shape) for _, drawing, shape in shapes]
    titles = [
        f"{label}: {int(which.sum())} of {len(which)}" for (label, _, _), which in zip(shapes, marked, strict=True)
    ]
    figure, axes = panels(1, len(shapes), side=SIDE, titles=titles)
    for panel, (_, drawing, shape), which in zip(axes[0], shapes, marked, strict=True):
        found = quads(shape)
        _cells(panel, leaves(shape), drawing)
        for x, y, side in zip(found.x[which], found.y[which], found.side[which], strict=True):
            panel.add_patch(Rectangle((x, y), side, side, fill=False, edgecolor=MARK, linewidth=1.5, hatch="//"))
    return figure


def stored_value_errors(stored: Mapping[str, StoredValues]) -> "Figure":
    """Show the errors of the coverage that is stored for cells, and the mean errors of quads by depth.

    Parameters
    ----------
    stored : mapping
        From titles to stored values.

    Examples
    --------
    >>> from vexture_evidence.measures.stored_coverage import stored_values
    >>> from vexture.conversion.pipeline import run_encoding
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.3), (0, 0.6)])
    >>> figure = stored_value_errors({"direct": stored_values(half, run_encoding(half, "thesis").tree)})
    >>> figure.axes[0].get_title(loc="left")
    'direct'
    """
    titles = (*stored, "mean error of quads")
    figure, axes = panels(1, len(titles), side=11.0 / len(titles), height=SIDE, titles=titles)
    top = max(1.0, *(LEVELS * float(values.off.max(initial=0.0)) for values in stored.values()))
    for panel, values in zip(axes[0], stored.values(), strict=False):
        shown = _draw_errors(panel, values.found, LEVELS * values.off, top)
        unit_axes(panel)
    _add_scale(figure, axes[0, :-1], shown, "error, in 1/255")
    chart = axes[0, -1]
    for number, (label, values) in enumerate(stored.items()):
        depths = np.unique(values.quad_depth)
        means = [LEVELS * values.quad_off[values.quad_depth == depth].mean() for depth in depths]
        style = {"color": (COLOURS["sampled"], COLOURS["distance"], COLOURS["packed"])[number % 3], "linewidth": 1.5}
        chart.plot(depths, means, marker="os^"[number % 3], markersize=4, label=label, **style)
    chart.set(xlabel="depth of the quad", ylabel="1/255", ylim=(0.0, 1.7 * chart.get_ylim()[1]))
    chart.xaxis.get_major_locator().set_params(integer=True)
    chart.grid(color=GRID, linewidth=0.4)
    chart.legend(loc="upper right", fontsize=8, frameon=False)
    return figure


def list_growth(lengths: Mapping[str, Sequence[Lengths]], parts: Mapping[str, NDArray[Any]]) -> "Figure":
    """Show the length of the lists over the number of copies of a drawing, and parts of the largest such drawing.

    Parameters
    ----------
    lengths : mapping
        From names of ways to lengths; a refused conversion is marked by a cross at the limit.
    parts : mapping
        From titles to pictures, (height, width).

    Examples
    --------
    >>> figure = list_growth({"packed": [Lengths(1, 16), Lengths(4, 64)]}, {"a part": np.ones((4, 4))})
    >>> figure.axes[0].get_xscale()
    'log'
    """
    titles = ("entries of the longer list", *parts)
    figure, axes = panels(1, len(titles), side=3.6, height=3.4, titles=titles)
    chart = axes[0, 0]
    for (name, found), marker in zip(lengths.items(), "os^", strict=False):
        kept = [length for length in found if length.entries is not None]
        chart.plot(
            [length.copies for length in kept], [length.entries for length in kept],
            color=COLOURS[name], marker=marker, markersize=4, linewidth=1.5, label=name,
        )  # fmt: skip
        refused = [length.copies for length in found if length.entries is None]
        chart.plot(
            refused, [LIST_LIMIT[16]] * len(refused), "x", color=COLOURS[name], markersize=10, mew=2.2, zorder=1.5
        )
    most = max(length.copies for found in lengths.values() for length in found)
    for limit, says in ((LIST_LIMIT[8], "8 bits"), (LIST_LIMIT[16], "16 bits"), (MOST_TEXELS, "packed")):
        chart.axhline(limit, color=MUTED, linewidth=0.9, linestyle="--")
        chart.text(0.02, 1.35 * limit, f"{says}: {limit:,}", transform=chart.get_yaxis_transform(),
                   color=MUTED, fontsize=8)  # fmt: skip
    chart.set(xscale="log", yscale="log", xlabel="copies of the drawing", xlim=(0.7, 2 * most), ylim=(3, 3e8))
    chart.legend(loc="lower right", fontsize=8, frameon=False)
    for panel, image in zip(axes[0, 1:], parts.values(), strict=True):
        show(panel, image)
    return figure


def edited_drawing(before: ThesisTexture, after: EditedTexture, image: NDArray[Any]) -> "Figure":
    """Show what drawing programs see of a thesis texture and of ours, and the result of an edit.

    Parameters
    ----------
    before : ThesisTexture
    after : EditedTexture
        Returned by `vexture_evidence.measures.editing.edit_texture`.
    image : (height, width) array
        Picture of the texture that the edited file was converted to.

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.editing import edit_texture
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.5), (0, 0.5)])
    >>> after = edit_texture(half, vexture.convert(half), '<circle cx="0.5" cy="-0.8" r="0.1"/>', 1)
    >>> figure = edited_drawing(vexture.convert(half, encoding="thesis"), after, np.ones((4, 4)))
    >>> figure.axes[1].get_title(loc="left")
    'as SVG: 4 cubics'
    """
    old, new = len(all_cubics(after.exported)), len(all_cubics(after.drawing))
    again = f"converted again, {1000.0 * after.seconds:.1f} ms"
    titles = ("the thesis's textures", f"as SVG: {old:,} cubics", f"changed: {new:,} cubics", again)
    figure, axes = panels(1, 4, side=SIDE, titles=titles)
    draw_texture(axes[0, 0], before)
    for panel, drawing in zip(axes[0, 1:3], (after.exported, after.drawing), strict=True):
        _editable(panel, drawing, old)
    show(axes[0, 3], image)
    return figure


def _editable(axes: "Axes", drawing: Drawing, old: int) -> None:
    """Draw an outline with its nodes and handles, as drawing programs do; mark the cubics after the first `old`."""
    cubics = all_cubics(drawing)
    lines = points_along(cubics, np.linspace(0.0, 1.0, 33))
    for number, (cubic, line) in enumerate(zip(cubics, lines, strict=True)):
        colour = INK if number < old else MARK
        for handle in (cubic[:2], cubic[2:]):
            axes.plot(*handle.T, color=COLOURS["packed"], linewidth=0.6, marker="o", markersize=1.6)
        axes.plot(*line.T, color=colour, linewidth=1.3)
        axes.plot(*cubic[:1].T, "s", color=colour, markersize=2.6)
    unit_axes(axes)


def _cells(axes: "Axes", found: LeafArrays, drawing: Drawing, bounds: Sequence[float] = UNIT) -> None:
    """Draw cells and curves over the drawing's outline, because packed leaves may omit its horizontal parts."""
    draw_outline(axes, drawing, bounds, color=MUTED, linewidth=0.7, linestyle=":", zorder=1.5)
    draw_cells(axes, found, bounds=bounds)
    if tuple(bounds) != UNIT:
        for axis, low, high in ((axes.xaxis, bounds[0], bounds[2]), (axes.yaxis, bounds[1], bounds[3])):
            ticks = [low, (low + high) / 2, high]
            axis.set_ticks(ticks, [f"{tick:.3f}" for tick in ticks])


def _visible_curves(found: LeafArrays, bounds: Sequence[float]) -> int:
    """Number of curves in the visible leaves."""
    x0, y0, x1, y1 = bounds
    inside = (found.x < x1) & (found.x + found.side > x0) & (found.y < y1) & (found.y + found.side > y0)
    return int(inside[found.owner].sum())


def _short(value: float) -> str:
    return f"{value:.2g}" if value < 10.0 else f"{value:.0f}"


def _add_scale(figure: "Figure", axes: Any, image: Any, label: str) -> None:
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    bar = figure.colorbar(image, ax=list(axes), shrink=0.8, label=label)
    engine = figure.get_layout_engine()
    assert isinstance(engine, ConstrainedLayoutEngine)
    engine.set(rect=(0.006, 0.0, 0.988, 1.0))  # margins: square panels beside a colour bar reach the figure's edge
    bar.outline.set_visible(False)
    bar.ax.tick_params(length=2)


def _squares(found: LeafArrays) -> list[NDArray[np.float64]]:
    x, y, side = found.x, found.y, found.side
    return list(np.stack([x, y, x + side, y, x + side, y + side, x, y + side], axis=1).reshape(-1, 4, 2))


def _borders(axes: "Axes", found: LeafArrays) -> None:
    from matplotlib.collections import PolyCollection

    axes.add_collection(PolyCollection(_squares(found), facecolors="none", edgecolors=MUTED, linewidths=0.4))


def _draw_errors(axes: "Axes", found: LeafArrays, values: NDArray[np.float64], top: float) -> Any:
    """Draw cells in the colours of their errors."""
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import Normalize

    cells = PolyCollection(
        _squares(found), array=values, cmap=error_map(), norm=Normalize(0.0, top), edgecolors=GRID, linewidths=0.4
    )
    axes.add_collection(cells)
    return cells


def _ruler(axes: "Axes", bounds: Sequence[float], half: float) -> None:
    """Draw a scale bar in the lower left corner."""
    length = 10.0 ** np.floor(np.log10(half))
    x, y = bounds[0] + 0.12 * half, bounds[1] + 0.12 * half
    axes.plot([x, x + length], [y, y], color=INK, linewidth=2.0, solid_capstyle="butt")
    axes.annotate(f"{length:.0e} of the drawing".replace("e-0", "e-"), (x, y), xytext=(0, 4),
                  textcoords="offset points", fontsize=8, color=INK)  # fmt: skip
