"""The thesis's shader on the GPU, without a window."""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.renderers.device import ONE_AT_A_TIME, VERSION, compiled, context, draw
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix
from vexture.thesis.shader import Pair, TextureSizes, view_source

__all__ = ["fold", "render_thesis_gpu"]


@lru_cache(maxsize=64)
def program(sizes: TextureSizes) -> Any:
    """Compiled shader for all textures of some sizes, with its triangle."""
    return compiled(view_source(VERSION, sizes))


def fold(rows: NDArray[Any], height: int) -> NDArray[np.float32]:
    """Lay a list out as a texture no higher than a limit; row r goes to row r % height, in block r // height.

    Parameters
    ----------
    rows : (rows, width, 3) uint8 or uint16 array
        One list of a texture.
    height : int
        Largest number of rows.

    Returns
    -------
    (min(rows, height), blocks * width, 4) float32 array
        Its numbers as 0..1, the unused ones 0.

    Examples
    --------
    >>> fold(np.full((5, 4, 3), 255, np.uint8), 2).shape
    (2, 12, 4)
    """
    count, width, channels = rows.shape
    blocks = -(-count // height)
    height = min(count, height)
    padded = np.zeros((blocks * height, width, 4), np.float32)
    padded[:count, :, :channels] = rows / np.float32(np.iinfo(rows.dtype).max)
    return np.ascontiguousarray(padded.reshape(blocks, height, width, 4).swapaxes(0, 1).reshape(height, -1, 4))


def render_thesis_gpu(
    texture: Pair, size: Size, view: ViewLike = None, fold_height: int | None = None
) -> NDArray[np.float32]:
    """Render a texture by the thesis's shader.

    Parameters
    ----------
    texture : Pair
        What to draw.
    size : tuple of int
        Width and height of the image in pixels.
    view : (2, 3) or (3, 3) array, View or None
        From pixel coordinates (x right, y down, centres at +0.5) to the unit square; None fits the square.
    fold_height : int, optional
        Rows at which the lists are folded; the device's own limit if not given.

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
    FormatError
        If the texture's quads do not form a tree.
    """
    width, height = size_of(size)
    matrix = view_matrix(view, (width, height))
    with ONE_AT_A_TIME, context() as gl:
        sizes = TextureSizes.of(texture, fold_height or gl.info["GL_MAX_TEXTURE_SIZE"])
        triangle = program(sizes)
        lists = []
        for unit, (name, rows) in enumerate((("quads", texture.quads), ("curves", texture.curves))):
            pixels = fold(rows, sizes.fold_height)
            uploaded = gl.texture(pixels.shape[1::-1], 4, pixels.tobytes(), dtype="f4")
            uploaded.filter = (gl.NEAREST, gl.NEAREST)
            uploaded.use(unit)
            triangle.program[name] = unit
            lists.append(uploaded)
        triangle.program["list_lengths"] = (len(texture.quads), len(texture.curves))
        triangle.program["to_unit"].write(matrix.T.astype(np.float32).tobytes())
        pixels = draw(gl, triangle, (width, height))
        for uploaded in lists:
            uploaded.release()
    return pixels
