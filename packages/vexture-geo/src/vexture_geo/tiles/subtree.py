"""Jobs: the tiles of a part of the world, its geometry for lower zooms, or one tile of a lower zoom.

A job carries all its input and returns all its output, so that any process on any machine can run it.
"""

import hashlib
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.tiles.generalise import dissolve, generalise_polygons
from vexture_geo.tiles.grid import MARGIN, Tile, pixel, span, widen_box
from vexture_geo.tiles.pieces import FeaturePieces, join_pieces
from vexture_geo.tiles.texture import covering_piece, tile_texture, uniform_texture

MOVED: Final = 0.24
"""Pixels by which generalising for a zoom, after that for higher zooms, may move a border."""

LAST: Final = 0.215
"""The same for the last zoom: in views up to three zooms deeper, rounding may add 0.03 pixels."""

LEAST: Final = 1.0
"""Side, in pixels, of a square with the area of the smallest feature."""

CROWDED: Final = 16_000
"""Most features of a tile before the last zoom; above this, smaller ones are merged."""


@dataclass(frozen=True, eq=False)
class Pyramid:
    """Data that all jobs share.

    These are the generalised zooms, zooms of tiles, step, zoom of sharp views, features' colours and features' ranks.
    """

    coarse: tuple[int, ...]
    zooms: tuple[int, ...]
    step: int
    sharp: int
    paints: NDArray[np.uint32]
    ranks: NDArray[np.uint32]

    @property
    def most(self) -> int:
        """Last zoom, whose tiles have all features."""
        return self.zooms[-1]

    def pixel(self, zoom: int) -> float:
        """Side, in metres, of the pixels that tiles of a zoom are made for; the last zoom is for the sharpest views."""
        return pixel(self.sharp if zoom == self.most else zoom)


@dataclass(frozen=True)
class Job:
    """Work for a tile.

    ``leaf`` makes all tiles in it from the source around it. ``join`` makes its geometry at its zoom from that of the
    parts in it. ``tile`` makes one tile from its geometry and that around it, which `shifts` move by metres.
    """

    kind: str
    tile: Tile
    parts: tuple[bytes, ...]
    shifts: tuple[float, ...] = ()

    @property
    def name(self) -> str:
        """Name in files."""
        return f"{self.kind}-{self.tile.name}"


@dataclass
class JobResult:
    """Result of a job: runs of tiles by number, count and digest; contents by digest; geometry for lower zooms."""

    runs: list[tuple[int, int, str]] = field(default_factory=list)
    contents: dict[str, bytes] = field(default_factory=dict)
    geometry: bytes = b""

    def add(self, first: int, count: int, content: bytes) -> None:
        """Add equal tiles with consecutive numbers."""
        digest = hashlib.sha256(content).hexdigest()
        self.contents.setdefault(digest, content)
        self.runs.append((first, count, digest))


def run_job(pyramid: Pyramid, job: Job) -> JobResult:
    """Run a job."""
    given = [FeaturePieces.of_bytes(part) for part in job.parts]
    made = JobResult()
    if job.kind == "leaf":
        _leaf(pyramid, job.tile, given[0], made)
    elif job.kind == "join":
        whole = _at_zoom(pyramid, join_pieces(given), job.tile, job.tile.box)
        made.geometry = whole.to_bytes()
    else:
        moved = [_shift(part, shift) for part, shift in zip(given, job.shifts, strict=True)]
        box = widen_box(job.tile.box, MARGIN * job.tile.side)
        _tile(pyramid, dissolve(join_pieces([part.within(box) for part in moved])), job.tile, made)
    return made


def _leaf(pyramid: Pyramid, tile: Tile, pieces: FeaturePieces, result: JobResult) -> None:
    """Make all tiles in a tile, and its geometry for lower zooms."""
    around = widen_box(tile.box, MARGIN * tile.side)
    for zoom in pyramid.zooms:
        if zoom >= tile.z:
            least = (LEAST * pixel(zoom)) ** 2 if zoom < pyramid.most else 0.0
            moved = MOVED if zoom < pyramid.most else LAST
            detail = generalise_polygons(pieces, around, moved * pyramid.pixel(zoom), least)
            _descend(pyramid, detail, tile, zoom, result)
    if tile.z > 0:
        result.geometry = _at_zoom(pyramid, pieces.within(tile.box), tile, tile.box).to_bytes()


def _at_zoom(
    pyramid: Pyramid, pieces: FeaturePieces, tile: Tile, box: tuple[float, float, float, float]
) -> FeaturePieces:
    """Generalise a tile's geometry for its zoom; with those of higher zooms, tolerances add up to the limit."""
    tolerance = MOVED * pixel(tile.z) * (1.0 - 0.5**pyramid.step)
    return generalise_polygons(pieces, box, tolerance, (LEAST * pixel(tile.z)) ** 2)


def _descend(pyramid: Pyramid, pieces: FeaturePieces, tile: Tile, zoom: int, result: JobResult) -> None:
    """Make the tiles of a zoom in a tile; tiles that one feature covers share one texture for each run."""
    here = pieces.within(widen_box(tile.box, MARGIN * tile.side))
    if not len(here):
        return
    if (place := covering_piece(here, tile, pyramid.ranks)) >= 0:
        result.add(*span(tile, zoom), uniform_texture(here, place, pyramid.paints))
    elif tile.z == zoom:
        _tile(pyramid, here, tile, result)
    else:
        for part in tile.below(1):
            _descend(pyramid, here, part, zoom, result)


def _tile(pyramid: Pyramid, pieces: FeaturePieces, tile: Tile, result: JobResult) -> None:
    """Make one tile from the pieces in its square."""
    least = (LEAST * pixel(tile.z)) ** 2
    box = widen_box(tile.box, MARGIN * tile.side)
    while tile.z < pyramid.most and len(np.unique(pieces.order)) > CROWDED:
        least *= 2.0
        pieces = generalise_polygons(pieces, box, 0.0, least)
    if (place := covering_piece(pieces, tile, pyramid.ranks)) >= 0:
        result.add(tile.number, 1, uniform_texture(pieces, place, pyramid.paints))
    elif len(pieces):
        result.add(tile.number, 1, tile_texture(pieces, tile, pyramid.paints, pyramid.ranks))


def _shift(pieces: FeaturePieces, by: float) -> FeaturePieces:
    """Move pieces to the east."""
    import shapely

    if by == 0.0:
        return pieces
    return pieces.with_shapes(shapely.transform(pieces.shapes, lambda points: points + np.array([by, 0.0])))
