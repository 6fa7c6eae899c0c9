"""Access to OpenGL 3.3 without a window, through EGL."""

import threading
from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import DeviceError, LimitError
from vexture.renderers.shader import vertex_source

VERSION: Final = "330"

ONE_AT_A_TIME: Final = threading.Lock()
"""Lock on the OpenGL context, which can be current in only one thread."""


@cache
def context() -> Any:
    """OpenGL context of the process, made on first use; raises a `DeviceError` if moderngl or a driver is missing."""
    try:
        import moderngl
    except ImportError:
        raise DeviceError(
            "the gpu renderer needs the package moderngl: pip install 'vexture[gpu]', or use `renderer` cpu"
        ) from None
    try:
        # its stubs take **settings for one dictionary each
        gl = moderngl.create_standalone_context(require=330, backend="egl")  # type: ignore[arg-type]
    except Exception as error:  # moderngl raises plain Exceptions
        reason = " ".join(str(error).split())
        raise DeviceError(
            f"no OpenGL 3.3 context without a window ({reason}); install a driver (Debian: libegl1 libgl1 "
            "libgl1-mesa-dri), or use `renderer` cpu"
        ) from None
    gl.gc_mode = "auto"  # a program that leaves the cache is released
    with gl:
        pass  # releases the context from this thread, so that any thread may use it
    return gl


def compile_shader(fragment_source: str) -> Any:
    """Compile a fragment shader with a triangle that covers the image; raise a `DeviceError` on failure."""
    gl = context()
    try:
        program = gl.program(vertex_shader=vertex_source(VERSION), fragment_shader=fragment_source)
    except Exception as error:  # moderngl's own class is not to be imported before the context
        reason = " ".join(str(error).split())[:200]
        raise DeviceError(
            f"the OpenGL driver refuses the shader ({reason}); update it, or use `renderer` cpu"
        ) from None
    return gl.vertex_array(program, [])


def upload(gl: Any, pixels: NDArray[Any], unit: int, dtype: str) -> Any:
    """Upload an array (rows, width, 4) as a texture without filtering, and bind it to a texture unit.

    Raises a `DeviceError` if the driver does not support such textures, because it would draw wrong pictures.
    """
    _ = gl.error  # reading it clears earlier errors
    texture = gl.texture(pixels.shape[1::-1], 4, np.ascontiguousarray(pixels).tobytes(), dtype=dtype)
    if (error := gl.error) != "GL_NO_ERROR":
        raise DeviceError(f"the OpenGL driver takes no such texture ({error}); update it, or use `renderer` cpu")
    texture.filter = (gl.NEAREST, gl.NEAREST)
    texture.use(unit)
    return texture


def draw(gl: Any, triangle: Any, size: tuple[int, int], channels: int = 1) -> NDArray[np.float32]:
    """Draw with a compiled shader whose uniforms are set; return (height, width, channels), top row first."""
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
    for resource in (target, image):
        resource.release()
    return pixels
