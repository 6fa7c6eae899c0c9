"""Rendering of a drawing or a texture: the covered part of each pixel, or the picture in colours."""

from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias, cast

from vexture.base.deadline import allowed_seconds
from vexture.base.errors import ParameterError
from vexture.conversion.close_up import close_up
from vexture.conversion.pipeline import convert
from vexture.texture.registry import EncodedTexture

if TYPE_CHECKING:  # imported at run time when needed: compiler and driver take long
    import numpy as np
    from numpy.typing import NDArray

    from vexture.drawing.drawing import Drawing
    from vexture.renderers.view import Size, ViewLike

Shown: TypeAlias = "Drawing | EncodedTexture"
Renderer: TypeAlias = Literal["exact", "cpu", "gpu"]

RENDERERS: Final[tuple[Renderer, ...]] = ("exact", "cpu", "gpu")
"""``"exact"`` renders a drawing; the others render a texture."""


def coverage(
    thing: Shown,
    size: "Size",
    view: "ViewLike" = None,
    renderer: Renderer = "cpu",
    *,
    root: str | int | None = None,
) -> "NDArray[np.float32]":
    """Covered part of each pixel, by a drawing's silhouette or by a shape of a texture.

    Parameters
    ----------
    thing : Drawing or Texture
        ``"exact"`` renders a drawing; ``"cpu"`` and ``"gpu"`` render a texture, and convert the silhouette of a
        drawing first, with the defaults of `vexture.convert`; of views from nearby, only what they show, as exactly as
        they need it.
    size : int or tuple of int
        Width and height of the image in pixels, or the side of a square one.
    view : (2, 3) or (3, 3) array, View or None
        From pixel coordinates (x right, y down, centres at +0.5) to the unit square (y up), as a matrix or by a
        helper such as `vexture.window`; None fits the unit square.
    renderer : str
        ``"exact"``, ``"cpu"`` or ``"gpu"``.
    root : str or int, optional
        Which shape of a texture, by its name or its place in `Texture.roots`; not needed if there is only one.

    Returns
    -------
    (height, width) float32 array
        Coverage, 0..1, top row first.

    Raises
    ------
    ParameterError
        If an argument is out of range, ``"exact"`` is asked of a texture, or a texture holds several shapes and `root`
        is missing.
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
    shown, view, precision = close_up(thing, size, view)
    texture: EncodedTexture = convert(shown, split=None, **_conversion(precision))
    return texture.coverage(size, view, renderer=renderer)


def render(
    thing: Shown,
    size: "Size",
    view: "ViewLike" = None,
    renderer: Renderer = "cpu",
    *,
    root: str | int | None = None,
) -> "NDArray[np.float32]":
    """Picture of a drawing or a texture in its colours. Silhouettes are black.

    A drawing is one picture, with its groups: no background shines through where two shapes touch. The layers of a
    texture that was split by paint are drawn one over the other.

    Parameters
    ----------
    thing, size, view, renderer
        As in `vexture.coverage`. A drawing is split into faces before it is converted.
    root : str or int, optional
        Which drawing of an atlas, by its name, or which shape, by its name or place; not needed if a texture holds
        only one drawing.

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
    """Parameters of a conversion whose distances are those of a close-up, in the time that is left to it."""
    accuracy = {} if precision is None else {"precision": precision, "tolerance": precision}
    return {"max_seconds": allowed_seconds(), **accuracy}


def _check(thing: Shown, renderer: Renderer, root: str | int | None) -> None:
    """Raise an error unless the arguments fit each other: the renderer ``"exact"`` is for drawings alone."""
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
