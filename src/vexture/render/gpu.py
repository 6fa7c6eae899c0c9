"""The thesis's shader on the GPU, without a window (OpenGL 3.3 through EGL)."""

import threading
from functools import cache, lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.encoding.texture import ThesisTexture
from vexture.errors import DeviceError, LimitError
from vexture.render.view import check_size, view_matrix
from vexture.shaders import TextureSizes, vertex_source, view_source

__all__ = ["ONE_AT_A_TIME", "VERSION", "compiled", "context", "draw", "fold", "render_gpu"]

VERSION: Final = "330"

ONE_AT_A_TIME: Final = threading.Lock()
"""A context can be current in one thread only."""


@cache
def context() -> Any:
    """Return the process's OpenGL context, made when it is first needed.

    Raises
    ------
    DeviceError
        If moderngl or a driver is missing.
    """
    try:
        import moderngl
    except ImportError:
        raise DeviceError(
            "the gpu renderer needs the package moderngl: pip install vexture[gpu], or use --renderer cpu"
        ) from None
    try:
        # its stubs take **settings for one dictionary each
        made = moderngl.create_standalone_context(require=330, backend="egl")  # type: ignore[arg-type]
    except Exception as error:  # moderngl raises plain Exceptions
        reason = " ".join(str(error).split())
        raise DeviceError(
            f"no OpenGL 3.3 context without a window ({reason}); install a driver (Debian: libegl1 libgl1 "
            "libgl1-mesa-dri), or use --renderer cpu"
        ) from None
    made.gc_mode = "auto"  # a program that leaves the cache is released
    with made:
        pass  # leaves it current in no thread, so that any may use it
    return made


@lru_cache(maxsize=64)
def program(sizes: TextureSizes) -> Any:
    """Compiled shader for all textures of some sizes, with its triangle."""
    return compiled(view_source(VERSION, sizes))


def compiled(fragment_source: str) -> Any:
    """Compile a fragment shader; what is returned draws it on a triangle that covers the image.

    Raises
    ------
    DeviceError
        If the driver refuses it.
    """
    gl = context()
    try:
        made = gl.program(vertex_shader=vertex_source(VERSION), fragment_shader=fragment_source)
    except Exception as error:  # moderngl's own class is not to be imported before the context
        reason = " ".join(str(error).split())[:200]
        raise DeviceError(
            f"the OpenGL driver refuses the shader ({reason}); update it, or use --renderer cpu"
        ) from None
    return gl.vertex_array(made, [])


def draw(gl: Any, triangle: Any, size: tuple[int, int]) -> NDArray[np.float32]:
    """Draw a compiled shader whose uniforms are set, (height, width); its first row is the image's top."""
    width, height = size
    limit = gl.info["GL_MAX_TEXTURE_SIZE"]
    if max(width, height) > limit:
        raise LimitError(f"size is {width} x {height}; this device draws up to {limit}, give a smaller --size")
    image = gl.texture((width, height), 1, dtype="f4")
    target = gl.framebuffer([image])
    target.use()
    triangle.render(vertices=3)
    pixels = np.frombuffer(target.read(components=1, dtype="f4"), np.float32).reshape(height, width).copy()
    for made in (target, image):
        made.release()
    return pixels


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


def render_gpu(
    texture: ThesisTexture, size: tuple[int, int], to_unit: ArrayLike | None = None, fold_height: int | None = None
) -> NDArray[np.float32]:
    """Render a texture by the thesis's shader.

    Parameters
    ----------
    texture : ThesisTexture
        What to draw.
    size : tuple of int
        Width and height of the image in pixels.
    to_unit : (2, 3) or (3, 3) array, optional
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
    size = check_size(size)
    matrix = view_matrix(to_unit, size)
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
        pixels = draw(gl, triangle, size)
        for uploaded in lists:
            uploaded.release()
    return pixels
