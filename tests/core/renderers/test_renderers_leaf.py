"""Pieces of a planar map's leaf, by the bytes of its quad (FORMAT.md, D.2)."""

import numpy as np
import pytest

from vexture.base.layout import CONTROL_OFFSET, COUNT_SHIFT, STRAIGHT
from vexture.renderers.cells import VextureCell
from vexture.renderers.leaf import leaf, leaf_piece, straight

BYTES = (3 << COUNT_SHIFT, 5 << COUNT_SHIFT | STRAIGHT, 2 << COUNT_SHIFT, 4 << COUNT_SHIFT | STRAIGHT)
"""Of 3 curved pieces, 5 straight ones in 3 texels, 2 curved ones, and 4 straight ones in 2 texels."""


@pytest.mark.parametrize(("k", "texels", "pieces"), [(0, 0, 0), (1, 3, 3), (2, 6, 8), (3, 8, 10)])
def test_straight_pieces_before_a_leaf_take_half_a_texel_each(k: int, texels: int, pieces: int) -> None:
    word = sum(byte << 8 * place for place, byte in enumerate(BYTES))
    found = leaf(VextureCell(0, (0, 100, word, 1000), 8 * k, 20, False))
    assert (found.first, found.number, found.is_straight) == (100 + texels, 1000 + pieces, k % 2 == 1)


def test_control_points_of_a_straight_piece_are_its_thirds() -> None:
    start, first, second, end = straight((600 | 30 << 16, 0 | 60 << 16))
    assert (start, end) == (600 | 30 << 16, 60 << 16)
    assert (first & 0xFFFF, first >> 16) == (400 + CONTROL_OFFSET, 40 + CONTROL_OFFSET)
    assert (second & 0xFFFF, second >> 16) == (200 + CONTROL_OFFSET, 50 + CONTROL_OFFSET)


def test_two_straight_pieces_share_a_texel() -> None:
    texels = np.zeros((1, 8, 4), np.uint32)
    texels[0, 3], texels[0, 4] = (1, 2, 3, 4), (5, 6, 7, 8)
    one = leaf(VextureCell(0, (0, 3, 4 << COUNT_SHIFT | STRAIGHT, 0), 0, 20, False))
    ends = []
    for i in (0, 1, 2, 3):
        piece, one = leaf_piece.py_func(texels, one, i)
        ends.append((piece[0], piece[3]))
    assert ends == [(1, 2), (3, 4), (5, 6), (7, 8)]
