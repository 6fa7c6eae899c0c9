"""Renderers: the exact one from a drawing, the mirror on the CPU, the shader on the GPU."""

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.drawing import Drawing
from vexture.encoding.texture import ThesisTexture
from vexture.errors import LimitError

__all__ = ["RENDERERS", "render"]

RENDERERS: Final = ("exact", "cpu", "gpu")
"""From a drawing; from a texture on the CPU, on the GPU."""


def render(
    texture_or_drawing: ThesisTexture | Drawing,
    size: tuple[int, int],
    to_unit: ArrayLike | None = None,
    renderer: str = "gpu",
) -> NDArray[np.float32]:
    """Render a picture.

    Parameters
    ----------
    texture_or_drawing : ThesisTexture or Drawing
        ``"exact"`` draws a drawing; ``"cpu"`` and ``"gpu"`` draw a texture, and convert a drawing with the defaults
        of `vexture.convert` first.
    size : tuple of int
        Width and height of the image in pixels.
    to_unit : (2, 3) or (3, 3) array, optional
        From pixel coordinates (x right, y down, centres at +0.5) to the unit square (y up); None fits the square.
    renderer : str
        ``"exact"``, ``"cpu"`` or ``"gpu"``.

    Returns
    -------
    (height, width) float32 array
        Coverage, 0..1, top row first.

    Raises
    ------
    LimitError
        If the renderer is unknown, "exact" is given a texture, or the size or view is out of range.
    DeviceError
        If there is no GPU.

    Examples
    --------
    >>> full = ThesisTexture(np.zeros((1, 4, 3), np.uint8), np.zeros((2, 2, 3), np.uint8))
    >>> render(full, (2, 1), renderer="cpu")
    array([[0.5, 0.5]], dtype=float32)
    """
    if renderer not in RENDERERS:
        raise LimitError(f"renderer is {renderer!r}; it must be one of {', '.join(RENDERERS)}")
    # imported late: a renderer brings its compiler or its driver with it
    if isinstance(texture_or_drawing, Drawing):
        if renderer == "exact":
            from vexture.render.exact import render_exact

            return render_exact(texture_or_drawing, size, to_unit)
        from vexture.pipeline import convert

        texture_or_drawing = convert(texture_or_drawing)
    if renderer == "exact":
        raise LimitError("the exact renderer draws drawings; give the drawing, or use cpu or gpu for a texture")
    if renderer == "cpu":
        from vexture.render.cpu import render_cpu

        return render_cpu(texture_or_drawing, size, to_unit)
    from vexture.render.gpu import render_gpu

    return render_gpu(texture_or_drawing, size, to_unit)
