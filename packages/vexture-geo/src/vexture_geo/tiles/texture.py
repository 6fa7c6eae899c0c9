"""Make one tile: polygons of features as a planar map that can be restyled, encoded as a texture's file."""

from typing import Final

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from vexture.base.errors import LimitError
from vexture.base.layout import MOST_PAINTS
from vexture.bezier.convert import line_cubics
from vexture.drawing.drawing import IDENTITY, Drawing, Path
from vexture.drawing.paint import Paint
from vexture.texture.encode import encode
from vexture.texture.root import Root
from vexture.tree.planar.build import build_map
from vexture.tree.planar.style import style_of
from vexture_geo.tiles.grid import CRS, MARGIN, Tile, widen_box
from vexture_geo.tiles.pieces import FeaturePieces

ROOT: Final = "map"
"""Name of the polygons' map in each tile."""

GREY: Final = (0.8, 0.8, 0.8, 1.0)
"""Default colour and opacity of features."""

LEVELS: Final = 255
"""Steps of a colour's components and its opacity."""

FULL: Final = 1.0 - 1e-9
"""Fraction of a tile's square that a polygon must cover to count as covering all of it, despite rounding."""

PRECISION: Final = 2.0**-17
"""Largest error of a border by rounding, as a fraction of a tile's square: 0.06 pixels in views four zooms deeper."""

MOST_FEATURES: Final = MOST_PAINTS - 1
"""Most features of a tile; one paint is reserved for no feature."""


def square_of(tile: Tile) -> tuple[float, float, float, float]:
    """Box of a tile's unit square, which is wider than the tile."""
    return widen_box(tile.box, MARGIN * tile.side)


def covering_piece(pieces: FeaturePieces, tile: Tile, ranks: NDArray[np.uint32]) -> int:
    """Index of the topmost piece if it covers the square of a tile; -1 otherwise."""
    if not len(pieces):
        return -1
    box = square_of(tile)
    rank = ranks[pieces.order]
    top = np.flatnonzero(rank == rank.max())
    full = shapely.area(pieces.shapes[top]) >= FULL * (box[2] - box[0]) * (box[3] - box[1])
    return int(top[full.argmax()]) if full.any() else -1


def pack_colours(rgba: ArrayLike) -> NDArray[np.uint32]:
    """Pack colours and opacities, (n, 4), into one integer each."""
    parts = np.rint(np.asarray(rgba, np.float64).clip(0.0, 1.0) * LEVELS).astype("u1")
    return np.ascontiguousarray(parts).view("<u4").ravel().astype(np.uint32)


def _paint(paints: NDArray[np.uint32], feature: int) -> Paint:
    """Colour of a feature; a single colour applies to all."""
    number = int(paints[feature if len(paints) > 1 else 0])
    red, green, blue, opacity = (part / LEVELS for part in number.to_bytes(4, "little"))
    return Paint((red, green, blue), opacity)


def tile_texture(pieces: FeaturePieces, tile: Tile, paints: NDArray[np.uint32], ranks: NDArray[np.uint32]) -> bytes:
    """Encode the texture of the pieces in a tile's square, in the colours and the order of the source's features.

    Raises a `LimitError` if there are too many features.
    """
    box = square_of(tile)
    size = box[2] - box[0]
    to_source = np.array([[size, 0.0, box[0]], [0.0, size, box[1]]])
    return _write_texture(Drawing(_paths(pieces, box, size, paints, ranks), to_source, ROOT, CRS))


def uniform_texture(pieces: FeaturePieces, place: int, paints: NDArray[np.uint32]) -> bytes:
    """Encode the texture of a tile that one piece covers; it names no place, so that all such tiles are equal."""
    corners = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    square = line_cubics(corners, np.roll(corners, -1, axis=0))
    path = Path((square,), paint=_paint(paints, int(pieces.order[place])), element=str(pieces.ids[place]))
    return _write_texture(Drawing((path,), IDENTITY.copy(), ROOT))


def _write_texture(drawing: Drawing) -> bytes:
    # borders are already simplified, and merging more sides into curves would take twice as long
    planar = build_map(drawing, precision=PRECISION, restyle=True)
    assert planar is not None
    style = style_of(drawing, planar)
    root = Root(ROOT, 0, drawing.to_source, crs=drawing.crs, style=style)
    return encode([planar], [root], name=ROOT).to_ktx2()


def _paths(
    pieces: FeaturePieces,
    box: tuple[float, float, float, float],
    size: float,
    paints: NDArray[np.uint32],
    ranks: NDArray[np.uint32],
) -> tuple[Path, ...]:
    """Make one path for each feature, the lowest first."""
    _, place, number = np.unique(ranks[pieces.order], return_index=True, return_inverse=True)
    features = pieces.order[place]
    if len(features) > MOST_FEATURES:
        raise LimitError(
            f"a tile has {len(features)} features; the limit is {MOST_FEATURES}; give a larger `max_zoom`, or split it"
        )
    by_feature = np.argsort(number, kind="stable")
    names = pieces.ids[by_feature][np.searchsorted(number[by_feature], np.arange(len(features)))]
    shapes = shapely.orient_polygons(pieces.shapes[by_feature])
    rings, owner = shapely.get_rings(shapes, return_index=True)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    unit = np.clip((points - box[:2]) / size, 0.0, 1.0)
    inner = ring[1:] == ring[:-1]
    sides = line_cubics(unit[:-1][inner], unit[1:][inner])
    contours = np.split(sides, np.flatnonzero(np.diff(ring[:-1][inner])) + 1)
    of = [_paint(paints, feature) for feature in features.tolist()]
    return _group_paths(contours, number[by_feature][owner], names, of)


def _group_paths(
    contours: list[NDArray[np.float64]], feature: NDArray[np.intp], names: NDArray[np.object_], paints: list[Paint]
) -> tuple[Path, ...]:
    ends = np.searchsorted(feature, np.arange(len(names)), side="right").tolist()
    starts = [0, *ends[:-1]]
    return tuple(
        Path(tuple(contours[start:end]), paint=paint, element=str(name))
        for start, end, name, paint in zip(starts, ends, names, paints, strict=True)
    )
