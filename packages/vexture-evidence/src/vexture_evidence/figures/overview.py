"""A drawing with the cells, texels and picture of each of its textures, and a summary of one texture."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture.renderers.cpu import render_cpu
from vexture.renderers.exact import render_exact
from vexture.texture.texture import Texture
from vexture.thesis.cpu import render_thesis_cpu
from vexture.thesis.texture import ThesisTexture
from vexture_evidence.figures.cells import add_scale, draw_cells, draw_level_lines
from vexture_evidence.figures.style import COLOURS, INK, panels, show, unit_axes
from vexture_evidence.figures.textures import draw_texture
from vexture_evidence.measures.leaves import leaves
from vexture_evidence.measures.metrics import errors
from vexture_evidence.measures.shape import file_bytes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIDE: Final = 256
"""Side of the pictures in pixels."""


def picture_error(
    drawing: Drawing, texture: ThesisTexture | Texture, size: int = SIDE
) -> tuple[NDArray[np.float32], float]:
    """Render the whole unit square from a texture; return the picture and its mean error in 1/255.

    Examples
    --------
    >>> import vexture
    >>> half = Drawing.polygon([(0, 0), (1, 0), (0, 1)])
    >>> picture_error(half, vexture.convert(half), 8)[1] < 0.1
    True
    """
    image = _picture(texture, size)
    return image, errors(image, render_exact(drawing, (size, size))).mae


def overview(drawing: Drawing, textures: Mapping[str, ThesisTexture | Texture], *, size: int = SIDE) -> "Figure":
    """Show a drawing, the cells and texels of each of its textures, and a picture from the last texture.

    This picture is at the bottom left, made by the renderer on the CPU. The errors compare such pictures with the
    exact coverage: the mean over the pixels that the shape touches.

    Parameters
    ----------
    drawing : Drawing
    textures : mapping
        From titles to textures; at least one. If a title is the name of a method, its curves have the method's colour.
    size : int
        Side of the pictures in pixels.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.shape import example
    >>> duck = vexture.read_svg(example("duck"))
    >>> figure = overview(duck, {"packed": vexture.convert(duck)})
    >>> figure.axes[0].get_title(loc="left")
    'drawing: 21 segments'
    """
    found = [leaves(texture) for texture in textures.values()]
    drawn = [picture_error(drawing, texture, size) for texture in textures.values()]
    titles = [
        f"drawing: {drawing.segments:,} segments",
        *(f"{title}: {len(cells.x):,} cells" for title, cells in zip(textures, found, strict=True)),
        f"picture from {[*textures][-1]}",
        *(
            f"{file_bytes(texture):,} bytes, error {error:.2g}"
            for texture, (_, error) in zip(textures.values(), drawn, strict=True)
        ),
    ]
    columns = 1 + len(textures)
    figure, axes = panels(2, columns, side=11.2 / max(columns, 4), height=2.35, titles=titles)
    axes[0, 0].get_gridspec().set_height_ratios([1.35, 1.0])
    show(axes[0, 0], render_exact(drawing, (size, size)), interpolation="auto")
    show(axes[1, 0], drawn[-1][0], interpolation="auto")
    for (title, texture), leaf, cells, texels in zip(textures.items(), found, *axes[:, 1:], strict=True):
        colour = COLOURS.get(title, INK)
        draw_cells(cells, leaf, colour=colour)
        if isinstance(texture, Texture):
            draw_level_lines(cells, texture, colour=colour)
        unit_axes(cells, ticks=False)
        draw_texture(texels, texture)
    return figure


def summary(texture: ThesisTexture | Texture, *, root: str | int | None = None, size: int = SIDE) -> "Figure":
    """Show a texture: the depth of its cells with their curves, the coverage of its cells, and its picture.

    Parameters
    ----------
    texture : ThesisTexture or Texture
    root : str or int, optional
        Name or place of the shape in a packed texture; not needed if there is only one.
    size : int
        Side of the picture in pixels.

    Returns
    -------
    matplotlib.figure.Figure
        Shows itself as the last value of a notebook's cell.

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.shape import example
    >>> [axes.get_title(loc="left") for axes in summary(vexture.convert(example("holes"))).axes[:3]]
    ['cells', 'coverage', 'picture']
    """
    found = leaves(texture, root)
    figure, axes = panels(1, 3, side=3.7, height=3.1, titles=("cells", "coverage", "picture"))
    add_scale(figure, axes[0, 0], draw_cells(axes[0, 0], found, shades="depth"), "depth")
    add_scale(figure, axes[0, 1], draw_cells(axes[0, 1], found, curves=False), "coverage")
    if isinstance(texture, Texture):
        draw_level_lines(axes[0, 0], texture, root)
        if len(texture.roots) > 1:
            axes[0, 2].set_title(f"picture of {texture.root(root).name}", loc="left")
    show(axes[0, 2], _picture(texture, size, root))
    return figure


def _picture(texture: ThesisTexture | Texture, size: int, root: str | int | None = None) -> NDArray[np.float32]:
    """Picture of the unit square by the renderer on the CPU."""
    if isinstance(texture, Texture):
        return render_cpu(texture, (size, size), root=texture.roots.index(texture.root(root)))
    return render_thesis_cpu(texture, (size, size))
