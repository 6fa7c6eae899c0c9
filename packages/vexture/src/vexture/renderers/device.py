"""OpenGL 3.3 without a window, through EGL."""

import threading
from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import DeviceError, LimitError
from vexture.renderers.shader import vertex_source

VERSION: Final = "330"

ONE_AT_A_TIME: Final = threading.Lock()
"""A context can be current in one thread only."""


@cache
def context() -> Any:
    """The process's OpenGL context, made on first use. Raises `DeviceError` if moderngl or a driver is missing."""
    try:
        import moderngl
    except ImportError:
        raise DeviceError(
            "the gpu renderer needs the package moderngl: pip install 'vexture[gpu]', or use `renderer` cpu"
        ) from None
    try:
        # its stubs take **settings for one dictionary each
        made = moderngl.create_standalone_context(require=330, backend="egl")  # type: ignore[arg-type]
    except Exception as error:  # moderngl raises plain Exceptions
        reason = " ".join(str(error).split())
        raise DeviceError(
            f"no OpenGL 3.3 context without a window ({reason}); install a driver (Debian: libegl1 libgl1 "
            "libgl1-mesa-dri), or use `renderer` cpu"
        ) from None
    made.gc_mode = "auto"  # a program that leaves the cache is released
    with made:
        pass  # leaves it current in no thread, so that any may use it
    return made


def compile_shader(fragment_source: str) -> Any:
    """Compile a fragment shader with a triangle that covers the image. Raises `DeviceError` on failure."""
    gl = context()
    try:
        made = gl.program(vertex_shader=vertex_source(VERSION), fragment_shader=fragment_source)
    except Exception as error:  # moderngl's own class is not to be imported before the context
        reason = " ".join(str(error).split())[:200]
        raise DeviceError(
            f"the OpenGL driver refuses the shader ({reason}); update it, or use `renderer` cpu"
        ) from None
    return gl.vertex_array(made, [])


def upload(gl: Any, pixels: NDArray[Any], unit: int, dtype: str) -> Any:
    """Texture of an array, (rows, width, 4), without filtering, bound to a texture unit.

    Raises `DeviceError` if the driver has no such textures: what it would draw is wrong.
    """
    _ = gl.error  # which forgets those of before
    made = gl.texture(pixels.shape[1::-1], 4, np.ascontiguousarray(pixels).tobytes(), dtype=dtype)
    if (error := gl.error) != "GL_NO_ERROR":
        raise DeviceError(f"the OpenGL driver takes no such texture ({error}); update it, or use `renderer` cpu")
    made.filter = (gl.NEAREST, gl.NEAREST)
    made.use(unit)
    return made


def draw(gl: Any, triangle: Any, size: tuple[int, int], channels: int = 1) -> NDArray[np.float32]:
    """Draw a compiled shader whose uniforms are set, (height, width, channels), the image's top row first."""
    width, height = size
    limit = gl.info["GL_MAX_TEXTURE_SIZE"]
    if max(width, height) > limit:
        raise LimitError(f"size is {width} x {height}; this device draws up to {limit}, give a smaller `size`")
    image = gl.texture((width, height), channels, dtype="f4")
    target = gl.framebuffer([image])
    target.use()
    triangle.render(vertices=3)
    read = np.frombuffer(target.read(components=channels, dtype="f4"), np.float32)
    pixels = read.reshape(height, width, channels).copy()
    for made in (target, image):
        made.release()
    return pixels
