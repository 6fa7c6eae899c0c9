"""Repair of polygons with many holes, against GEOS's own."""

import numpy as np
import pytest
import shapely

from vexture.base.notes import Notes
from vexture_geo.base import validity
from vexture_geo.base.rings import repair_rings, rings_of


@pytest.fixture
def ring_by_ring(monkeypatch):
    monkeypatch.setattr(validity, "MANY_HOLES", 0)


def holed(holes):
    return shapely.Polygon([(0, 0), (40, 0), (40, 40), (0, 40)], holes)


def square(x, y, side=1.0):
    return [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]


LATTICE = [square(x, y) for x in range(2, 38, 3) for y in range(2, 38, 3)]

BROKEN = {
    "a bow": [*LATTICE, [(1.0, 1.0), (1.8, 1.8), (1.8, 1.0), (1.0, 1.8)]],
    "overlapping holes": [*LATTICE, square(2.5, 2.5)],
    "a hole across the border": [*LATTICE, square(39.5, 20.0)],
    "a hole outside": [*LATTICE, square(60.0, 60.0)],
    "a hole in a hole": [*LATTICE, square(2.25, 2.25, 0.5)],
    "holes that share a side": [*LATTICE, square(3.0, 2.0)],
    "nothing left": [square(0.0, 0.0, 40.0), square(1.0, 1.0)],
}


@pytest.mark.parametrize("holes", BROKEN.values(), ids=BROKEN)
def test_ring_by_ring_is_as_geos_has_it(holes, ring_by_ring):
    shape = holed(holes)
    assert not shape.is_valid
    found = validity.make_valid(np.array([shape]))[0]
    wanted = shapely.make_valid(shape, method="structure", keep_collapsed=False)
    assert found.is_valid
    assert shapely.symmetric_difference(found, wanted).area == pytest.approx(0.0, abs=1e-9)


def test_thousands_of_holes_are_repaired_ring_by_ring(monkeypatch):
    places = np.arange(1.0, 39.0, 0.4)
    shape = holed([*[square(x, y, 0.1) for x in places for y in places], square(1.05, 1.05)])
    called = []
    own = shapely.make_valid
    monkeypatch.setattr(shapely, "make_valid", lambda shapes, **how: called.extend(shapes) or own(shapes, **how))
    found = validity.make_valid(np.array([shape, holed([square(39.5, 20.0)])]))
    assert max(len(one.interiors) for one in called) == 1
    assert found[0].is_valid
    holes = shapely.union_all([shapely.Polygon(hole) for hole in shape.interiors])
    assert found[0].area == pytest.approx(1600.0 - holes.area)


def test_heavy_polygons_come_in_parts(monkeypatch):
    monkeypatch.setattr(validity, "HEAVY", 100)
    rings = rings_of(np.array([holed(LATTICE), shapely.box(50, 0, 60, 10)]), str, np.array([7, 8]))
    found = repair_rings(rings, Notes())
    assert set(found.feature) == {7, 8}
    assert len(found.outer) > 4
    assert shapely.is_valid(found.shapes).all()
    assert shapely.area(found.shapes).sum() == pytest.approx(1600.0 - len(LATTICE) + 100.0)
    assert shapely.union_all(found.shapes).area == pytest.approx(1600.0 - len(LATTICE) + 100.0)
    assert not validity.is_heavy(found.shapes).any()
