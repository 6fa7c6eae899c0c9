"""Methods to store and draw one drawing, compared: bytes of the file, bytes in memory, errors of pictures."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.conversion.images import coverage
from vexture.renderers.view import fit
from vexture_evidence.measures.bands import BANDS, COASTLINE_BANDS, BandTexture, band_texture
from vexture_evidence.measures.closeups import closeup, outline_places
from vexture_evidence.measures.distance import SPREAD, DistanceField, distance_from
from vexture_evidence.measures.metrics import Errors, errors
from vexture_evidence.measures.raster import RasterTexture, mip_sides, raster_from

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing
    from vexture.texture.texture import Texture
    from vexture.thesis.texture import ThesisTexture

WHOLE: Final = 256
SMALL: Final = 16
"""Pixels along a side of the two pictures of the whole drawing."""

SHIFTS: Final = ((0.3, 0.4), (0.8, 0.1), (0.15, 0.65), (0.6, 0.9))
"""Pixels by which these pictures are shifted; without a shift, texels could align with pixels, unlike on a surface."""

MAGNIFICATION: Final = 8
CLOSEUPS: Final = 4
CLOSEUP: Final = 128
"""Close-ups of the outline: their magnification, their number, and their pixels along a side."""

NARROW: Final = 1.0
"""Texels; spread of distance fields for magnified views."""

MANY: Final = 500
"""Curves; a drawing with more of them gets `COASTLINE_BANDS` bands."""

MOST_TEXELS: Final = 1024
"""Most texels along a side of a texture that is compared."""

Draw = Callable[[tuple[int, int], NDArray[np.float64] | None], NDArray[np.float32]]


@dataclass(frozen=True, slots=True, eq=False)
class Rival:
    """One method to store and draw a drawing.

    Parameters
    ----------
    method : str
        Key of `vexture_evidence.figures.style.COLOURS`.
    label : str
    file_bytes, gpu_bytes : int
        Size of the file, or None where no file format is defined, and of the texture in memory.
    draw : function
        Returns coverage, given a size and a view.
    side : int, optional
        Texels along a side, if the texture is a square picture.
    """

    method: str
    label: str
    file_bytes: int | None
    gpu_bytes: int
    draw: Draw
    side: int | None = None


class Shot(NamedTuple):
    """A view to draw, and its exact coverage."""

    size: tuple[int, int]
    to_unit: NDArray[np.float64]
    truth: NDArray[np.float32]


class RivalScene(NamedTuple):
    """Views of one drawing: all of it, its outline magnified, and all of it in few pixels."""

    whole: Sequence[Shot]
    outline: Sequence[Shot]
    small: Sequence[Shot]


class MeasuredRival(NamedTuple):
    """A method with the errors of its pictures."""

    rival: Rival
    whole: Errors
    outline: Errors
    small: Errors


def shot(drawing: "Drawing", size: tuple[int, int], to_unit: NDArray[np.float64]) -> Shot:
    """A view with its exact coverage."""
    return Shot(size, to_unit, coverage(drawing, size, to_unit, "exact"))


def scene_of(drawing: "Drawing") -> RivalScene:
    """Views in which methods are compared.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> [len(shots) for shots in scene_of(Drawing.polygon([(0, 0), (1, 0), (0, 1)]))]
    [1, 4, 4]
    """
    size = (CLOSEUP, CLOSEUP)
    views = [closeup(size, place, MAGNIFICATION) for place in outline_places(drawing, CLOSEUPS)]
    return RivalScene(
        [shifted_shot(drawing, WHOLE, SHIFTS[0])],
        [shot(drawing, size, view) for view in views],
        [shifted_shot(drawing, SMALL, shift) for shift in SHIFTS],
    )


def shifted_shot(drawing: "Drawing", side: int, shift: tuple[float, float]) -> Shot:
    """The whole drawing, shifted to the left and up by some pixels."""
    by = np.eye(3)
    by[:2, 2] = shift
    return shot(drawing, (side, side), fit((side, side)) @ by)


def measure_rival(rival: Rival, scene: RivalScene) -> MeasuredRival:
    """Measure the errors of a method, over all pixels of each kind of view together.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> drawing = Drawing.polygon([(0, 0), (1, 0), (0, 1)])
    >>> few, many = (measure_rival(raster_rival(drawing, side), scene_of(drawing)) for side in (16, 64))
    >>> few.whole.mae > many.whole.mae > 0.0
    True
    """
    return MeasuredRival(rival, *(_errors(rival.draw, shots) for shots in scene))


def _errors(draw: Draw, shots: Sequence[Shot]) -> Errors:
    images = [draw(taken.size, taken.to_unit).ravel() for taken in shots]
    none = [np.zeros(0, np.float32)]
    return errors(np.concatenate(images or none), np.concatenate([taken.truth.ravel() for taken in shots] or none))


def raster_rival(drawing: "Drawing", side: int) -> Rival:
    """A raster of coverage at 8 bits, mip-mapped."""
    texture = raster_from(drawing, side)
    return Rival("raster", "raster", texture.png_bytes, texture.nbytes, texture.sample, side)


def distance_rival(drawing: "Drawing", side: int, spread: float = SPREAD) -> Rival:
    """A distance field at 8 bits, mip-mapped."""
    texture = distance_from(drawing, side, spread)
    label = f"distance, spread {spread:g}"
    return Rival("distance", label, texture.png_bytes, texture.nbytes, texture.sample, side)


def texture_rival(texture: "Texture | ThesisTexture", method: str) -> Rival:
    """A packed texture or one of the thesis's, drawn by the CPU mirror of its shader."""
    from vexture.texture.texture import Texture

    def draw(size: tuple[int, int], to_unit: NDArray[np.float64] | None) -> NDArray[np.float32]:
        return coverage(texture, size, to_unit, "cpu")

    if isinstance(texture, Texture):
        return Rival(method, method, len(texture.to_ktx2()), texture.nbytes, draw)
    return Rival(method, method, sum(map(len, texture.to_png())), texture.quads.nbytes + texture.curves.nbytes, draw)


def bands_of(drawing: "Drawing") -> BandTexture:
    """Band texture of a drawing, if the band method can draw it.

    Raises
    ------
    LimitError
        If the bands cannot hold the drawing, or would draw it wrongly.
    """
    if len(drawing.paths) > 1:
        raise LimitError(
            f"{drawing.name} has {len(drawing.paths)} paths; our bands count the windings of a single path"
        )
    return band_texture(drawing, COASTLINE_BANDS if drawing.segments > MANY else BANDS)


def side_in_memory(limit: int) -> int:
    """Texels along a side of the largest 8-bit picture that, with its mip-map, takes at most `limit` bytes of memory.

    Examples
    --------
    >>> side_in_memory(1365), side_in_memory(1364)
    (32, 31)
    """
    return largest(lambda side: sum(n * n for n in [side, *mip_sides(side)]), limit)


def side_in_file(make: Callable[[int], RasterTexture | DistanceField], limit: int) -> int:
    """Texels along a side of the largest picture whose PNG file has at most `limit` bytes.

    Parameters
    ----------
    make : function
        Makes the picture of a given side.
    limit : int
        Bytes.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> square = Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)])
    >>> side = side_in_file(lambda side: raster_from(square, side, mips=False), 200)
    >>> [raster_from(square, n).png_bytes <= 200 for n in (side, 2 * side)]
    [True, False]
    """
    return largest(lambda side: make(side).png_bytes, limit)


def largest(size_of: Callable[[int], int], limit: int) -> int:
    """The largest side, up to `MOST_TEXELS`, whose size is within a limit; 1 if none is.

    `size_of` must grow with the side.
    """
    low, high = 1, 2
    while high < MOST_TEXELS and size_of(high) <= limit:
        low, high = high, 2 * high
    if high >= MOST_TEXELS and size_of(MOST_TEXELS) <= limit:
        return MOST_TEXELS
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if size_of(middle) <= limit else (low, middle)
    return low
