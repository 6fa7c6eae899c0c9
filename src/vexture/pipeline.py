"""From a source to a texture: the arrows of the architecture, one after the other."""

import os
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from vexture.errors import LimitError

if TYPE_CHECKING:  # at run time they come with the first conversion: numba and lxml take their time
    from vexture.drawing import Drawing
    from vexture.encoding.texture import ThesisTexture
    from vexture.quadtree.tree import CellTree

__all__ = ["Conversion", "convert", "run"]


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
    from vexture.encoding import encode
    from vexture.quadtree.build import DEFAULT_DEPTH, build
    from vexture.sources.svg import read_svg

    if encoding != "thesis":
        raise LimitError(f"encoding {encoding!r} is not known; use thesis")
    start = time.perf_counter()
    drawing = source if isinstance(source, Drawing) else read_svg(source)
    tree = build(drawing, tolerance, DEFAULT_DEPTH if max_depth is None else max_depth, strategy)
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
    (2, 8)
    """
    return run(
        source, encoding=encoding, bits=bits, strategy=strategy, tolerance=tolerance, max_depth=max_depth
    ).texture
