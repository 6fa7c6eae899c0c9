"""Pieces of work: the tiles of a part of the world, its geometry for lower zooms, and one tile of a lower zoom.

Each gets all that it needs and gives all that it made, so that it can be done by any process on any machine.
"""

import hashlib
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.tiles.generalise import dissolved, generalised
from vexture_geo.tiles.grid import MARGIN, Tile, pixel, span, widened
from vexture_geo.tiles.pieces import Pieces, joined
from vexture_geo.tiles.texture import covering, tile_texture, uniform_texture

__all__ = ["Job", "Made", "Pyramid", "done"]

MOVED: Final = 0.24
"""Pixels by which generalising may move a border at a zoom, with all that was done for higher zooms before."""

LAST: Final = 0.215
"""The same of the last zoom, in whose views, up to three zooms deeper, rounding may move it by 0.03 pixels."""

LEAST: Final = 1.0
"""Pixels across a square whose area the smallest feature has."""

CROWDED: Final = 16_000
"""Features of a tile before the last zoom, above which smaller ones are merged until there are fewer."""


@dataclass(frozen=True, eq=False)
class Pyramid:
    """What all the work shares.

    Generalised zooms, those of tiles, the step, the zoom of sharp views, features' colours and their order.
    """

    coarse: tuple[int, ...]
    zooms: tuple[int, ...]
    step: int
    sharp: int
    paints: NDArray[np.uint32]
    ranks: NDArray[np.uint32]

    @property
    def most(self) -> int:
        """The last zoom, whose tiles have all features."""
        return self.zooms[-1]

    def pixel(self, zoom: int) -> float:
        """Metres across the pixels for which tiles of a zoom are made: the last ones are for the sharpest views."""
        return pixel(self.sharp if zoom == self.most else zoom)


@dataclass(frozen=True)
class Job:
    """Work for a tile.

    ``leaf``: all tiles in it, of the source around it. ``join``: its geometry at its zoom, of that of the parts in it.
    ``tile``: itself, of its geometry and that around it; `shifts` move each of the parts by metres.
    """

    kind: str
    tile: Tile
    parts: tuple[bytes, ...]
    shifts: tuple[float, ...] = ()

    @property
    def name(self) -> str:
        """Its name in files."""
        return f"{self.kind}-{self.tile.name}"


@dataclass
class Made:
    """What work made: runs of tiles by number, count and digest; the contents by digest; geometry for lower zooms."""

    runs: list[tuple[int, int, str]] = field(default_factory=list)
    contents: dict[str, bytes] = field(default_factory=dict)
    geometry: bytes = b""

    def add(self, first: int, count: int, content: bytes) -> None:
        """Add equal tiles that follow one another."""
        digest = hashlib.sha256(content).hexdigest()
        self.contents.setdefault(digest, content)
        self.runs.append((first, count, digest))


def done(pyramid: Pyramid, job: Job) -> Made:
    """Do a piece of work."""
    given = [Pieces.of_bytes(part) for part in job.parts]
    made = Made()
    if job.kind == "leaf":
        _leaf(pyramid, job.tile, given[0], made)
    elif job.kind == "join":
        whole = _at_zoom(pyramid, joined(given), job.tile, job.tile.box)
        made.geometry = whole.to_bytes()
    else:
        moved = [_shifted(part, shift) for part, shift in zip(given, job.shifts, strict=True)]
        box = widened(job.tile.box, MARGIN * job.tile.side)
        _tile(pyramid, dissolved(joined([part.within(box) for part in moved])), job.tile, made)
    return made


def _leaf(pyramid: Pyramid, tile: Tile, pieces: Pieces, made: Made) -> None:
    """All tiles in a tile, and its geometry for lower zooms."""
    around = widened(tile.box, MARGIN * tile.side)
    for zoom in pyramid.zooms:
        if zoom >= tile.z:
            least = (LEAST * pixel(zoom)) ** 2 if zoom < pyramid.most else 0.0
            moved = MOVED if zoom < pyramid.most else LAST
            detail = generalised(pieces, around, moved * pyramid.pixel(zoom), least)
            _descend(pyramid, detail, tile, zoom, made)
    if tile.z > 0:
        made.geometry = _at_zoom(pyramid, pieces.within(tile.box), tile, tile.box).to_bytes()


def _at_zoom(pyramid: Pyramid, pieces: Pieces, tile: Tile, box: tuple[float, float, float, float]) -> Pieces:
    """Geometry of a tile at its zoom; with those before, for higher zooms, the tolerances add up to what is allowed."""
    tolerance = MOVED * pixel(tile.z) * (1.0 - 0.5**pyramid.step)
    return generalised(pieces, box, tolerance, (LEAST * pixel(tile.z)) ** 2)


def _descend(pyramid: Pyramid, pieces: Pieces, tile: Tile, zoom: int, made: Made) -> None:
    """Tiles of a zoom in a tile, and for each run of those that one feature covers only one."""
    here = pieces.within(widened(tile.box, MARGIN * tile.side))
    if not len(here):
        return
    if (place := covering(here, tile, pyramid.ranks)) >= 0:
        made.add(*span(tile, zoom), uniform_texture(here, place, pyramid.paints))
    elif tile.z == zoom:
        _tile(pyramid, here, tile, made)
    else:
        for part in tile.below(1):
            _descend(pyramid, here, part, zoom, made)


def _tile(pyramid: Pyramid, pieces: Pieces, tile: Tile, made: Made) -> None:
    """One tile of what is in its square."""
    least = (LEAST * pixel(tile.z)) ** 2
    box = widened(tile.box, MARGIN * tile.side)
    while tile.z < pyramid.most and len(np.unique(pieces.order)) > CROWDED:
        least *= 2.0
        pieces = generalised(pieces, box, 0.0, least)
    if (place := covering(pieces, tile, pyramid.ranks)) >= 0:
        made.add(tile.number, 1, uniform_texture(pieces, place, pyramid.paints))
    elif len(pieces):
        made.add(tile.number, 1, tile_texture(pieces, tile, pyramid.paints, pyramid.ranks))


def _shifted(pieces: Pieces, by: float) -> Pieces:
    """Pieces moved to the east."""
    import shapely

    if by == 0.0:
        return pieces
    return pieces.with_shapes(shapely.transform(pieces.shapes, lambda points: points + np.array([by, 0.0])))
