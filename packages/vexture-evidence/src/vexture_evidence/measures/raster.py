"""Raster textures, the usual method today, filtered in float64 as OpenGL defines it.

A texel is the exact coverage of its square, in 8 bits. Every level of the mip-map is made from the drawing itself, not
from the level above, so that rasters are compared at their best. Coverage beyond the unit square is 0.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.renderers.view import view_matrix
from vexture.thesis.png import write_png

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing

FULL: Final = 255
"""Value of a texel that is fully covered."""


@dataclass(frozen=True, slots=True, eq=False)
class MipMapped:
    """A square picture of 8 bits with its mip-map; subclasses define what its texels mean.

    Parameters
    ----------
    texels : (n, n) uint8 array
        Top row first.
    mips : tuple of (m, m) uint8 arrays
        The smaller levels, of the sides n // 2, n // 4, ... 1; empty for no mip-map.
    """

    texels: NDArray[np.uint8]
    mips: tuple[NDArray[np.uint8], ...] = ()

    @property
    def side(self) -> int:
        """Texels along a side."""
        return len(self.texels)

    @property
    def nbytes(self) -> int:
        """Memory on the GPU: one byte for each texel of each level."""
        return self.texels.nbytes + sum(level.nbytes for level in self.mips)

    @property
    def png_bytes(self) -> int:
        """Size of its PNG file, grey with 8 bits, without the mip-map, which is made when the file is loaded."""
        return len(write_png(self.texels[..., None], {}))

    def sample(
        self, size: tuple[int, int], to_unit: ArrayLike | None = None, *, mip: bool = True
    ) -> NDArray[np.float32]:
        """Draw the picture as `vexture.coverage` draws a texture, with one fetch for each pixel.

        Parameters
        ----------
        size : tuple of int
            Width and height of the image in pixels.
        to_unit : (2, 3) or (3, 3) array, optional
            From pixel coordinates to the unit square; None fits the square.
        mip : bool
            Filter by ``LINEAR_MIPMAP_LINEAR`` if true, else by ``LINEAR`` at every size.

        Returns
        -------
        (height, width) float32 array
            Coverage, top row first.

        Raises
        ------
        ParameterError
            If the size or the view is out of range.
        """
        place = footprint(size, to_unit)
        return place.image_of(self.coverage(place, mip=mip))

    def coverage(self, place: "Footprint", *, mip: bool) -> NDArray[np.float64]:
        """Coverage of each pixel, from the fetched values."""
        raise NotImplementedError

    def fetch(self, place: "Footprint", *, mip: bool, frame: bool) -> NDArray[np.float64]:
        """Filtered texels, 0..255; with `frame`, texels beyond the picture are 0, else they repeat its border."""
        if mip and self.mips:
            return trilinear((self.texels, *self.mips), place, frame=frame)
        return bilinear(self.texels, place.u, place.v, frame=frame)


class RasterTexture(MipMapped):
    """A square picture of coverage, 0 (empty) to 255 (full), with its mip-map.

    Examples
    --------
    >>> half = RasterTexture(np.array([[255, 0], [255, 0]], np.uint8), (np.array([[128]], np.uint8),))
    >>> half.sample((4, 1), [[0.25, 0, 0], [0, -0.25, 0.625]], mip=False)
    array([[0.75, 0.75, 0.25, 0.  ]], dtype=float32)
    """

    __slots__ = ()

    def coverage(self, place: "Footprint", *, mip: bool) -> NDArray[np.float64]:
        """Coverage of each pixel, 0..1."""
        return self.fetch(place, mip=mip, frame=True) / FULL


@dataclass(frozen=True, slots=True, eq=False)
class Footprint:
    """Positions of a view's pixels on the texture, and the extent of their footprints.

    Parameters
    ----------
    u, v : (height, width) float64 arrays
        Unit-square position of each pixel's centre.
    reach : (height, width) float64 array
        Length, in the unit square, of the longer of the two steps to the next pixel, right or down.
    visible : (height, width) bool array
        False beyond the horizon.
    """

    u: NDArray[np.float64]
    v: NDArray[np.float64]
    reach: NDArray[np.float64]
    visible: NDArray[np.bool_]

    def image_of(self, coverage: NDArray[np.float64]) -> NDArray[np.float32]:
        """Coverage as an image, 0 beyond the horizon."""
        return np.where(self.visible, coverage, 0.0).astype(np.float32)


def footprint(size: tuple[int, int], to_unit: ArrayLike | None = None) -> Footprint:
    """Positions and steps of a view's pixels; the steps are the exact derivatives of the view.

    Raises
    ------
    ParameterError
        If the size or the view is out of range.

    Examples
    --------
    >>> footprint((4, 4)).reach[0]
    array([0.25, 0.25, 0.25, 0.25])
    """
    matrix = view_matrix(to_unit, size)
    x, y = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    p, q, w = np.einsum("ij,jyx->iyx", matrix, np.stack([x, y, np.ones(x.shape)]))
    seen = w > 0.0
    w = np.where(seen, w, 1.0)
    u, v = p / w, q / w
    steps = [
        np.hypot(matrix[0, axis] - u * matrix[2, axis], matrix[1, axis] - v * matrix[2, axis]) / w for axis in (0, 1)
    ]
    return Footprint(u, v, np.maximum(*steps), seen)


def bilinear(
    texels: NDArray[np.uint8], u: NDArray[np.float64], v: NDArray[np.float64], *, frame: bool = True
) -> NDArray[np.float64]:
    """Values of a picture, interpolated between the centres of its texels (filter ``LINEAR``).

    Parameters
    ----------
    texels : (n, n) array
        Top row first.
    u, v : arrays of one shape
        Positions in the unit square, v up.
    frame : bool
        Wrap by ``CLAMP_TO_BORDER``, so that everything beyond the picture is 0; else by ``CLAMP_TO_EDGE``.

    Returns
    -------
    array
        Values of the shape of `u`, in the units of the texels.

    Examples
    --------
    >>> bilinear(np.array([[0, 100], [0, 0]]), np.array([0.5, 0.75, 2.0]), np.array([0.75, 0.5, 0.5]))
    array([50., 50.,  0.])
    """
    side = len(texels)
    framed = np.pad(texels, 1, mode="constant" if frame else "edge").astype(np.float64)
    column = np.clip(u * side + 0.5, 0.0, side + 1.0)
    row = np.clip((1.0 - v) * side + 0.5, 0.0, side + 1.0)
    left, top = (np.minimum(axis.astype(np.intp), side) for axis in (column, row))
    right, down = column - left, row - top
    above = framed[top, left] * (1.0 - right) + framed[top, left + 1] * right
    below = framed[top + 1, left] * (1.0 - right) + framed[top + 1, left + 1] * right
    values: NDArray[np.float64] = above * (1.0 - down) + below * down
    return values


def trilinear(levels: Sequence[NDArray[np.uint8]], place: Footprint, *, frame: bool = True) -> NDArray[np.float64]:
    """Values of a mip-map at a view's pixels (OpenGL 4.6, sections 8.14 and 8.15: ``LINEAR_MIPMAP_LINEAR``).

    Parameters
    ----------
    levels : sequence of (n, n) uint8 arrays
        The largest first.
    place : Footprint
    frame : bool
        As in `bilinear`.

    Examples
    --------
    >>> levels = [np.full((side, side), value, np.uint8) for side, value in ((4, 0), (2, 100), (1, 200))]
    >>> trilinear(levels, footprint((2, 2)))[0]
    array([100., 100.])
    """
    level = np.clip(np.log2(np.maximum(len(levels[0]) * place.reach, 1.0)), 0.0, len(levels) - 1.0)
    values = np.zeros(level.shape)
    for number, texels in enumerate(levels):
        share = np.maximum(0.0, 1.0 - np.abs(level - number))
        some = share > 0.0
        values[some] += share[some] * bilinear(texels, place.u[some], place.v[some], frame=frame)
    return values


def mip_sides(side: int) -> list[int]:
    """Sides of the levels below the largest.

    Examples
    --------
    >>> mip_sides(20)
    [10, 5, 2, 1]
    """
    return [side >> level for level in range(1, side.bit_length())]


def raster_from(drawing: "Drawing", side: int, *, mips: bool = True) -> RasterTexture:
    """Make the raster texture of a drawing, from its exact coverage.

    Parameters
    ----------
    drawing : Drawing
    side : int
        Texels along a side.
    mips : bool
        Make the mip-map too.

    Raises
    ------
    ParameterError
        If the side is out of range.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> half = Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)])
    >>> raster_from(half, 2).texels, raster_from(half, 2).nbytes
    (array([[255, 0], [255, 0]], dtype=uint8), 5)
    """
    from vexture.renderers.exact import render_exact

    sides = [side, *(mip_sides(side) if mips else [])]
    first, *others = (np.rint(FULL * render_exact(drawing, (n, n))).astype(np.uint8) for n in sides)
    return RasterTexture(first, tuple(others))
