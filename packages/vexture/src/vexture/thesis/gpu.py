"""Render a texture of the thesis's encoding with its shader on the GPU, without a window."""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.renderers.device import ONE_AT_A_TIME, VERSION, compile_shader, context, draw, upload
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix
from vexture.thesis.shader_text import TextureSizes, ThesisPair, view_source


@lru_cache(maxsize=64)
def program(sizes: TextureSizes) -> Any:
    """Compiled shader, with its triangle, for all textures with the same sizes."""
    return compile_shader(view_source(VERSION, sizes))


def fold(rows: NDArray[Any], height: int) -> NDArray[np.float32]:
    """Arrange a list as a texture of at most `height` rows; row r goes to row r % height in block r // height.

    `rows` is a (rows, width, 3) array, uint8 or uint16. The result is (min(rows, height), blocks * width, 4), float32
    in 0..1; unused values are 0.
    """
    count, width, channels = rows.shape
    blocks = -(-count // height)
    height = min(count, height)
    padded = np.zeros((blocks * height, width, 4), np.float32)
    padded[:count, :, :channels] = rows / np.float32(np.iinfo(rows.dtype).max)
    return padded.reshape(blocks, height, width, 4).swapaxes(0, 1).reshape(height, -1, 4)


def render_thesis_gpu(
    texture: ThesisPair, size: Size, view: ViewLike = None, fold_height: int | None = None
) -> NDArray[np.float32]:
    """Render a texture with the thesis's shader; parameters as in `vexture.coverage`.

    The lists are folded at `fold_height` rows; None folds them at the device's limit. Raises a `FormatError` if the
    texture's quads do not form a tree, a `DeviceError` without OpenGL, and a `LimitError` if the device cannot draw
    such a large image.
    """
    width, height = size_of(size)
    matrix = view_matrix(view, (width, height))
    with ONE_AT_A_TIME, context() as gl:
        sizes = TextureSizes.of_texture(texture, fold_height or gl.info["GL_MAX_TEXTURE_SIZE"])
        triangle = program(sizes)
        lists = []
        for unit, (name, rows) in enumerate((("quads", texture.quads), ("curves", texture.curves))):
            lists.append(upload(gl, fold(rows, sizes.fold_height), unit, "f4"))
            triangle.program[name] = unit
        triangle.program["list_lengths"] = (len(texture.quads), len(texture.curves))
        triangle.program["to_unit"].write(matrix.T.astype(np.float32).tobytes())
        pixels = draw(gl, triangle, (width, height))[..., 0]
        for uploaded in lists:
            uploaded.release()
    return pixels
