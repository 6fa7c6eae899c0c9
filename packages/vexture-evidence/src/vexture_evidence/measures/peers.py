"""Other renderers of vector graphics, on the CPU: resvg and Skia.

Both crash on hostile input, so they only get curves that this module writes, of a drawing that was already read and
checked. Neither draws a silhouette: paths are painted over one another, so an edge that two of them share may show.
"""

from collections.abc import Callable
from importlib import import_module
from io import BytesIO
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.base.errors import DeviceError
from vexture.drawing.drawing import FillRule
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Paint
from vexture.renderers.view import size_of, view_matrix
from vexture_evidence.measures.raster import FULL

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing, Path

DIGITS: Final = 8
"""Decimals of a coordinate; both libraries compute in float32."""

RULES: Final = {FillRule.NONZERO: "nonzero", FillRule.EVENODD: "evenodd"}

Renderer = Callable[[], NDArray[np.float32]]
"""Draws a picture again each time it is called: coverage, (height, width), top row first."""


def render_resvg(drawing: "Drawing", size: tuple[int, int]) -> NDArray[np.float32]:
    """Coverage as resvg draws it, the unit square fitted into the image.

    Parameters
    ----------
    drawing : Drawing
    size : tuple of int
        Width and height of the image in pixels.

    Returns
    -------
    (height, width) float32 array
        In steps of 1/255, top row first.

    Raises
    ------
    ParameterError
        If the size is out of range.
    DeviceError
        If resvg is not installed.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> render_resvg(Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)]), (4, 1))
    array([[0.       , 0.5019608, 0.       , 0.       ]], dtype=float32)
    """
    return resvg_renderer(drawing, size)()


def resvg_renderer(drawing: "Drawing", size: tuple[int, int]) -> Renderer:
    """Prepare a drawing for resvg: its SVG document is parsed here, and the result only renders it.

    The package returns only PNG files, so decoding is part of the rendering time.
    """
    resvg = _package("resvg", "resvg")
    from PIL import Image

    tree = resvg.usvg.Tree.from_str(svg_text(drawing, size_of(size)), resvg.usvg.Options.default())

    def draw() -> NDArray[np.float32]:
        with Image.open(BytesIO(bytes(resvg.render(tree, (1, 0, 0, 0, 1, 0))))) as picture:
            return _coverage(np.asarray(picture.convert("RGBA")))

    return draw


def render_skia(drawing: "Drawing", size: tuple[int, int], to_unit: ArrayLike | None = None) -> NDArray[np.float32]:
    """Coverage as Skia draws it on the CPU, with its anti-aliasing.

    Parameters
    ----------
    drawing : Drawing
    size : tuple of int
        Width and height of the image in pixels.
    to_unit : (2, 3) or (3, 3) array, optional
        From pixel coordinates to the unit square; None fits the square.

    Returns
    -------
    (height, width) float32 array
        In steps of 1/255, top row first.

    Raises
    ------
    ParameterError
        If the size or the view is out of range.
    DeviceError
        If Skia is not installed.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> render_skia(Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)]), (2, 2))
    array([[1., 0.],
           [1., 0.]], dtype=float32)
    """
    return skia_renderer(drawing, size, to_unit)()


def skia_renderer(drawing: "Drawing", size: tuple[int, int], to_unit: ArrayLike | None = None) -> Renderer:
    """Prepare a drawing for Skia: its paths are made here, and the result only renders them."""
    skia = _skia()
    from_unit = np.linalg.inv(view_matrix(to_unit, size)).astype(np.float64)
    outlines = [skia_path(path, from_unit) for path in drawing.paths]
    paint = skia.Paint(AntiAlias=True, Color=skia.ColorBLACK)

    def draw() -> NDArray[np.float32]:
        pixels = np.zeros((size[1], size[0], 4), np.uint8)
        with skia.Surface(pixels) as canvas:
            for outline in outlines:
                canvas.drawPath(outline, paint)
        return _coverage(pixels)

    return draw


def skia_path(path: "Path", matrix: NDArray[np.float64]) -> Any:
    """Convert a path to a path of Skia, transformed by a (3, 3) matrix.

    Raises
    ------
    DeviceError
        If Skia is not installed.
    """
    skia = _skia()
    outline = skia.Path()
    even_odd = path.fill_rule == FillRule.EVENODD
    outline.setFillType(skia.PathFillType.kEvenOdd if even_odd else skia.PathFillType.kWinding)
    for contour in path.contours:
        outline.moveTo(*contour[0, 0].tolist())
        for cubic in contour[:, 1:].reshape(-1, 6).tolist():
            outline.cubicTo(*cubic)
        outline.close()
    outline.transform(skia.Matrix(matrix.tolist()))
    return outline


def paint_with_skia(canvas: Any, drawing: "Drawing", matrix: NDArray[np.float64]) -> None:
    """Paint a drawing in its colours and groups on a canvas of Skia; the (3, 3) matrix maps to its pixels.

    Raises
    ------
    DeviceError
        If Skia is not installed.
    """
    _skia()
    items: dict[int, dict[tuple[str, int], None]] = {}
    for place, path in enumerate(drawing.paths):
        around = [-1, *drawing.around(path.group)]
        for outer, inner in pairwise(around):
            items.setdefault(outer, {})["group", inner] = None
        items.setdefault(around[-1], {})["path", place] = None
    _paint_group(canvas, drawing, matrix, items, -1)


def _paint_group(
    canvas: Any,
    drawing: "Drawing",
    matrix: NDArray[np.float64],
    items: dict[int, dict[tuple[str, int], None]],
    outer: int,
) -> None:
    """Paint the paths and groups in the group `outer`, which `items` lists from below, then its masks."""
    skia = _skia()
    for kind, place in items.get(outer, {}):
        if kind == "path":
            path = drawing.paths[place]
            canvas.drawPath(skia_path(path, matrix), _skia_paint(path.paint, matrix))
        elif not drawing.groups[place].mask:
            group = drawing.groups[place]
            canvas.saveLayer(None, skia.Paint(Alphaf=group.opacity, BlendMode=_skia_mode(group.blend)))
            _paint_group(canvas, drawing, matrix, items, place)
            canvas.restore()
    for place, mask in enumerate(drawing.groups):
        if mask.mask and mask.outer == outer:
            luma = skia.LumaColorFilter.Make() if mask.mask is Mask.LUMINANCE else None
            canvas.saveLayer(None, skia.Paint(Alphaf=mask.opacity, BlendMode=skia.BlendMode.kDstIn, ColorFilter=luma))
            _paint_group(canvas, drawing, matrix, items, place)
            canvas.restore()


def _skia_paint(paint: Paint, matrix: NDArray[np.float64]) -> Any:
    """Skia's paint of a drawing's, moved by `matrix` from the unit square to pixels."""
    skia, gradient = _skia(), paint.gradient
    if gradient is None:
        return skia.Paint(Color4f=skia.Color4f(*paint.color, paint.opacity), AntiAlias=True)
    to_pixels = matrix @ np.linalg.inv(np.array([*gradient.to_ramp, (0.0, 0.0, 1.0)]))
    ramp = (
        [skia.Color4f(*stop.color, stop.opacity).toColor() for stop in gradient.stops],
        [stop.offset for stop in gradient.stops],
        (skia.TileMode.kClamp, skia.TileMode.kMirror, skia.TileMode.kRepeat)[gradient.spread],
        0,
        skia.Matrix(to_pixels.ravel().tolist()),
    )
    if gradient.focus is None:
        shader = skia.GradientShader.MakeLinear([skia.Point(0, 0), skia.Point(1, 0)], *ramp)
    else:
        x, radius = gradient.focus
        shader = skia.GradientShader.MakeTwoPointConical(skia.Point(x, 0), radius, skia.Point(0, 0), 1.0, *ramp)
    return skia.Paint(Shader=shader, AntiAlias=True)


def _skia_mode(blend: Blend) -> Any:
    """Skia's name of a blend mode, such as kColorDodge; without blending it is kSrcOver."""
    other = {Blend.NORMAL: "kSrcOver", Blend.PLUS_LIGHTER: "kPlus"}
    named = "k" + blend.name.title().replace("_", "")
    return getattr(_skia().BlendMode, other.get(blend, named))


def check_peers() -> None:
    """Check that both renderers are installed, before anything is measured.

    Raises
    ------
    DeviceError
        If one of them is not installed, or cannot be loaded.

    Examples
    --------
    >>> check_peers()
    """
    _package("resvg", "resvg")
    _skia()


def svg_text(drawing: "Drawing", size: tuple[int, int]) -> str:
    """SVG document of a drawing's paths, y down, with the unit square fitted into it.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> svg_text(Drawing.polygon([(0, 0), (1, 0), (0, 1)]), (4, 2))[-76:]
    'C0.00000000 0.33333333 0.00000000 0.66666667 0.00000000 1.00000000Z"/></svg>'
    """
    paths = []
    for path in drawing.paths:
        data = "".join(_contour_data(contour * (1.0, -1.0) + (0.0, 1.0)) for contour in path.contours)
        paths.append(f'<path fill-rule="{RULES[path.fill_rule]}" d="{data}"/>')
    box = f'width="{size[0]}" height="{size[1]}" viewBox="0 0 1 1"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {box}>{"".join(paths)}</svg>'


def _contour_data(cubics: NDArray[np.float64]) -> str:
    steps = "".join("C" + " ".join(f"{value:.{DIGITS}f}" for value in cubic[1:].flat) for cubic in cubics)
    return f"M{cubics[0, 0, 0]:.{DIGITS}f} {cubics[0, 0, 1]:.{DIGITS}f}{steps}Z"


def _coverage(pixels: NDArray[np.uint8]) -> NDArray[np.float32]:
    return (pixels[..., 3] / FULL).astype(np.float32)


def _skia() -> Any:
    return _package("skia", "skia-python")


def _package(module: str, name: str) -> Any:
    try:
        return import_module(module)
    except ModuleNotFoundError:
        raise DeviceError(f"this comparison needs the package {name}: pip install vexture-evidence") from None
    except ImportError as error:  # a library of the system is missing, such as libEGL
        raise DeviceError(f"the package {name} cannot be loaded: {error}; install what it names") from None
