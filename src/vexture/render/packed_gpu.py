"""The packed texture's shader on the GPU, without a window."""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.encoding.packed_texture import PackedTexture
from vexture.errors import LimitError
from vexture.render.gpu import ONE_AT_A_TIME, VERSION, compiled, context, draw
from vexture.render.view import check_size, view_matrix
from vexture.shaders import packed_view_source

__all__ = ["render_packed_gpu", "view_base"]


@cache
def packed_program(quality: str) -> Any:
    """Compiled shader of one quality, for all packed textures, with its triangle."""
    return compiled(packed_view_source(VERSION, quality))


def view_base(matrix: NDArray[np.float64], size: tuple[int, int]) -> tuple[int, int]:
    """Point of the unit square that the image's centre shows, or the nearest one, as 32-bit fixed point.

    Offsets from it are small in a magnified view, so that float32 resolves its pixels.

    Examples
    --------
    >>> view_base(np.diag([0.125, 0.125, 1.0]), (4, 4)) == (1 << 30, 1 << 30)
    True
    """
    u, v, w = matrix @ (size[0] / 2, size[1] / 2, 1.0)
    if w <= 0.0:
        return 0, 0
    scaled = np.clip(np.array([u, v]) / w, 0.0, 1.0) * 2.0**32
    return int(min(scaled[0], 2.0**32 - 1)), int(min(scaled[1], 2.0**32 - 1))


def render_packed_gpu(
    texture: PackedTexture,
    size: tuple[int, int],
    to_unit: ArrayLike | None = None,
    *,
    root: int = 0,
    quality: str = "exact",
    base: tuple[int, int] | None = None,
) -> NDArray[np.float32]:
    """Render one shape of a packed texture.

    Parameters
    ----------
    texture : PackedTexture
        What to draw.
    size : tuple of int
        Width and height of the image in pixels.
    to_unit : (2, 3) or (3, 3) array, optional
        From pixel coordinates (x right, y down, centres at +0.5) to the unit square; None fits the square.
    root : int
        Which of the texture's roots, from 0.
    quality : str
        ``"exact"`` or ``"fast"`` (`vexture.shaders.shader_source`).
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
        If the image is larger than the device allows, or there is no such root or quality.
    """
    size = check_size(size)
    matrix = view_matrix(to_unit, size)
    if not 0 <= root < len(texture.roots):
        raise LimitError(f"root is {root}; {texture.name} has {len(texture.roots)}, numbered from 0")
    base = view_base(matrix, size) if base is None else base
    relative = matrix.copy()
    relative[:2] -= np.outer(base, matrix[2]) / 2.0**32
    with ONE_AT_A_TIME, context() as gl:
        triangle = packed_program(quality)
        rows, width = texture.texels.shape[:2]
        uploaded = gl.texture((width, rows), 4, np.ascontiguousarray(texture.texels).tobytes(), dtype="u4")
        uploaded.filter = (gl.NEAREST, gl.NEAREST)
        uploaded.use(0)
        triangle.program["vextureTexels"] = 0
        triangle.program["to_unit"].write(relative.T.astype(np.float32).tobytes())
        triangle.program["base"] = base
        triangle.program["root"] = texture.roots[root].quad
        pixels = draw(gl, triangle, size)
        uploaded.release()
    return pixels
