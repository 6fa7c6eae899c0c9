"""Pictures of one shape of a texture, by the selected renderer."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.renderers.uniforms import HasTexels
from vexture.renderers.view import Size, ViewLike
from vexture.texture.registry import TextureRenderer


def coverage_of(
    texture: HasTexels, place: int, is_map: bool, size: Size, view: ViewLike, renderer: TextureRenderer
) -> NDArray[np.float32]:
    """Part of each pixel that shape number `place` covers, (height, width)."""
    if is_map:
        return colours_of(texture, place, size, view, renderer)[..., 3]
    if renderer == "cpu":
        from vexture.renderers.cpu import render_cpu  # late: compiled code, not needed for reading

        return render_cpu(texture, size, view, root=place)
    _refuse_other(renderer)
    from vexture.renderers.gpu import render_gpu

    return render_gpu(texture, size, view, root=place)


def colours_of(
    texture: HasTexels, place: int, size: Size, view: ViewLike, renderer: TextureRenderer
) -> NDArray[np.float32]:
    """Picture of planar map number `place`, (height, width, 4), premultiplied."""
    if renderer == "cpu":
        from vexture.renderers.colour import render_cpu_colours  # late: compiled code, not needed for reading

        return render_cpu_colours(texture, size, view, root=place)
    _refuse_other(renderer)
    from vexture.renderers.gpu import render_gpu_colours

    return render_gpu_colours(texture, size, view, root=place)


def _refuse_other(renderer: str) -> None:
    if renderer != "gpu":
        raise ParameterError(f"`renderer` is {renderer!r}; a texture is rendered by 'cpu' or 'gpu'")
