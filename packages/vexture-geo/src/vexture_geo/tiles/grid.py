"""The grid of tiles of Web Mercator (EPSG:3857): boxes, numbers along Hilbert's curve, and zooms."""

from math import pi
from typing import Final, NamedTuple

from vexture.base.errors import ParameterError
from vexture_geo.base.extent import Bounds

CRS: Final = "EPSG:3857"

HALF: Final = pi * 6378137.0
"""Half the side of the world's square, in metres."""

LATITUDE: Final = 85.0511287798066
"""Northern and southern limit of the world's square, in degrees."""

MARGIN: Final = 1 / 32
"""Margin of a tile's unit square on each side, as a fraction of the tile's side."""

TILE_PIXELS: Final = 512
"""CSS pixels across a tile at its own zoom."""

MOST_ZOOM: Final = 20
"""A tile is then 38 m wide; float64 holds Web Mercator to 1e-8 m."""

STEPS: Final = (2, 3)
"""Zooms from one level of a pyramid to the next."""


class Tile(NamedTuple):
    """A tile of the web's grid; x counts eastwards and y southwards from the north-west corner.

    Examples
    --------
    >>> Tile(2, 3, 1).parent(1), Tile(1, 1, 0).number, [tile.number for tile in Tile(0, 0, 0).below(1)]
    (Tile(z=1, x=1, y=0), 4, [1, 4, 2, 3])
    """

    z: int
    x: int
    y: int

    @property
    def side(self) -> float:
        """Side in metres."""
        return 2.0 * HALF / (1 << self.z)

    @property
    def box(self) -> Bounds:
        """West, south, east and north; neighbours have byte-identical common sides."""
        count = 1 << self.z

        def at(line: int) -> float:
            return HALF * ((2 * line - count) / count)

        return (at(self.x), at(count - self.y - 1), at(self.x + 1), at(count - self.y))

    @property
    def number(self) -> int:
        """Number in PMTiles: zoom by zoom, along Hilbert's curve."""
        x, y, distance = self.x, self.y, 0
        for bit in range(self.z - 1, -1, -1):
            half = 1 << bit
            right, low = (x & half) > 0, (y & half) > 0
            distance += half * half * ((3 * right) ^ low)
            if not low:
                if right:
                    x, y = ~x & (half - 1), ~y & (half - 1)
                x, y = y, x
            x, y = x & (half - 1), y & (half - 1)
        return _before(self.z) + distance

    def parent(self, z: int) -> "Tile":
        """Return the tile of a lower zoom that contains this one."""
        shift = self.z - z
        return Tile(z, self.x >> shift, self.y >> shift)

    def below(self, steps: int) -> "list[Tile]":
        """List the tiles in this one, `steps` zooms below, row by row."""
        count = 1 << steps
        first_x, first_y = self.x << steps, self.y << steps
        return [Tile(self.z + steps, first_x + x, first_y + y) for y in range(count) for x in range(count)]

    def around(self) -> "list[tuple[Tile, float]]":
        """Neighbours, and the metres by which each is moved to be one, because the world repeats beyond its side."""
        count = 1 << self.z
        found = []
        for y in range(max(self.y - 1, 0), min(self.y + 2, count)):
            for x in range(self.x - 1, self.x + 2):
                if (x, y) != (self.x, self.y):
                    found.append((Tile(self.z, x % count, y), (x - x % count) / count * 2.0 * HALF))
        return found

    @property
    def name(self) -> str:
        """Name in files."""
        return f"{self.z}-{self.x}-{self.y}"


def _before(z: int) -> int:
    """Count the tiles of lower zooms."""
    return ((1 << 2 * z) - 1) // 3


def span(tile: Tile, z: int) -> tuple[int, int]:
    """Number of the first tile at a higher zoom within a tile, and the count of these, which are consecutive.

    Examples
    --------
    >>> span(Tile(1, 1, 1), 2), sorted(tile.number for tile in Tile(1, 1, 1).below(1))
    ((13, 4), [13, 14, 15, 16])
    """
    shift = 2 * (z - tile.z)
    return _before(z) + ((tile.number - _before(tile.z)) << shift), 1 << shift


def widen_box(box: Bounds, by: float) -> Bounds:
    """Widen a box by a margin on each side."""
    return (box[0] - by, box[1] - by, box[2] + by, box[3] + by)


def pixel(z: int) -> float:
    """Side of a pixel at a zoom, in metres."""
    return 2.0 * HALF / (TILE_PIXELS << z)


def check_zooms(least: int, most: int, step: int) -> None:
    """Raise a `ParameterError` if no pyramid can have these zooms."""
    if step not in STEPS:
        raise ParameterError(f"`step` is {step}; it must be {' or '.join(map(str, STEPS))}")
    if not 0 <= most <= MOST_ZOOM:
        raise ParameterError(f"`max_zoom` is {most}; it must be in 0..{MOST_ZOOM}")
    if not 0 <= least <= last_zoom(most, step):
        raise ParameterError(
            f"`min_zoom` is {least}; it must be in 0..{last_zoom(most, step)}, the zoom of the largest tiles for views "
            f"to {most}, `max_zoom`"
        )


def last_zoom(most: int, step: int) -> int:
    """Zoom of the last tiles of a pyramid, which are sharp in views to zoom `most`, up to `step` zooms higher.

    Examples
    --------
    >>> last_zoom(12, 2), last_zoom(12, 3), last_zoom(7, 2), last_zoom(1, 2), last_zoom(0, 2)
    (10, 9, 6, 0, 0)
    """
    return max(most - 1, 0) // step * step


def coarse(most: int, step: int) -> list[int]:
    """Generalised zooms, from 0: those before the last.

    Examples
    --------
    >>> coarse(6, 2), coarse(7, 3), coarse(2, 2)
    ([0, 2], [0, 3], [])
    """
    return list(range(0, last_zoom(most, step), step))


def zooms_of(least: int, most: int, step: int) -> list[int]:
    """Zooms that have tiles in a pyramid."""
    return [z for z in (*coarse(most, step), last_zoom(most, step)) if z >= least]
