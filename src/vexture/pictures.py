"""From a texture or a drawing to a picture: which renderer, which of the shapes, which colours."""

from typing import TYPE_CHECKING, Final, TypeAlias

from vexture.errors import LimitError
from vexture.pipeline import convert

if TYPE_CHECKING:  # at run time they come when they are needed: compiler and driver take their time
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from vexture.drawing import Drawing, Paint
    from vexture.encoding import PackedTexture, Root, ThesisTexture

    Shown: TypeAlias = Drawing | PackedTexture | ThesisTexture

__all__ = ["QUALITIES", "RENDERERS", "find_root", "layers_of", "on_white", "render", "render_layers"]

RENDERERS: Final = ("exact", "cpu", "gpu")
"""From a drawing; from a texture on the CPU, on the GPU."""

QUALITIES: Final = ("fast", "exact")
"""Of the renderers of packed textures."""

MOST_NAMED = 6
"""Shapes of a texture that a message names."""


def render(
    texture_or_drawing: "Shown",
    size: tuple[int, int],
    to_unit: "ArrayLike | None" = None,
    renderer: str = "gpu",
    *,
    root: str | int | None = None,
    quality: str = "exact",
) -> "NDArray[np.float32]":
    """Render how much of each pixel a shape covers.

    Parameters
    ----------
    texture_or_drawing : PackedTexture, ThesisTexture or Drawing
        ``"exact"`` draws a drawing; ``"cpu"`` and ``"gpu"`` draw a texture, and convert a drawing with the defaults
        of `vexture.convert` first.
    size : tuple of int
        Width and height of the image in pixels.
    to_unit : (2, 3) or (3, 3) array, optional
        From pixel coordinates (x right, y down, centres at +0.5) to the unit square (y up); None fits the square.
    renderer : str
        ``"exact"``, ``"cpu"`` or ``"gpu"``.
    root : str or int, optional
        Which shape of a packed texture, by its name or its place in `roots`; not needed if there is only one.
    quality : str
        ``"exact"`` or, for packed textures, ``"fast"``: how closely a pixel's coverage is computed.

    Returns
    -------
    (height, width) float32 array
        Coverage, 0..1, top row first.

    Raises
    ------
    LimitError
        If the renderer is unknown, "exact" is given a texture, a texture holds several shapes and none is named, or
        the size or view is out of range.
    FormatError
        If the texture has no such shape.
    DeviceError
        If there is no GPU.

    Examples
    --------
    >>> import numpy as np
    >>> from vexture.encoding import ThesisTexture
    >>> full = ThesisTexture(np.zeros((1, 4, 3), np.uint8), np.zeros((2, 2, 3), np.uint8))
    >>> render(full, (2, 1), renderer="cpu")
    array([[0.5, 0.5]], dtype=float32)
    """
    _check(renderer, quality)
    from vexture.drawing import Drawing
    from vexture.encoding import PackedTexture, ThesisTexture

    shown = texture_or_drawing
    if not isinstance(shown, Drawing | PackedTexture | ThesisTexture):
        raise LimitError(f"{shown!r} is no texture or drawing; read it by vexture.load or vexture.read_svg")
    if isinstance(shown, Drawing):
        if root is not None:
            raise LimitError(f"root={root!r} chooses a shape of a texture; a drawing is one: leave root out")
        if renderer == "exact":
            from vexture.render.exact import render_exact

            return render_exact(shown, size, to_unit)
        shown = convert(shown)
    if renderer == "exact":
        raise LimitError("the exact renderer draws drawings; give the drawing, or use cpu or gpu for a texture")
    if isinstance(shown, ThesisTexture):
        return _render_thesis(shown, size, to_unit, renderer, root, quality)
    return _render_packed(shown, size, to_unit, renderer, find_root(shown, root), quality)


def render_layers(
    texture_or_drawing: "Shown",
    size: tuple[int, int],
    to_unit: "ArrayLike | None" = None,
    renderer: str = "gpu",
    *,
    root: str | None = None,
    quality: str = "exact",
) -> "NDArray[np.float32]":
    """Render a drawing in its flat colours: its layers one over the other.

    Parameters
    ----------
    texture_or_drawing : PackedTexture, ThesisTexture or Drawing
        A texture that was split by paint, or a drawing, of which the layers are drawn. A shape without paint is
        black.
    root : str, optional
        Which drawing of an atlas: what stands before ``/layer`` in the names of its roots. Not needed if there is
        only one.
    size, to_unit, renderer, quality
        As in `vexture.render`.

    Returns
    -------
    (height, width, 4) float32 array
        sRGB and opacity, 0..1, **premultiplied**, top row first: ``image[..., :3] + 1 - image[..., 3:]`` is the
        picture on white.

    Raises
    ------
    LimitError, FormatError, DeviceError
        As in `vexture.render`.

    Examples
    --------
    >>> from vexture.drawing import Drawing, Paint, Path
    >>> half = Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)]).paths[0].contours
    >>> red = Drawing((Path(half, paint=Paint((1.0, 0.0, 0.0), 0.5)),))
    >>> render_layers(red, (2, 1), [[0.5, 0, 0], [0, -1, 1]], renderer="exact")
    array([[[0.5, 0. , 0. , 0.5],
            [0. , 0. , 0. , 0. ]]], dtype=float32)
    """
    _check(renderer, quality)
    import numpy as np

    from vexture.drawing import Drawing, Paint
    from vexture.encoding import PackedTexture
    from vexture.render.view import check_size

    width, height = check_size(size)
    picture = np.zeros((height, width, 4), np.float32)
    shown = texture_or_drawing
    if isinstance(shown, Drawing):
        if root is not None:
            raise LimitError(f"root={root!r} chooses a drawing of a texture; leave root out")
        if renderer == "exact" or not shown.paths:
            for layer in shown.layers():
                _put_over(picture, render(layer, size, to_unit, renderer), layer.paths[0].paint)
            return picture
        shown = convert(shown, split="paint")
    if isinstance(shown, PackedTexture):
        for place in layers_of(shown, root):
            coverage = render(shown, size, to_unit, renderer, root=place, quality=quality)
            _put_over(picture, coverage, shown.roots[place].paint or Paint())
    else:
        _put_over(picture, render(shown, size, to_unit, renderer, root=root, quality=quality), Paint())
    return picture


def on_white(
    texture_or_drawing: "Shown",
    size: tuple[int, int],
    to_unit: "ArrayLike | None" = None,
    renderer: str = "gpu",
    *,
    root: str | None = None,
    quality: str = "exact",
    split: str | None = None,
) -> "NDArray[np.float32]":
    """Render what a person wants to see first: flat colours where there are some, else a black shape, on white.

    Parameters
    ----------
    texture_or_drawing, size, to_unit, renderer, quality
        As in `vexture.render`.
    root : str, optional
        Name or number of a shape, which is drawn black, or name of a drawing whose layers a texture holds.
    split : str, optional
        ``"paint"`` draws a drawing in its colours.

    Returns
    -------
    (height, width) or (height, width, 3) float32 array
        Grey or sRGB, 0..1, top row first.

    Raises
    ------
    LimitError, FormatError, DeviceError
        As in `vexture.render`.
    """
    from vexture.encoding import PackedTexture

    shown, shape, coloured = texture_or_drawing, None, split is not None
    if isinstance(shown, PackedTexture):
        numbers = {str(place): place for place in range(len(shown.roots))}
        names = {found.name: place for place, found in enumerate(shown.roots)}
        shape = None if root is None else names.get(root, numbers.get(root))
        if shape is None:
            places = layers_of(shown, root)
            coloured = any(shown.roots[place].paint is not None for place in places)
            shape = places[0]
    elif root is not None:
        raise LimitError(f"--root {root} chooses a shape of a packed texture; leave it out, or use --select for an SVG")
    if coloured:
        image = render_layers(shown, size, to_unit, renderer, root=root, quality=quality)
        return image[..., :3] + (1.0 - image[..., 3:])
    return 1.0 - render(shown, size, to_unit, renderer, root=shape, quality=quality)


def find_root(texture: "PackedTexture", root: str | int | None) -> int:
    """Place in `roots` of the shape that a name or a number means, or of the only one.

    Raises
    ------
    FormatError
        If there is none.
    LimitError
        If none is named and there are several.
    """
    if root is not None:
        return texture.roots.index(texture.root(root))
    if len(texture.roots) > 1:
        names = _listed([shape.name for shape in texture.roots])
        raise LimitError(f"{texture.name} holds {len(texture.roots)} shapes ({names}); choose one by root (--root)")
    return 0


def layers_of(texture: "PackedTexture", drawing: str | None = None) -> list[int]:
    """Places in `roots` of the layers of one drawing, in painting order.

    Parameters
    ----------
    texture : PackedTexture
        Of one drawing or an atlas of many.
    drawing : str, optional
        What stands before ``/layer`` in the names of painted roots, or the whole name of a root without paint. Not
        needed if there is only one.

    Raises
    ------
    LimitError
        If there is no such drawing, or none is named and there are several.
    """
    owners = [_owner(root) for root in texture.roots]
    different = list(dict.fromkeys(owners))
    if drawing is None:
        if len(different) > 1:
            raise LimitError(
                f"{texture.name} holds {len(different)} drawings ({_listed(different)}); choose one by root (--root)"
            )
        return list(range(len(owners)))
    if drawing not in different:
        raise LimitError(f"{texture.name} has no drawing {drawing!r}; it has {_listed(different)}")
    return [place for place, owner in enumerate(owners) if owner == drawing]


def _owner(root: "Root") -> str:
    """Name of the drawing that a shape is, or is a layer of."""
    return root.name if root.paint is None else root.name.rpartition("/")[0] or root.name


def _listed(names: list[str]) -> str:
    listed = ", ".join(name[:60] for name in names[:MOST_NAMED])
    return listed + (f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else "")


def _check(renderer: str, quality: str) -> None:
    if renderer not in RENDERERS:
        raise LimitError(f"renderer is {renderer!r}; it must be one of {', '.join(RENDERERS)}")
    if quality not in QUALITIES:
        raise LimitError(f"quality is {quality!r}; it must be one of {', '.join(QUALITIES)}")
    if renderer == "exact" and quality != "exact":
        raise LimitError(f"the exact renderer knows no quality {quality!r}; use cpu or gpu for it")


def _put_over(picture: "NDArray[np.float32]", coverage: "NDArray[np.float32]", paint: "Paint") -> None:
    """Lay a flat colour over a premultiplied picture, in place."""
    import numpy as np

    alpha = coverage[..., None] * np.float32(paint.opacity)
    picture *= 1.0 - alpha
    picture += alpha * np.array((*paint.color, 1.0), np.float32)


def _render_thesis(
    texture: "ThesisTexture",
    size: tuple[int, int],
    to_unit: "ArrayLike | None",
    renderer: str,
    root: str | int | None,
    quality: str,
) -> "NDArray[np.float32]":
    if root not in (None, 0, texture.name):
        raise LimitError(f"{texture.name} has no root {root!r}; a thesis texture is one shape, leave root out")
    if quality != "exact":
        raise LimitError(f"a thesis texture knows no quality {quality!r}; convert with the encoding packed for it")
    if renderer == "cpu":
        from vexture.render.cpu import render_cpu

        return render_cpu(texture, size, to_unit)
    from vexture.render.gpu import render_gpu

    return render_gpu(texture, size, to_unit)


def _render_packed(
    texture: "PackedTexture",
    size: tuple[int, int],
    to_unit: "ArrayLike | None",
    renderer: str,
    root: int,
    quality: str,
) -> "NDArray[np.float32]":
    if renderer == "cpu":
        from vexture.render.packed_cpu import render_packed_cpu

        return render_packed_cpu(texture, size, to_unit, root=root, quality=quality)
    from vexture.render.packed_gpu import render_packed_gpu

    return render_packed_gpu(texture, size, to_unit, root=root, quality=quality)
