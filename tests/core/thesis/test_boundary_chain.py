"""The boundary of a cell as a chain whose filled side is on its right."""

import numpy as np
import pytest

from vexture.bezier.monotone import monotone_pieces
from vexture.drawing.drawing import Drawing
from vexture.thesis.boundary_chain import Chain, cell_chain, plain_chain
from vexture.thesis.build import root_level
from vexture.thesis.subdivide import LevelCell, cell_of
from vexture.tree.cubics import gather


def cell_and_rules(drawing: Drawing) -> tuple[LevelCell, np.ndarray]:
    cubics, owner, rules = gather(drawing)
    return LevelCell(*cell_of(root_level(drawing, monotone_pieces(cubics, owner)), 0, 1.0)), rules


def band(low: float, high: float) -> list[tuple[float, float]]:
    return [(0, low), (1, low), (1, high), (0, high)]


@pytest.mark.parametrize("turned", [False, True])
def test_the_filled_side_is_on_the_right(turned: bool) -> None:
    corners = band(0, 0.25)[:: -1 if turned else 1]
    chain = Chain(*cell_chain(*cell_and_rules(Drawing.polygon(corners))))
    assert (chain.chains, chain.area) == (1, pytest.approx(0.25))
    np.testing.assert_allclose([chain.curves[0, 0], chain.curves[-1, 3]], [(0, 0.25), (1, 0.25)], atol=1e-4)


def test_several_boundaries_are_no_chain_and_no_boundary_is_one() -> None:
    two = Chain(*cell_chain(*cell_and_rules(Drawing.polygon(band(0.1, 0.3), band(0.6, 0.8)))))
    assert (two.chains, two.area) == (2, pytest.approx(0.4, abs=1e-4))
    full = Chain(*cell_chain(*cell_and_rules(Drawing.polygon(band(0, 1)))))
    assert (full.chains, full.area) == (0, pytest.approx(1.0))


def test_what_runs_along_an_edge_is_not_plain() -> None:
    assert Chain(*plain_chain(*cell_and_rules(Drawing.polygon(band(0, 0.25))))).chains == 2
