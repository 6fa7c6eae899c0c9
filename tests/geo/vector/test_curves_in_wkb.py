"""Arcs, curved surfaces and triangles in WKB: chords are near their arcs, and neighbours keep their border."""

from struct import pack

import numpy as np
import pyogrio
import pytest
import shapely

from vexture.base.errors import LimitError
from vexture.base.notes import Notes
from vexture.base.tolerance import ROUND
from vexture_geo.vector import curves
from vexture_geo.vector.curves import BROKEN, straighten_curves
from vexture_geo.vector.features import read_features
from vexture_geo.vector.vectors import read_areas

LINE, ARCS = 2, 8


def points(kind, *places, sign="<"):
    flat = [number for place in places for number in place]
    many = len(places[0]) - 2
    head = pack(f"{sign}BII", sign == "<", kind + 1000 * many, len(places))
    return head + pack(f"{sign}{len(flat)}d", *flat)


def parted(kind, *parts):
    return pack("<BII", 1, kind, len(parts)) + b"".join(parts)


def faces(kind, *rings):
    return pack("<BII", 1, kind, len(rings)) + b"".join(points(LINE, *ring)[5:] for ring in rings)


def made(*shapes):
    return shapely.from_wkb(straighten_curves(np.array(shapes, object)))


CIRCLE = points(ARCS, (0, 0), (2, 2), (4, 0), (2, -2), (0, 0))
HALF = points(ARCS, (0, 0), (2, 2), (4, 0))
CAP = parted(10, parted(9, HALF, points(LINE, (4, 0), (0, 0))))
DONUT = parted(10, CIRCLE, points(ARCS, (1, 0), (3, 0), (1, 0)))
TRIANGLE = [(0, 0), (1, 0), (0, 1), (0, 0)]
OTHER = [(1, 0), (1, 1), (0, 1), (1, 0)]


def test_chords_are_near_their_arc():
    (circle,) = made(CIRCLE)
    assert circle.geom_type == "LineString"
    corners = shapely.get_coordinates(circle)
    middles = (corners[1:] + corners[:-1]) / 2
    assert np.abs(np.hypot(*(corners - (2, 0)).T) - 2).max() < 1e-14
    assert 0 < 2 - np.hypot(*(middles - (2, 0)).T).min() <= ROUND * 4
    assert len(corners) < 800


@pytest.mark.parametrize(
    ("shape", "kind", "area"),
    [
        (CAP, "Polygon", 2 * np.pi),
        (DONUT, "Polygon", 3 * np.pi),
        (parted(12, CAP, faces(3, [(9, 0), (10, 0), (10, 1), (9, 0)])), "MultiPolygon", 2 * np.pi + 0.5),
        (parted(11, HALF, points(LINE, (0, 0), (1, 1))), "MultiLineString", 0),
        (parted(7, points(1, (5, 5))[:5] + pack("<2d", 5, 5), CAP), "GeometryCollection", 2 * np.pi),
        (parted(16, faces(17, TRIANGLE), faces(17, OTHER)), "MultiPolygon", 1),
        (parted(15, faces(3, TRIANGLE), faces(3, OTHER)), "MultiPolygon", 1),
        (faces(17, TRIANGLE), "Polygon", 0.5),
    ],
)
def test_what_geos_cannot_hold_becomes_what_it_can(shape, kind, area):
    (found,) = made(shape)
    assert found.geom_type == kind
    assert shapely.is_valid(shapely.get_parts(found)).all()
    assert found.area == pytest.approx(area, rel=1e-4, abs=1e-12)


def test_z_and_m_and_the_other_order_of_bytes_are_read():
    flat, raised, turned = made(
        HALF,
        points(ARCS, (0, 0, 7, 1), (2, 2, 8, 2), (4, 0, 9, 3)).replace(pack("<I", 2008), pack("<I", 3008)),
        points(ARCS, (0, 0), (2, 2), (4, 0), sign=">"),
    )
    extended = HALF[:1] + pack("<II", 0x20000008, 28992) + HALF[5:]
    assert flat.equals_exact(raised)
    assert flat.equals_exact(turned)
    assert flat.equals_exact(made(extended)[0])


def test_neighbours_have_the_same_chords_along_their_border():
    there, back = made(points(ARCS, (0.1, 0.3), (1.7, 2.2), (4.3, 0)), points(ARCS, (4.3, 0), (1.7, 2.2), (0.1, 0.3)))
    assert shapely.get_coordinates(there).tolist() == shapely.get_coordinates(back)[::-1].tolist()


def test_arcs_of_points_on_a_line_are_straight_and_small_ones_have_few_chords():
    huge = points(ARCS, (0, 0), (0, 1e6), (0, 2e6))
    straight, small, far = made(huge, HALF, points(ARCS, (0, 0), (2, 1e-9), (1, 0)))[:3]
    assert len(straight.coords) == 2
    assert len(small.coords) < 60
    assert len(far.coords) == 2


def test_damaged_curves_are_left_out_and_named():
    cut, even, deep = CAP[:-20], points(ARCS, (0, 0), (1, 1)), CAP
    for _ in range(40):
        deep = parted(12, deep)
    many = pack("<BII", 1, 10, 2**31)
    shapes = straighten_curves(np.array([cut, even, deep, many, CAP, None, pack("<BI", 1, 8)], object))
    assert [place for place, shape in enumerate(shapes) if shape == BROKEN] == [0, 1, 2, 3, 6]
    assert shapely.from_wkb(shapes[4]).is_valid
    assert shapely.from_wkb(BROKEN, on_invalid="fix") is None


def test_chords_are_limited(monkeypatch):
    monkeypatch.setattr(curves, "MOST_POINTS", 100)
    with pytest.raises(LimitError, match="more than 100 chords; choose fewer features by `where`"):
        made(CIRCLE)


def test_a_geopackage_with_curves_is_read_by_maps_and_floods(tmp_path):
    place = tmp_path / "curves.gpkg"
    blobs = np.array([CAP, DONUT], object)
    named = {"fields": ["n"], "field_data": [np.arange(2)], "crs": "EPSG:28992", "driver": "GPKG"}
    pyogrio.raw.write(place, geometry=blobs, geometry_type="Unknown", **named)
    notes = Notes()
    features = read_features(place, notes=notes)
    assert not notes.in_order
    areas = np.bincount(features.feature, shapely.area(features.rings.shapes))
    assert areas == pytest.approx([2 * np.pi, 3 * np.pi], rel=1e-4)
    rings, _ = read_areas(place, "curves.gpkg", None, notes)
    assert shapely.area(rings.shapes) == pytest.approx([2 * np.pi, 3 * np.pi], rel=3e-5)
