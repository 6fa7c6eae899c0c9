"""The common style of all figures: colours, panels, axes of the unit square."""

from collections.abc import Sequence
from io import BytesIO
from typing import TYPE_CHECKING, Any, Final

from vexture.base.errors import DeviceError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

INK: Final = "#1b2733"
MUTED: Final = "#6b7688"
GRID: Final = "#b9c1cc"

COLOURS: Final = {
    "truth": "#1b2733",
    "packed": "#0072b2",
    "direct": "#009e73",
    "sampled": "#e69f00",
    "raster": "#cc79a7",
    "distance": "#d55e00",
    "bands": "#56b4e9",
    "resvg": "#999999",
    "skia": "#ad8b00",
}
"""One colour for each method, in every figure (M. Okabe and K. Ito, "Color Universal Design", 2008)."""

RESOLUTION: Final = 160
"""Pixels per inch in the files of the figures."""

SMALL: Final = 8.0
"""Size of the smallest text, in points."""

FONT: Final = {
    "font.family": "DejaVu Sans",  # comes with matplotlib
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.edgecolor": GRID,
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "text.color": INK,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
    "legend.frameon": False,
    "legend.fontsize": SMALL,
    "image.interpolation": "nearest",
}


def plotting() -> Any:
    """Import and return the package matplotlib.

    Raises
    ------
    DeviceError
        If matplotlib is not installed.

    Examples
    --------
    >>> plotting().__name__
    'matplotlib'
    """
    try:
        import matplotlib
    except ModuleNotFoundError:
        raise DeviceError("figures need the package matplotlib: pip install vexture-evidence") from None
    return matplotlib


def coverage_map() -> Any:
    """Colour map of coverage: white means empty, dark means full."""
    plotting()
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("coverage", ["#ffffff", INK])


def error_map() -> Any:
    """Colour map of absolute errors: light means no error; legible to colour-blind readers and in print."""
    return plotting().colormaps["magma_r"]


def panels(
    rows: int, columns: int, *, side: float = 2.6, height: float | None = None, titles: Sequence[str] = ()
) -> "tuple[Figure, NDArray[Any]]":
    """Make a figure with a grid of axes, in the common style, without a window or global state.

    Parameters
    ----------
    rows, columns : int
    side, height : float
        Width and height of each panel in inches; without `height`, panels are square.
    titles : sequence of str
        Titles of the panels, row by row.

    Returns
    -------
    figure : matplotlib.figure.Figure
        A notebook shows it if it is the last value of a cell.
    axes : (rows, columns) array of matplotlib.axes.Axes

    Raises
    ------
    DeviceError
        If matplotlib is not installed.

    Examples
    --------
    >>> figure, axes = panels(1, 2, titles=("left", "right"))
    >>> axes.shape, [panel.get_title(loc="left") for panel in axes.flat]
    ((1, 2), ['left', 'right'])
    """
    matplotlib = plotting()
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    class NotebookFigure(Figure):
        """A figure that notebooks display by themselves."""

        def _repr_png_(self) -> bytes:
            data = BytesIO()
            self.savefig(data, format="png", dpi=RESOLUTION)
            return data.getvalue()

    with matplotlib.rc_context(FONT):
        figure = NotebookFigure(figsize=(columns * side, rows * (height or side)), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(rows, columns, squeeze=False)
        for panel, title in zip(axes.flat, titles, strict=False):
            panel.set_title(title, loc="left")
    return figure, axes


def unit_axes(axes: "Axes", *, ticks: bool = True, bounds: Sequence[float] = (0.0, 0.0, 1.0, 1.0)) -> None:
    """Set axes to the unit square, y up, or to the part of it in `bounds`: x0, y0, x1, y1."""
    x0, y0, x1, y1 = bounds
    axes.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal")
    axes.set_xticks([x0, (x0 + x1) / 2, x1] if ticks else [])
    axes.set_yticks([y0, (y0 + y1) / 2, y1] if ticks else [])
    axes.tick_params(length=2)


def show(axes: "Axes", image: "NDArray[Any]", *, pixels: bool = True, **options: Any) -> Any:
    """Show coverage or a colour picture, top row first.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    image : (height, width) or (height, width, 3) array
        Coverage 0..1, where dark means full; or sRGB 0..1.
    pixels : bool
        Whether to label the picture's width in pixels.
    options
        Passed to ``Axes.imshow``; ``cmap``, ``vmin`` and ``vmax`` are those of coverage by default.
    """
    options = {"cmap": coverage_map(), "vmin": 0.0, "vmax": 1.0, "interpolation": "nearest"} | options
    shown = axes.imshow(image, **options)
    height, width = image.shape[:2]
    if "extent" not in options:
        axes.set_xticks([-0.5, width - 0.5], ["0", f"{width} px"] if pixels else ["", ""])
        axes.set_yticks([-0.5, height - 0.5], ["", ""])
        axes.tick_params(length=2)
    return shown
