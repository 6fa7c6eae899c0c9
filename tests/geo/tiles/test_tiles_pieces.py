"""Pieces of features in boxes."""

import numpy as np
import pytest
import shapely

from vexture_geo.base.rings import cut, rings_of
from vexture_geo.tiles.pieces import FeaturePieces


def pieces_of(shapes):
    return FeaturePieces(
        np.arange(len(shapes)), np.array([str(k) for k in range(len(shapes))], object), np.array(shapes)
    )


def test_a_corner_beside_the_side_of_a_box_is_cut():
    """A part of a real coast, whose corner is beside the box by a rounding: GEOS cuts it the slow way only."""
    box = (1242560.3318038252, 5312679.21393289, 1575214.2789009123, 5645333.161029977)
    coast = [
        *((1582731.435982602, 5642401.414837995), (1575214.278900912, 5632022.741133708)),
        *((1576422.8332481321, 5630837.162048986), (1570718.0830371152, 5617258.616825198)),
        *((1565708.9097834935, 5613058.958254781), (1567925.5836037635, 5619090.803442381)),
        *((1565980.685884063, 5621451.823123742), (1550497.9411547433, 5590409.206972675)),
        *((1548179.3512967597, 5593294.348699385), (1549564.56010935, 5584531.630844645)),
        (1540936.518216582, 5597087.135539901),
    ]
    found = pieces_of([shapely.Polygon(coast)]).within(box)
    wanted = shapely.intersection(shapely.Polygon(coast), shapely.box(*box)).area
    assert shapely.area(found.shapes).sum() == pytest.approx(wanted)
    rings = cut(rings_of(np.array([shapely.Polygon(coast)]), str), box)
    assert shapely.area(rings.shapes).sum() == pytest.approx(wanted)
