"""Rendering of a drawing or a texture: the coverage of each pixel, or the picture in colours.

For a view from nearby, the visible part of a drawing is converted by itself, as exactly as the view needs.
"""

from dataclasses import replace
from typing import Any, Final, Literal, NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import allowed_seconds
from vexture.base.errors import ParameterError
from vexture.base.tolerance import UNSEEN
from vexture.conversion.pipeline import convert
from vexture.drawing.affine import Affine
from vexture.drawing.drawing import Drawing
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix
from vexture.texture.registry import EncodedTexture

Shown: TypeAlias = Drawing | EncodedTexture
Renderer: TypeAlias = Literal["exact", "cpu", "gpu"]

RENDERERS: Final[tuple[Renderer, ...]] = ("exact", "cpu", "gpu")
"""``"exact"`` renders a drawing; the others render a texture."""

SHARE: Final = 0.04
"""Largest error of an outline that cannot be seen, in pixels; `UNSEEN` is this error in a picture of 2,000 pixels."""

MARGIN: Final = 2.0
"""Pixels around the view, so that no pixel shows the sides along which the drawing was cut."""

FLIP: Final[Affine] = ((1.0, 0.0, 0.0), (0.0, -1.0, 1.0))
"""Flip of the unit square, between y up and y down."""


def coverage(
    thing: Shown,
    size: Size,
    view: ViewLike = None,
    renderer: Renderer = "cpu",
    *,
    root: str | int | None = None,
) -> NDArray[np.float32]:
    """Return the coverage of each pixel by the silhouette of a drawing or by a shape of a texture.

    Parameters
    ----------
    thing : Drawing or Texture
        ``"exact"`` renders a drawing; ``"cpu"`` and ``"gpu"`` render a texture. They convert the silhouette of a
        drawing first, with the defaults of `vexture.convert`. For a view from nearby they convert only the visible
        part, as exactly as the view needs.
    size : int or tuple of int
        Width and height of the image in pixels, or the side of a square one.
    view : (2, 3) or (3, 3) array, View or None
        From pixel coordinates (x right, y down, centres at +0.5) to the unit square (y up), as a matrix or by a
        helper such as `vexture.window`; None fits the unit square.
    renderer : str
        ``"exact"``, ``"cpu"`` or ``"gpu"``.
    root : str or int, optional
        Name of a shape of a texture, or its index in `Texture.roots`; may be left out if there is only one shape.

    Returns
    -------
    (height, width) float32 array
        Coverage, 0..1, top row first.

    Raises
    ------
    ParameterError
        If an argument is out of range, `renderer` is ``"exact"`` for a texture, or `root` is missing and the texture
        has several shapes.
    TypeError
        If `thing` is neither a drawing nor a texture.
    DeviceError
        If there is no GPU.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> half = Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)])
    >>> coverage(half, 2)
    array([[1., 0.],
           [1., 0.]], dtype=float32)
    """
    from vexture.drawing.drawing import Drawing

    _check(thing, renderer, root)
    if renderer == "exact":
        from vexture.renderers.exact import render_exact

        return render_exact(cast("Drawing", thing).without_masks(), size, view)
    if not isinstance(thing, Drawing):
        return thing.coverage(size, view, renderer=renderer, root=root)
    part, view, precision = close_up(thing, size, view)
    texture: EncodedTexture = convert(part, split=None, **_conversion(precision))
    return texture.coverage(size, view, renderer=renderer)


def render(
    thing: Shown,
    size: Size,
    view: ViewLike = None,
    renderer: Renderer = "cpu",
    *,
    root: str | int | None = None,
) -> NDArray[np.float32]:
    """Render a drawing or a texture in its colours; silhouettes are black.

    A drawing is rendered as one picture, with its groups: where two shapes touch, the background does not shine
    through. If a texture was split by paint, its layers are drawn one over the other.

    Parameters
    ----------
    thing, size, view, renderer
        As in `vexture.coverage`. A drawing is split into faces before it is converted.
    root : str or int, optional
        Name of a drawing in an atlas, or name or index of a shape; may be left out if the texture has only one
        drawing.

    Returns
    -------
    (height, width, 4) float32 array
        sRGB and opacity, 0..1, **premultiplied**, top row first: ``image[..., :3] + 1 - image[..., 3:]`` is the
        picture on white.

    Raises
    ------
    ParameterError, TypeError, DeviceError
        As in `vexture.coverage`.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing, Path
    >>> from vexture.drawing.paint import Paint
    >>> half = Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)]).paths[0].contours
    >>> red = Drawing((Path(half, paint=Paint((1.0, 0.0, 0.0), 0.5)),))
    >>> render(red, (2, 1), [[0.5, 0, 0], [0, -1, 1]])
    array([[[0.5, 0. , 0. , 0.5],
            [0. , 0. , 0. , 0. ]]], dtype=float32)
    """
    from vexture.drawing.drawing import Drawing

    _check(thing, renderer, root)
    precision = None
    if isinstance(thing, Drawing) and renderer != "exact":
        thing, view, precision = close_up(thing, size, view)
    empty = isinstance(thing, Drawing) and not thing.paths
    if renderer != "exact" and not empty:
        texture = convert(thing, split="faces", **_conversion(precision)) if isinstance(thing, Drawing) else thing
        return texture.render(size, view, renderer=renderer, root=root)
    from vexture.renderers.exact import render_exact_colours

    return render_exact_colours(cast("Drawing", thing), size, view)


def _conversion(precision: float | None) -> dict[str, Any]:
    """Return the parameters of a conversion with the precision of a close-up, within the time that remains."""
    accuracy = {} if precision is None else {"precision": precision, "tolerance": precision}
    return {"max_seconds": allowed_seconds(), **accuracy}


def _check(thing: Shown, renderer: Renderer, root: str | int | None) -> None:
    """Raise an error if the arguments do not fit together: the renderer ``"exact"`` accepts only drawings."""
    from vexture.drawing.drawing import Drawing

    if renderer not in RENDERERS:
        raise ParameterError(f"`renderer` is {renderer!r}; it must be one of {', '.join(map(repr, RENDERERS))}")
    if not isinstance(thing, Drawing):
        if not hasattr(thing, "coverage"):
            raise TypeError(
                f"{type(thing).__name__} is neither a drawing nor a texture; use vexture.read or vexture.load first"
            )
        if renderer == "exact":
            raise ParameterError("`renderer` is 'exact', which renders drawings; use cpu or gpu for a texture")
    elif root is not None:
        raise ParameterError(f"`root` is {root!r}, which chooses a shape of a texture; leave it out for a drawing")


class CloseUp(NamedTuple):
    """The visible part of a drawing.

    Parameters
    ----------
    drawing : Drawing
    view : (3, 3) array
        From pixels to the drawing's unit square.
    precision : float or None
        Precision to convert the part with; None for the default.
    """

    drawing: Drawing
    view: NDArray[np.float64]
    precision: float | None = None


def close_up(drawing: Drawing, size: Size, view: ViewLike) -> CloseUp:
    """Cut out the visible part of a drawing if the view is too close for the usual texture; else keep the drawing.

    Views in perspective keep the whole drawing, because no single box suits all of their pixels.

    Examples
    --------
    >>> square = Drawing.polygon([(0.5, 0.5), (0.75, 0.5), (0.75, 0.75), (0.5, 0.75)])
    >>> whole = close_up(square, 500, None)
    >>> whole.drawing is square, whole.precision
    (True, None)
    >>> part = close_up(square, 500, [[1e-7, 0, 0.5], [0, -1e-7, 0.5]])
    >>> part.drawing.paths[0].box.round(3).tolist(), part.precision
    ([[0.004, 0.996], [1.0, 1.0]], None)
    """
    width, height = size_of(size)
    matrix = view_matrix(view, size)
    if (matrix[2, :2] != 0.0).any():
        return CloseUp(drawing, matrix)
    matrix = matrix / matrix[2, 2]
    pixel = float(np.linalg.svd(matrix[:2, :2], compute_uv=False)[-1])
    if pixel >= UNSEEN / SHARE:
        return CloseUp(drawing, matrix)
    across, down = ((-MARGIN, side + MARGIN) for side in (width, height))
    ends = np.array([(x, y, 1.0) for x in across for y in down]) @ matrix[:2].T
    low, high = np.clip(ends.min(axis=0), 0.0, 1.0), np.clip(ends.max(axis=0), 0.0, 1.0)
    if (high <= low).any():
        return CloseUp(replace(drawing, paths=(), groups=()), matrix)
    part = _part(drawing, low, high)
    to_whole = np.vstack([FLIP, (0.0, 0.0, 1.0)]) @ np.vstack([part.to_source, (0.0, 0.0, 1.0)])
    side = float((high - low).max())
    precision = SHARE * pixel / side if pixel / side < UNSEEN / SHARE else None
    to_source = (np.vstack([drawing.to_source, (0.0, 0.0, 1.0)]) @ to_whole)[:2]
    part = replace(part, to_source=to_source, crs=drawing.crs, notes=drawing.notes)
    return CloseUp(part, np.linalg.solve(to_whole, matrix), precision)


def _part(drawing: Drawing, low: NDArray[np.float64], high: NDArray[np.float64]) -> Drawing:
    """Cut a box out of a drawing and scale it up; `to_source` of the part leads to the unit square with y down."""
    flipped = (
        replace(
            path,
            contours=tuple(contour * (1.0, -1.0) + (0.0, 1.0) for contour in path.contours),
            paint=path.paint.after(FLIP),
        )
        for path in drawing.paths
    )
    box = (float(low[0]), float(1.0 - high[1]), float(high[0] - low[0]), float(high[1] - low[1]))
    return Drawing.from_source(flipped, box, drawing.name, drawing.groups)
