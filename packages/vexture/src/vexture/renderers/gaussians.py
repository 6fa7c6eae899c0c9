"""Gaussian blurs for the exact renderer: of the exact picture of their source, independent of any grid of a texture.

The source is rendered by the exact renderer itself, on cells. Each axis is then convolved with a Gaussian in two
steps. The first one, over cells, thins them out to nodes, 3 cells apart. The second one is over nodes. The variance of
both steps and of a cell is that of the blur. At last, the cubic spline through the values at the nodes replaces them.

With d deviations between nodes, the spline is off by up to 3 d^4 / 384 and, where a straight edge of the source lies
upright or level in the middle of cells, by a further 0.24 (d / 3)^2 / 8. Nodes are a quarter of a deviation apart: that
is 0.06/255, and the worst of the closed forms in the tests is off by as much. Nodes are further apart if the image
shows more than `MOST_VALUES` of them: then up to 0.33/255 at half a deviation, as for a blur of opacities of which the
image shows 2,048 x 2,048 deviations. A blur that would need a larger distance is refused. If a blur is in linear light,
the values at the nodes are converted to sRGB; the spline between them is then off by up to 0.15/255 in the dark.
"""

from collections.abc import Callable, Iterator
from math import ceil, sqrt
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.errors import LimitError
from vexture.drawing.blur import Blur
from vexture.drawing.drawing import Drawing
from vexture.renderers.smooth import Grid, Spline

SPACING: Final = 0.25
"""Deviations between nodes, unless the image shows too many."""

WIDEST: Final = 0.5
"""Most deviations between nodes."""

MOST_VALUES: Final = 2**24
"""Most values at the nodes of one blur, of four in colours."""

CELLS: Final = 3
"""Cells between nodes, an odd number."""

AT_ONCE: Final = 2**21
"""Cells, or values at nodes, that are convolved at once."""

TAIL: Final = 5.5
"""Deviations of a Gaussian beyond which less than 1e-7 of it is left."""

FIRST: Final = 0.5
"""Variance of the first step, in squares of the distance of nodes: finer detail than nodes resolve is gone by then."""

REACH: Final = 1.5
"""Deviations over which three points of quadrature are off by at most 0.005/255, as two are over a third of it."""

POLE: Final = sqrt(3.0) - 2.0
"""Coefficients of a spline are values at its nodes, each weighted by the distance's power of this (Unser 1999)."""

Values: TypeAlias = NDArray[np.float64]

Render: TypeAlias = Callable[[Drawing, tuple[int, int], Values, bool], Grid]
"""Exact renderer of a drawing, for a size and a view; the last argument asks for colours in linear light."""


def blurred_spline(blur: Blur, view: Values, size: tuple[int, int], render: Render) -> Spline:
    """Return a blur in an image, in black or in its own colours.

    `view` is the (3, 3) matrix from pixel coordinates to those of the drawing; `render` renders the source.
    """
    window = window_in_sight(blur, view, size)
    components = 4 if blur.has_colors else 1
    d = spacing_of(blur, window, components)
    across, up = (d * deviation for deviation in blur.deviations)
    left, low, right, high = window
    columns, rows = ceil((right - left) / across) + 4, ceil((high - low) / up) + 4
    values = blurred_values(blur, (left - across, high + up), (across, up), (columns + 2 * RIM, rows + 2 * RIM), render)
    grid = coefficients_of(values, blur.is_linear)
    (a, b, c), (e, f, g) = blur.to_source
    return Spline(
        ((a / across, b / across, (c - left) / across + 1.0), (-e / up, -f / up, (high - g) / up + 1.0)),
        grid,
        (1.0, 1.0, 1.0 + (right - left) / across, 1.0 + (high - low) / up),
        (REACH / d, REACH / d),
        is_blur=True,
    )


def window_in_sight(blur: Blur, view: Values, size: tuple[int, int]) -> tuple[float, float, float, float]:
    """Return the part of a blur's window that an image may show, in coordinates of the source."""
    left, low, right, high = blur.window
    width, height = size
    corners = np.array([[0, width, 0, width], [0, 0, height, height], [1, 1, 1, 1]])
    X, Y, W = np.array([*blur.to_source, (0.0, 0.0, 1.0)]) @ view @ corners
    if W.min() <= 0.0:
        return left, low, right, high
    x, y = np.clip(X / W, left, right), np.clip(Y / W, low, high)
    return float(x.min()), float(y.min()), float(x.max()), float(y.max())


def spacing_of(blur: Blur, window: tuple[float, float, float, float], components: int) -> float:
    """Return the distance of nodes, in deviations; raise a `LimitError` if more are in sight than fit."""
    across, up = ((window[k + 2] - window[k]) / blur.deviations[k] for k in range(2))
    d = max(SPACING, sqrt(across * up * components / MOST_VALUES))
    if d > WIDEST or max(across, up) > MOST_VALUES:
        raise LimitError(
            f"a blur of {blur.source.name} shows {across:,.0f} x {up:,.0f} of its deviations; the limit of the exact "
            f"renderer is {MOST_VALUES * WIDEST**2 / components:,.0f}; render a smaller part, or use another `renderer`"
        )
    return d


def blurred_values(
    blur: Blur, corner: tuple[float, float], steps: tuple[float, float], size: tuple[int, int], render: Render
) -> Values:
    """Return the blurred source at nodes, (rows, columns, 1 or 4).

    The upper left node is `RIM` steps beyond the corner, which is in coordinates of the source, as are the steps.
    """
    (columns, rows), (across, up) = size, steps
    cell = 1.0 / CELLS**2 / 12.0
    first = gaussian_weights(CELLS * sqrt(FIRST - cell))
    seconds = [gaussian_weights(sqrt((blur.deviations[k] / steps[k]) ** 2 - FIRST)) for k in range(2)]
    margins = [len(weights) // 2 for weights in seconds]
    margin = len(first) // 2
    wide, tall = columns + 2 * margins[0], rows + 2 * margins[1]
    thinned = np.empty((tall, wide, 4 if blur.has_colors else 1))
    cells = CELLS * (wide - 1) + 2 * margin + 1
    scale = across / CELLS, up / CELLS
    x = corner[0] - (RIM + margins[0]) * across - (margin + 0.5) * scale[0]
    y = corner[1] + (RIM + margins[1]) * up + (margin + 0.5) * scale[1]
    for begin, end in parts_of(tall, cells * CELLS, blur.source.name):
        top = y - begin * up
        height = CELLS * (end - begin - 1) + 2 * margin + 1
        matrix = np.array([[scale[0], 0.0, x], [0.0, -scale[1], top], [0.0, 0.0, 1.0]])
        image = render(blur.source, (cells, height), matrix, blur.is_linear)
        part = image.astype(np.float64) if blur.has_colors else image[..., 3:].astype(np.float64)
        thinned[begin:end] = convolve(convolve(part, first, 1, CELLS), first, 0, CELLS)
    found = np.empty((rows, columns, thinned.shape[2]))
    for begin, end in parts_of(rows, wide, blur.source.name):
        part = thinned[begin : end + 2 * margins[1]]
        found[begin:end] = convolve(convolve(part, seconds[1], 0), seconds[0], 1)
    return found


def parts_of(count: int, width: int, name: str) -> Iterator[tuple[int, int]]:
    """Yield the first and the last + 1 of parts of some rows, of about `AT_ONCE` numbers; check the time limit."""
    step = max(AT_ONCE // width, 32)
    for begin in range(0, count, step):
        check_time(name, "the exact renderer", "use another `renderer`, simplify the drawing")
        yield begin, min(begin + step, count)


def gaussian_weights(deviation: float) -> Values:
    """Return weights of a Gaussian at whole numbers, whose sum is 1."""
    reach = ceil(TAIL * deviation)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / deviation) ** 2)
    normal: Values = weights / weights.sum()
    return normal


def convolve(values: Values, weights: Values, axis: int, step: int = 1) -> Values:
    """Convolve an array along an axis with symmetric weights, without margins; keep every n-th result.

    Examples
    --------
    >>> convolve(np.array([0.0, 0.0, 1.0, 2.0, 4.0]), np.array([0.25, 0.5, 0.25]), 0, 2).tolist()
    [0.25, 2.25]
    """
    values = np.moveaxis(values, axis, 0)
    count, last = (len(values) - len(weights)) // step + 1, len(weights) - 1
    span = (count - 1) * step + 1
    total = weights[last // 2] * values[last // 2 : last // 2 + span : step]
    for k in range(last // 2):
        total += weights[k] * (values[k : k + span : step] + values[last - k : last - k + span : step])
    return np.moveaxis(total, 0, axis)


PREFILTER = sqrt(3.0) * POLE ** np.abs(np.arange(-12, 13))
"""Weights that turn values at nodes into coefficients of the spline through them; 1e-7 is left out."""

RIM: Final = len(PREFILTER) // 2
"""Nodes beyond the coefficients."""


def coefficients_of(values: Values, is_linear: bool) -> Grid:
    """Return the coefficients of the spline through values; of linear ones, through their colours in sRGB."""
    if is_linear:
        values = encode(values)
    grid: Grid = convolve(convolve(values, PREFILTER, 0), PREFILTER, 1).astype(np.float32)
    return grid


def encode(colours: Values) -> Values:
    """Convert premultiplied colours in linear light to premultiplied ones in sRGB."""
    opacity = np.clip(colours[..., 3:], 0.0, 1.0)
    straight = np.clip(colours[..., :3] / np.maximum(opacity, 1e-12), 0.0, 1.0)
    encoded = np.where(straight <= 0.0031308, 12.92 * straight, 1.055 * np.maximum(straight, 1e-9) ** (1 / 2.4) - 0.055)
    return np.concatenate([encoded * opacity, opacity], axis=2)
