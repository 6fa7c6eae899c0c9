"""A fine pattern on a receding plane (thesis 2.7), where a pixel's footprint covers many tiles, by every method."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing, Path
from vexture.renderers.exact import render_exact
from vexture_evidence.measures.raster import raster_from
from vexture_evidence.measures.renderings import Rendered
from vexture_evidence.measures.rivals import side_in_memory, texture_rival
from vexture_evidence.measures.shape import WAYS, convert_by

QUARTER: Final = 0.5522847498
"""Length, in radii, of the handles of a cubic that approximates a quarter of a circle."""

CIRCLE: Final = ((1, 0), (1, QUARTER), (QUARTER, 1), (0, 1), (-QUARTER, 1), (-1, QUARTER), (-1, 0), (-1, -QUARTER),
                 (-QUARTER, -1), (0, -1), (QUARTER, -1), (1, -QUARTER), (1, 0))  # fmt: skip

RADIUS: Final = 0.36
"""Radius of a dot, in tiles."""

NEAREST: Final = 0.1
"""Distance from the eye to the near side of the plane, in depths of the plane."""


@dataclass(frozen=True, slots=True, eq=False)
class Receding:
    """The plane, drawn by all methods.

    Parameters
    ----------
    rendered : Rendered
    tiles : int
        Tiles of the pattern along a side.
    nbytes : mapping
        Bytes in memory of each method's texture.
    raster_side : int
        Texels along a side of the raster.
    """

    rendered: Rendered
    tiles: int
    nbytes: dict[str, int]
    raster_side: int


def dots(tiles: int) -> Drawing:
    """Round dots, one in each tile of the unit square.

    Examples
    --------
    >>> dots(3).segments
    36
    """
    circle = RADIUS * np.array(CIRCLE)
    curves = np.stack([circle[n : n + 4] for n in (0, 3, 6, 9)])
    places = [(column + 0.5, row + 0.5) for row in range(tiles) for column in range(tiles)]
    return Drawing((Path(tuple((curves + place) / tiles for place in places)),), name="dots")


def view_of_plane(size: tuple[int, int]) -> NDArray[np.float64]:
    """View, (3, 3), over the unit square to its far side, at the top edge of the picture; the horizon is above.

    Examples
    --------
    >>> view = view_of_plane((200, 100))
    >>> [(view @ (x, y, 1))[:2] / (view @ (x, y, 1))[2] for x, y in ((0, 0), (200, 0), (100, 100))]
    [array([0., 1.]), array([1., 1.]), array([0.5, 0. ])]
    """
    width, height = size
    far = NEAREST / (1.0 + NEAREST)  # distance of the top edge below the horizon; that of the bottom edge is 1
    down = np.array([0.0, (1.0 - far) / height, far])  # the same distance, for any pixel
    across = far * np.array([1.0 / width, 0.0, -0.5])
    return np.stack([across + 0.5 * down, NEAREST * (np.array([0.0, 0.0, 1.0]) - down), down])


def receding(size: tuple[int, int] = (420, 170), tiles: int = 32) -> Receding:
    """Draw the plane by our textures, and by a raster as large in memory as the packed one, with and without mip-map.

    Parameters
    ----------
    size : tuple of int
        Width and height of the pictures in pixels.
    tiles : int
        Tiles of the pattern along a side.
    """
    drawing, view = dots(tiles), view_of_plane(size)
    thesis, packed = (convert_by(drawing, way).texture for way in (WAYS["sampled"], WAYS["packed"]))
    ours = {name: texture_rival(texture, name) for name, texture in (("sampled", thesis), ("packed", packed))}
    raster = raster_from(drawing, side_in_memory(ours["packed"].gpu_bytes))
    images = {"raster": raster.sample(size, view, mip=False), "raster, mip-mapped": raster.sample(size, view)}
    images |= {name: way.draw(size, view) for name, way in ours.items()}
    nbytes = {"raster": raster.texels.nbytes, "raster, mip-mapped": raster.nbytes}
    nbytes |= {name: way.gpu_bytes for name, way in ours.items()}
    return Receding(Rendered(images, render_exact(drawing, size, view), view), tiles, nbytes, raster.side)
