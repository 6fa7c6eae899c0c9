"""The encoding of the thesis on which vexture is based: a leaf has one cubic or one corner; a texture is two PNG files.

It is the baseline for comparisons. It is registered by name (`vexture.texture.registry`) with the functions `convert`,
`load` and `owns` of an encoding; nothing else in vexture imports it.
"""

from pathlib import Path
from typing import Final, Literal

from vexture.base.errors import ParameterError
from vexture.drawing.drawing import Drawing
from vexture.texture.registry import Encoded
from vexture.thesis.layout import CURVES_SUFFIX, LIST_LIMIT, QUADS_SUFFIX
from vexture.thesis.texture import ThesisTexture, load, pair_of

__all__ = ["SUFFIXES", "ThesisTexture", "convert", "load", "owns"]

SUFFIXES: Final = (QUADS_SUFFIX, CURVES_SUFFIX)
"""Suffixes of a texture's files."""


def convert(
    drawing: Drawing,
    *,
    tolerance: float | Literal["auto"] = "auto",
    max_depth: int | None = None,
    bits: int | None = None,
    strategy: Literal["direct", "sampled"] | None = None,
) -> Encoded:
    """Convert a drawing's silhouette to a tree and a texture.

    Parameters
    ----------
    drawing : Drawing
    tolerance : float or "auto"
        Largest distance between the drawing's outline and the texture's before rounding, in unit-square units. "auto"
        depends on the smallest detail of the drawing and the size of each cell.
    max_depth : int, optional
        Depth at which cells are not divided further; 10 by default.
    bits : int, optional
        Bits per channel, 8 or 16; 16 by default.
    strategy : str, optional
        ``"direct"``, the default, makes leaves from the drawing's own cubics. ``"sampled"`` samples the outlines and
        fits curves to the samples, as the thesis does.

    Raises
    ------
    ParameterError
        If a parameter is out of range.
    LimitError
        If the tree is too large.

    Examples
    --------
    >>> convert(Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)]), bits=8).texture.quads.shape
    (1, 4, 3)
    """
    from vexture.thesis.build import DEFAULT_DEPTH, build
    from vexture.thesis.encode import encode, quantisation_step

    bits = 16 if bits is None else bits
    if bits not in LIST_LIMIT:
        raise ParameterError(f"`bits` is {bits!r}; it must be 8 or 16")
    depth = DEFAULT_DEPTH if max_depth is None else max_depth
    step = quantisation_step(bits)
    tree = build(drawing, tolerance, depth, strategy or "direct", step, LIST_LIMIT[bits])
    texture = encode(tree, bits, to_source=drawing.to_source, name=drawing.name, crs=drawing.crs)
    return Encoded(tree, texture, tree.widest_leaf * step)


def owns(path: Path) -> bool:
    """Return whether a path names a file of a pair, or the common stem of an existing pair.

    Examples
    --------
    >>> owns(Path("maps/delft.curves.png")), owns(Path("maps/delft.ktx2"))
    (True, False)
    """
    if path.name.lower().endswith((QUADS_SUFFIX, CURVES_SUFFIX)):
        return True
    return not path.is_file() and any(file.is_file() for file in pair_of(path))
