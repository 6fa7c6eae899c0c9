"""What Table 5.1 of the thesis says of a drawing, measured: time, size of the tree, bytes, frames per second."""

from dataclasses import dataclass, field
from typing import Final

from vexture.errors import LimitError
from vexture.pipeline import run
from vexture.texture.texture import Texture
from vexture.thesis.layout import LIST_LIMIT
from vexture_evidence.measures.shape import WAYS, Made, Shape, file_bytes
from vexture_evidence.measures.timing import FRAME, frames_per_second, median_seconds

__all__ = ["Measured", "frame_side", "measured"]

LONG: Final = 0.05
"""Seconds; a conversion that takes longer is timed once."""

REPEAT: Final = 5
"""Conversions, of which the median counts, of those that are shorter."""

SLOW_SIDE: Final = 256
"""Pixels of the side of pictures on devices that draw less than `FAST` frames of a second of them."""

FAST: Final = 1000.0


@dataclass(frozen=True, slots=True)
class Measured:
    """One conversion of one drawing.

    Parameters
    ----------
    curves, quads : int
        Lengths of the two lists, the constants left out.
    depth : int
        Of the smallest leaf.
    ms : float
        From the drawing, read already, to the texture.
    bytes_8, bytes_16 : int or None
        Files of the thesis's pair; None where 8 bits cannot hold the drawing, and for packed textures.
    bytes_packed : int or None
        File of a packed texture.
    fps : float or None
        Frames per second; None without a GPU.
    """

    curves: int
    quads: int
    depth: int
    ms: float
    bytes_8: int | None = None
    bytes_16: int | None = None
    bytes_packed: int | None = None
    fps: float | None = field(default=None)


def frame_side(shape: Shape) -> int:
    """Side of the pictures to measure rates with: what devices are fast enough to draw, 1024 or less.

    Raises
    ------
    DeviceError
        If there is no GPU.
    """
    return FRAME[0] if _rate(shape.way("packed"), SLOW_SIDE) > FAST else SLOW_SIDE


def measured(shape: Shape, way: str, side: int | None = None) -> Measured:
    """Convert a drawing and measure it.

    Parameters
    ----------
    shape : Shape
    way : str
        One of `WAYS`.
    side : int, optional
        Of the pictures to measure the rate of frames with; None leaves it out.

    Raises
    ------
    LimitError
        If the encoding cannot hold the drawing.

    Examples
    --------
    >>> from vexture_evidence.measures.shape import example
    >>> found = measured(Shape(example("duck")), "direct")
    >>> found.quads, found.curves, found.depth
    (16, 38, 5)
    """
    made = shape.way(way)
    texture, tree = made.texture, made.tree
    seconds = made.seconds
    if seconds < LONG:
        given = WAYS[way]
        seconds = median_seconds(lambda: run(shape.drawing, **given), REPEAT)
    fps = None if side is None else _rate(made, side)
    sizes = len(tree.curves), len(tree.coverage), texture.depth + 1, 1e3 * seconds
    if isinstance(texture, Texture):
        return Measured(*sizes, bytes_packed=file_bytes(texture), fps=fps)
    return Measured(*sizes, bytes_8=_bytes_8(shape, way), bytes_16=file_bytes(texture), fps=fps)


def _bytes_8(shape: Shape, way: str) -> int | None:
    """Size of the files of 8 bits, which are not tried where the tree of 16 bits is far beyond them."""
    if len(shape.way(way).tree.coverage) > 2 * LIST_LIMIT[8]:
        return None
    try:
        return file_bytes(shape.way(way, 8).texture)
    except LimitError:
        return None


def _rate(made: Made, side: int) -> float:
    from vexture_evidence.measures.programs import packed_program, thesis_program

    texture = made.texture
    program = packed_program(texture, "exact") if isinstance(texture, Texture) else thesis_program(texture)
    return frames_per_second(program, (side, side))
