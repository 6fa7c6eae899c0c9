"""The columns of Table 5.1 of the thesis, measured: time, size of the tree, bytes, frames per second."""

from dataclasses import dataclass, field
from typing import Final

from vexture.base.errors import LimitError
from vexture.texture.texture import Texture
from vexture.thesis.layout import LIST_LIMIT
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, Made, convert_by, file_bytes
from vexture_evidence.measures.timing import FRAME, frames_per_second, median_seconds

LONG: Final = 0.05
"""Seconds; a conversion that takes longer is timed once."""

REPEAT: Final = 5
"""Number of times that a shorter conversion is timed; the median counts."""

SLOW_SIDE: Final = 256
"""Side in pixels of the pictures on slow devices, which draw at most `FAST` of these a second."""

FAST: Final = 1000.0
"""Frames per second."""


@dataclass(frozen=True, slots=True)
class MeasuredConversion:
    """One conversion of one drawing.

    Parameters
    ----------
    curves, quads : int
        Lengths of the two lists, without the constant rows.
    depth : int
        Depth of the smallest leaf.
    ms : float
        Milliseconds from the drawing, without reading its file, to the texture.
    bytes_8, bytes_16 : int or None
        Size of the thesis's pair of files; None where 8 bits cannot hold the drawing, and for packed textures.
    bytes_packed : int or None
        Size of a packed texture's file.
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


def frame_side(shape: ConvertedDrawing) -> int:
    """Side in pixels of the pictures that frame rates are measured with: smaller on a slow device.

    Raises
    ------
    DeviceError
        If there is no GPU.
    """
    return FRAME[0] if _frame_rate(shape.way("packed"), SLOW_SIDE) > FAST else SLOW_SIDE


def measure_conversion(shape: ConvertedDrawing, way: str, side: int | None = None) -> MeasuredConversion:
    """Convert a drawing and measure it.

    Parameters
    ----------
    shape : ConvertedDrawing
    way : str
        One of `WAYS`.
    side : int, optional
        Side in pixels of the pictures that the frame rate is measured with; None leaves the rate out.

    Raises
    ------
    LimitError
        If the encoding cannot hold the drawing.

    Examples
    --------
    >>> from vexture_evidence.measures.shape import example
    >>> found = measure_conversion(ConvertedDrawing(example("duck")), "direct")
    >>> found.quads, found.curves, found.depth
    (16, 38, 5)
    """
    made = shape.way(way)
    texture, tree = made.texture, made.tree
    seconds = made.seconds
    if seconds < LONG:
        given = WAYS[way]
        seconds = median_seconds(lambda: convert_by(shape.drawing, given), REPEAT)
    fps = None if side is None else _frame_rate(made, side)
    sizes = len(tree.curves), len(tree.coverage), texture.depth + 1, 1e3 * seconds
    if isinstance(texture, Texture):
        return MeasuredConversion(*sizes, bytes_packed=file_bytes(texture), fps=fps)
    return MeasuredConversion(*sizes, bytes_8=_bytes_8(shape, way), bytes_16=file_bytes(texture), fps=fps)


def _bytes_8(shape: ConvertedDrawing, way: str) -> int | None:
    """Size of the 8-bit files; they are not tried if the tree for 16 bits is far too large for them."""
    if len(shape.way(way).tree.coverage) > 2 * LIST_LIMIT[8]:
        return None
    try:
        return file_bytes(shape.way(way, 8).texture)
    except LimitError:
        return None


def _frame_rate(conversion: Made, side: int) -> float:
    from vexture_evidence.measures.programs import packed_program, thesis_program

    texture = conversion.texture
    program = packed_program(texture, is_flat=True) if isinstance(texture, Texture) else thesis_program(texture)
    return frames_per_second(program, (side, side))
