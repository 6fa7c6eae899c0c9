"""The packed texture's shader on the GPU, without a window."""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.renderers.device import ONE_AT_A_TIME, VERSION, compiled, context, draw
from vexture.renderers.shader import view_source
from vexture.renderers.texels import Texels, asked_of
from vexture.renderers.view import Size, ViewLike, size_of, view_base, view_matrix

__all__ = ["render_gpu"]


@cache
def program(quality: str) -> Any:
    """Compiled shader of one quality, for all packed textures, with its triangle."""
    return compiled(view_source(VERSION, quality))


def render_gpu(
    texture: Texels,
    size: Size,
    view: ViewLike = None,
    *,
    root: int = 0,
    quality: str = "exact",
    base: tuple[int, int] | None = None,
) -> NDArray[np.float32]:
    """Render one shape of a packed texture.

    Parameters
    ----------
    texture : Texels
        What to draw: a `vexture.Texture`.
    size : int or tuple of int
        Width and height of the image in pixels.
    view : (2, 3) or (3, 3) array, View or None
        From pixel coordinates (x right, y down, centres at +0.5) to the unit square; None fits the square.
    root : int
        Place of the shape in the texture, from 0.
    quality : str
        ``"exact"`` or ``"fast"`` (`vexture.renderers.shader.shader_source`).
    base : tuple of int, optional
        Point that the shader's positions are relative to, 1.0 = 2^32; `view_base` if not given.

    Returns
    -------
    (height, width) float32 array
        Coverage, 0..1, top row first.

    Raises
    ------
    DeviceError
        If there is no OpenGL.
    LimitError
        If the image is larger than the device allows.
    ParameterError
        If an argument is out of range.
    """
    width, height = size_of(size)
    matrix = view_matrix(view, (width, height))
    quad, _ = asked_of(texture, root, quality)
    base = view_base(matrix, (width, height)) if base is None else base
    relative = matrix.copy()
    relative[:2] -= np.outer(base, matrix[2]) / 2.0**32
    with ONE_AT_A_TIME, context() as gl:
        triangle = program(quality)
        rows, columns = texture.texels.shape[:2]
        uploaded = gl.texture((columns, rows), 4, np.ascontiguousarray(texture.texels).tobytes(), dtype="u4")
        uploaded.filter = (gl.NEAREST, gl.NEAREST)
        uploaded.use(0)
        triangle.program["vextureTexels"] = 0
        triangle.program["to_unit"].write(relative.T.astype(np.float32).tobytes())
        triangle.program["base"] = base
        triangle.program["root"] = quad
        pixels = draw(gl, triangle, (width, height))
        uploaded.release()
    return pixels
