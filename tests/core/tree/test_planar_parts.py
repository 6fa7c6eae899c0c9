"""Large maps of crowded symbols grow in parts, in several threads: the same map with any number of them."""

import threading
from dataclasses import fields, replace

import numpy as np
import pytest

from vexture.base.deadline import within
from vexture.base.errors import LimitError
from vexture.conversion.reading import read_drawing
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.tree.planar import build, parts
from vexture.tree.planar.build import build_map

DISC = read_drawing(b'<svg viewBox="0 0 2 2"><circle cx="1" cy="1" r="1"/></svg>').paths[0].contours[0]


@pytest.fixture(scope="module")
def discs():
    """Opaque and translucent discs on one another, some of one element, over a translucent ground."""
    random = np.random.default_rng(5)
    paints = [Paint((part, 1.0 - part, 0.5), opacity) for part in (0.0, 0.3, 1.0) for opacity in (1.0, 1.0, 0.5)]
    places = zip(random.uniform(0.1, 0.9, (300, 2)), random.uniform(0.02, 0.2, 300), strict=True)
    paths = [
        Path(((DISC - 0.5) * size + place,), paint=paints[k % 9], element=f"disc {k // 2}")
        for k, (place, size) in enumerate(places)
    ]
    ground = Path((DISC,), paint=Paint((1.0, 1.0, 0.0), 0.25))
    return Drawing((ground, *paths[:-1], replace(paths[-1], hides=True)), name="discs")


@pytest.fixture
def small_parts(monkeypatch):
    monkeypatch.setattr(build, "LARGE", 100)
    monkeypatch.setattr(parts, "PART", 60)


@pytest.fixture(scope="module")
def whole(discs):
    return build_map(discs, tolerance=2e-5, restyle=True, threads=1)


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_a_map_of_parts_is_that_of_one_piece(discs, whole, threads, small_parts, monkeypatch):
    grown = []
    monkeypatch.setattr(parts, "_grown", lambda *given, grow=parts._grown: grown.append(1) or grow(*given))
    of_parts = build_map(discs, tolerance=2e-5, restyle=True, threads=threads)
    assert len(grown) > 10
    for field in fields(whole):
        one, other = getattr(whole, field.name), getattr(of_parts, field.name)
        if field.name in ("table", "shades"):
            assert [part.tolist() for part in one] == [part.tolist() for part in other]
        elif isinstance(one, np.ndarray):
            assert one.dtype == other.dtype
            np.testing.assert_array_equal(one, other, field.name)
        else:
            assert one == other, field.name


def test_a_map_of_parts_keeps_its_limits(discs, whole, small_parts):
    before = threading.active_count()
    with pytest.raises(LimitError, match=r"quads at least; the limit is 100"):
        build_map(discs, tolerance=2e-5, restyle=True, threads=2, most_quads=100)
    assert build_map(discs, tolerance=2e-5, restyle=True, threads=2, most_texels=whole.texels // 2) is None
    with within(1e-9), pytest.raises(LimitError, match=r"^discs: converting takes longer than"):
        build_map(discs, tolerance=2e-5, restyle=True, threads=2)
    assert threading.active_count() == before


def test_a_map_knows_which_paths_hide_what_the_drawing_does_not_have(discs):
    """A path alone hides nothing in the map; it may have hidden what was left out before."""
    paths = [Path(((DISC - 0.5) * 0.2 + place,), element=f"{place}") for place in (0.2, 0.7)]
    drawing = Drawing((paths[0], replace(paths[1], hides=True)))
    assert build_map(drawing, restyle=True).hiding == {1}
