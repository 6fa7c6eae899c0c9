"""Polygons that cover an area: which of them is seen, and gaps between them."""

import re

import numpy as np
import shapely
from map_sources import METRES, cells, frame, mapped, messages, names_at, overlapping


def test_small_polygons_lie_above_larger_ones_or_those_of_a_greater_value():
    source = frame([shapely.box(4, 4, 6, 6), shapely.box(0, 0, 10, 10)], METRES, code=["small", "large"], level=[1, 2])
    middle = np.array([[5.0, 5.0]])
    assert names_at(mapped(source, id="code"), middle) == ["small"]
    assert any("overlap" in message and "order" in message for message in messages(mapped(source, id="code")))
    above = mapped(source, id="code", order="level")
    assert names_at(above, middle) == ["large"]
    assert messages(above) == [], "the order was asked for"


def test_a_narrow_gap_is_closed_and_a_wide_one_stays():
    source = frame([shapely.box(0, 0, 10, 10), shapely.box(10.005, 0, 20, 10), shapely.box(22, 0, 30, 10)], METRES)
    done = mapped(source, snap=5e-4)
    assert "" not in names_at(done, np.array([[10.0025, 5.0]]))
    assert names_at(done, np.array([[21.0, 5.0]])) == [""]
    assert names_at(mapped(source, snap=0.0), np.array([[10.0025, 5.0]])) == [""]


def test_borders_that_are_equal_are_not_touched_and_others_are(monkeypatch):
    from vexture_geo.maps import coverage

    source, snapped = cells(60), []
    real = coverage.snap_rings
    monkeypatch.setattr(coverage, "snap_rings", lambda *given, **told: snapped.append(1) or real(*given, **told))
    assert mapped(source).conversion.notes == ()
    assert not snapped, "nothing was amiss"
    off = source.geometry.values.copy()
    off[7] = shapely.transform(off[7], lambda places: places + 1e-4)
    assert not messages(mapped(source.set_geometry(off))), "less than anyone can see"
    assert snapped
    off[7] = shapely.transform(off[7], lambda places: places + 0.5)
    said = messages(mapped(source.set_geometry(off), snap=1e-3))
    assert any(
        re.search(r"corners snapped to borders beside them, by up to 0\.\d+ m \(0\.000\d", line) for line in said
    )
    snapped.clear()
    assert any("lies below" in message for message in messages(mapped(frame(overlapping(), METRES))))
    assert snapped
