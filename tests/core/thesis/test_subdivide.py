"""Dividing the cells of a level: nothing of an outline is lost, and all of it lies in its cell."""

import numpy as np
import pytest

from degenerate import drawing
from vexture.bezier.monotone import monotone_pieces
from vexture.drawing.drawing import Drawing
from vexture.thesis.build import root_level
from vexture.thesis.subdivide import ThesisLevel, children
from vexture.tree.cubics import gather


def divided(of: Drawing) -> tuple[ThesisLevel, ThesisLevel]:
    """The unit square of a drawing, and its four children."""
    cubics, owner, rules = gather(of)
    root = root_level(of, monotone_pieces(cubics, owner))
    below, _ = children(root, np.ones(1, np.bool_), rules, 1.0, 0)
    return root, ThesisLevel(*below)


def test_each_child_of_a_square_has_one_corner() -> None:
    _, below = divided(Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)]))
    assert below.slot.tolist() == [0, 1, 2, 3]
    assert below.origin.tolist() == [[0, 0], [0.5, 0], [0, 0.5], [0.5, 0.5]]
    assert np.diff(below.piece_at).tolist() == [2, 2, 2, 2]
    points = below.pieces.points
    assert abs(points[:, 3] - points[:, 0]).sum() == pytest.approx(2.0)


@pytest.mark.parametrize("seed", range(8))
def test_pieces_lie_in_their_cells(seed: int) -> None:
    of = drawing(seed)
    if not of.segments:
        return
    _, below = divided(of)
    for c, origin in enumerate(below.origin):
        ends = below.pieces.points[below.piece_at[c] : below.piece_at[c + 1]][:, [0, 3]]
        assert len(ends)
        assert ((ends >= origin) & (ends <= origin + 0.5)).all()
