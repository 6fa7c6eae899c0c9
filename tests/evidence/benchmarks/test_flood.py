"""The reference that the flood's page is judged by is right."""

import doctest

import numpy as np
import pytest

import flood_edges
from flood_reading import CRS, KINDS, VERTICES, island
from vexture.drawing.drawing import Drawing
from vexture.fold.fold import Fold, Kind

SIZE = (60, 40)
BOX = (1 / 32, 0.2, 31 / 32, 0.8)
SHAPE = Drawing.polygon([(0.0, 0.0), (1.0, 0.0), (1.0, 0.45), (0.55, 0.5), (0.5, 0.62), (0.4, 0.45), (0.0, 0.55)])


def from_the_air():
    """Map from pixels of a camera that looks down on the box at a slant."""
    turn = np.radians(40)
    c, s = np.cos(turn), np.sin(turn)
    view = np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, -90.0], [0, 0, 0, 1]])
    projection = np.array([[1.5, 0, 0, 0], [0, 2.25, 0, 0], [0, 0, -1.0, -0.2], [0, 0, -1, 0]])
    camera = {"projection": projection.T.ravel(), "view": view.T.ravel(), "level": 0.0}
    return flood_edges.water_to_unit(camera, BOX, SIZE)


def sampled(to_unit, fold, seconds, count=24):
    """Coverage by brute force: which of many places of a pixel the fold takes into the shape."""
    shapely = pytest.importorskip("shapely")
    outline = shapely.Polygon(SHAPE.paths[0].contours[0][:, 0])
    shapely.prepare(outline)
    x, y = np.meshgrid((np.arange(count * SIZE[0]) + 0.5) / count, (np.arange(count * SIZE[1]) + 0.5) / count)
    u, v, w = np.tensordot(to_unit, np.stack([x, y, np.ones_like(x)]), 1)
    places = np.stack([(u / w).ravel(), (v / w).ravel()], axis=1)
    if fold is not None:
        places, _ = fold.at(places, seconds)
    wet = shapely.contains_xy(outline, places[:, 0], places[:, 1])
    return wet.reshape(SIZE[1], count, SIZE[0], count).mean(axis=(1, 3))


def waves():
    """Fold that moves every place otherwise, and nothing on the borders."""
    displacement = np.zeros((16, 16, 2))
    displacement[2:-2, 2:-2] = np.random.default_rng(3).normal(0.0, 0.012, (12, 12, 2))
    return Fold(displacement, kind=Kind.PERIODIC, duration=6.0, cycle=6.0)


def test_examples_in_the_docstrings():
    found = doctest.testmod(flood_edges)
    assert found.attempted
    assert not found.failed


@pytest.mark.parametrize("folded", [False, True])
def test_the_reference_is_what_brute_force_finds(folded):
    to_unit, fold = from_the_air(), waves() if folded else None
    truth = flood_edges.exact_shore(SHAPE, SIZE, to_unit, fold, 1.3)
    seen = flood_edges.inside(to_unit, BOX, SIZE)
    assert 0.1 < seen.mean() < 0.95
    assert (seen & (truth > 0) & (truth < 1)).sum() > 30
    assert np.abs(truth - sampled(to_unit, fold, 1.3))[seen].max() < 0.02
    if folded:
        assert np.abs(truth - flood_edges.exact_shore(SHAPE, SIZE, to_unit))[seen].max() > 0.2


def test_a_page_that_is_right_has_no_errors_and_one_that_is_wrong_has_its_own():
    to_unit = from_the_air()
    seen = flood_edges.inside(to_unit, BOX, SIZE)
    truth = flood_edges.exact_shore(SHAPE, SIZE, to_unit)
    land, water = np.array([20.0, 60.0, 30.0]), np.array([220.0, 100.0, 250.0])

    def picture(coverage):
        return np.uint8(np.rint(land + coverage[..., None] * (water - land)))

    assert flood_edges.edge_errors(picture(truth), truth, seen).max() < 1.0
    wrong = np.where((truth > 0) & (truth < 1), np.abs(truth - 0.1), truth)
    assert flood_edges.edge_errors(picture(wrong), truth, seen).max() > 20.0
    assert len(flood_edges.edge_errors(picture(np.ones_like(truth)), np.ones_like(truth), seen)) == 0


@pytest.mark.parametrize("kind", KINDS)
def test_the_island_is_a_polygon_of_as_many_vertices(kind):
    shapely = pytest.importorskip("shapely")
    ring = island(VERTICES, 1, CRS[kind])
    assert len(ring) == VERTICES + 1
    assert shapely.Polygon(ring).is_valid
