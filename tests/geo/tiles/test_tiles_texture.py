"""One tile as a texture: which piece covers it, and the colours and places of its features."""

import numpy as np
import shapely

from vexture.texture.load import texture_from
from vexture_geo.tiles.grid import Tile
from vexture_geo.tiles.pieces import FeaturePieces
from vexture_geo.tiles.texture import covering_piece, pack_colours, square_of, tile_texture, uniform_texture

TILE = Tile(3, 4, 2)
SQUARE = shapely.box(*square_of(TILE))
RANKS = np.array([0, 2, 1], np.uint32)


def pieces(*shapes):
    return FeaturePieces(np.arange(len(shapes)), np.array(["a", "b", "c"][: len(shapes)], object), np.array(shapes))


def test_a_piece_covers_the_square_with_its_margin_or_not_at_all():
    assert covering_piece(pieces(SQUARE), TILE, RANKS) == 0
    assert covering_piece(pieces(shapely.box(*TILE.box)), TILE, RANKS) == -1
    assert covering_piece(pieces(), TILE, RANKS) == -1


def test_only_the_topmost_piece_counts():
    part = shapely.box(*TILE.box)
    assert covering_piece(pieces(SQUARE, SQUARE, SQUARE), TILE, RANKS) == 1
    assert covering_piece(pieces(SQUARE, part, SQUARE), TILE, RANKS) == -1


def test_colours_are_bytes_from_red_to_opacity():
    numbers = pack_colours([(1.0, 0.0, 0.2, 1.0), (0.0, 1.0, 2.0, -1.0)])
    assert [number.to_bytes(4, "little") for number in numbers.tolist()] == [bytes((255, 0, 51, 255)), b"\0\xff\xff\0"]


def test_features_are_in_their_places_colours_and_order():
    west, south, east, north = TILE.box
    middle = (west + east) / 2
    halves = pieces(shapely.box(west, south, middle, north), shapely.box(middle, south, east, north), SQUARE)
    paints = pack_colours([(1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)])
    texture = texture_from(tile_texture(halves, TILE, paints, RANKS), "a tile")
    found = texture.element_at(np.array([(0.25, 0.5), (0.75, 0.5), (0.01, 0.5)])).name.tolist()
    assert found == ["c", "b", "c"]  # the third lies above the first, and below the second
    (root,) = texture.roots
    np.testing.assert_allclose(root.to_source @ (1.0, 0.0, 1.0), square_of(TILE)[2:0:-1])
    colours = dict(zip(root.style.names, root.style.rgba.tolist(), strict=True))
    assert colours["b"] == [0.0, 1.0, 0.0, 1.0]


def test_a_uniform_tile_names_no_place():
    paints = pack_colours([(1.0, 0.0, 0.0, 1.0)])
    one = uniform_texture(pieces(SQUARE, SQUARE), 1, paints)
    assert one == uniform_texture(pieces(shapely.box(0, 0, 1, 1), shapely.box(2, 2, 3, 3)), 1, paints)
    assert texture_from(one, "a tile").element_at(np.array([(0.1, 0.9)])).name.tolist() == ["b"]
