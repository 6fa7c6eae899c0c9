"""From a source to a texture to pixels: the arrows of the architecture, one after the other."""

import os
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Literal

from vexture.errors import LimitError

if TYPE_CHECKING:  # at run time they come when they are needed: compiler, parser and driver take their time
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from vexture.drawing import Drawing
    from vexture.encoding.texture import ThesisTexture
    from vexture.quadtree.tree import CellTree

__all__ = ["RENDERERS", "Conversion", "convert", "render", "run"]

RENDERERS: Final = ("exact", "cpu", "gpu")
"""From a drawing; from a texture on the CPU, on the GPU."""


@dataclass(frozen=True, slots=True, eq=False)
class Conversion:
    """What a conversion went through.

    Parameters
    ----------
    drawing : Drawing
        What was read.
    tree : CellTree
        What it became.
    texture : ThesisTexture
        What is saved.
    seconds : float
        Time from the source to the texture.
    """

    drawing: "Drawing"
    tree: "CellTree"
    texture: "ThesisTexture"
    seconds: float


def run(
    source: "Drawing | str | os.PathLike[str]",
    *,
    encoding: str = "thesis",
    bits: int = 16,
    strategy: Literal["direct", "sampled"] = "direct",
    tolerance: float | Literal["auto"] = "auto",
    max_depth: int | None = None,
) -> Conversion:
    """Convert and keep what lies between; see `convert`."""
    from vexture.drawing import Drawing
    from vexture.encoding import encode, quantisation_step
    from vexture.encoding.layout import LIST_LIMIT
    from vexture.quadtree.build import DEFAULT_DEPTH, build
    from vexture.sources.svg import read_svg

    if encoding != "thesis":
        raise LimitError(f"encoding {encoding!r} is not known; use thesis")
    start = time.perf_counter()
    drawing = source if isinstance(source, Drawing) else read_svg(source)
    if bits not in LIST_LIMIT:
        raise LimitError(f"{bits!r} bits; a texture has 8 or 16")
    depth = DEFAULT_DEPTH if max_depth is None else max_depth
    tree = build(drawing, tolerance, depth, strategy, quantisation_step(bits), LIST_LIMIT[bits])
    texture = encode(tree, bits, to_source=drawing.to_source, name=drawing.name)
    return Conversion(drawing, tree, texture, time.perf_counter() - start)


def convert(
    source: "Drawing | str | os.PathLike[str]",
    *,
    encoding: str = "thesis",
    bits: int = 16,
    strategy: Literal["direct", "sampled"] = "direct",
    tolerance: float | Literal["auto"] = "auto",
    max_depth: int | None = None,
) -> "ThesisTexture":
    """Turn a drawing into a texture.

    Parameters
    ----------
    source : Drawing or path
        A drawing, or a file that `vexture.read_svg` reads.
    encoding : str
        ``"thesis"``.
    bits : int
        Bits per channel, 8 or 16.
    strategy : str
        ``"direct"`` takes leaves from the drawing's own cubics, ``"sampled"`` samples and fits as the thesis does.
    tolerance : float or "auto"
        Largest distance between the drawing's outline and the texture's before quantisation, in unit-square units;
        "auto" follows the smallest detail of the drawing and the size of each cell.
    max_depth : int, optional
        Cells of this depth are not divided further.

    Returns
    -------
    ThesisTexture

    Raises
    ------
    SourceError
        If the drawing cannot be read.
    LimitError
        If a parameter is out of range, or a list is too long for the bits.

    Examples
    --------
    >>> from vexture.drawing import Drawing
    >>> triangle = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)])
    >>> texture = convert(triangle, bits=8)
    >>> texture.quads.shape[0], texture.bits
    (1, 8)
    """
    return run(
        source, encoding=encoding, bits=bits, strategy=strategy, tolerance=tolerance, max_depth=max_depth
    ).texture


def render(
    texture_or_drawing: "ThesisTexture | Drawing",
    size: tuple[int, int],
    to_unit: "ArrayLike | None" = None,
    renderer: str = "gpu",
) -> "NDArray[np.float32]":
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
    >>> import numpy as np
    >>> from vexture.encoding import ThesisTexture
    >>> full = ThesisTexture(np.zeros((1, 4, 3), np.uint8), np.zeros((2, 2, 3), np.uint8))
    >>> render(full, (2, 1), renderer="cpu")
    array([[0.5, 0.5]], dtype=float32)
    """
    if renderer not in RENDERERS:
        raise LimitError(f"renderer is {renderer!r}; it must be one of {', '.join(RENDERERS)}")
    from vexture.drawing import Drawing

    if isinstance(texture_or_drawing, Drawing):
        if renderer == "exact":
            from vexture.render.exact import render_exact

            return render_exact(texture_or_drawing, size, to_unit)
        texture_or_drawing = convert(texture_or_drawing)
    if renderer == "exact":
        raise LimitError("the exact renderer draws drawings; give the drawing, or use cpu or gpu for a texture")
    if renderer == "cpu":
        from vexture.render.cpu import render_cpu

        return render_cpu(texture_or_drawing, size, to_unit)
    from vexture.render.gpu import render_gpu

    return render_gpu(texture_or_drawing, size, to_unit)
