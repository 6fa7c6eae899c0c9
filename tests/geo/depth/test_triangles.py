"""Outlines on triangles, and samples located in them."""

import numpy as np
import pytest

import model_runs
from vexture_geo.depth.triangles import locate_samples, outlines_above

FACES, STEPS = 900, 3


@pytest.fixture(scope="module")
def mesh():
    return model_runs.estuary(FACES, seed=3)


def test_outlines_of_the_crossed_triangles_are_those_of_all():
    random = np.random.default_rng(5)
    y, x = np.mgrid[0:12, 0:12].astype(float)
    points = np.column_stack([x.ravel(), y.ravel()])
    node = np.arange(144).reshape(12, 12)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]))
    triangles = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    values = np.sin(points @ random.normal(size=2)) + 0.3
    sides = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1), axis=-1)
    _, inverse, count = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True, return_counts=True)
    border = (count[inverse.ravel()] == 1).reshape(-1, 3)
    wet = values[triangles] > 0.0
    kept = (wet.any(axis=1) & ~wet.all(axis=1)) | border.any(axis=1)
    assert 0 < kept.sum() < len(kept)
    whole = outlines_above(points, triangles, values)
    part = outlines_above(points, triangles[kept], values, border[kept])
    for one, other in zip(whole, part, strict=True):
        np.testing.assert_array_equal(one.points, other.points)
        np.testing.assert_array_equal(one.border, other.border)


def test_samples_are_located_as_geometry_says(mesh):
    shapely = pytest.importorskip("shapely")
    faces = mesh.faces[mesh.faces[:, 3] < 0][:, :3]
    corners = mesh.nodes[faces]
    x = np.linspace(*corners[..., 0].ravel()[[0, -1]], 37)
    y = np.linspace(corners[..., 1].max(), corners[..., 1].min(), 29)
    samples, triangle, shares = locate_samples(corners, x, y)
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    np.testing.assert_allclose((shares[..., None] * corners[triangle]).sum(axis=1), places[samples], atol=1e-6)
    tree = shapely.STRtree(shapely.polygons(corners))
    assert set(tree.query(shapely.points(places), predicate="intersects")[0]) == set(samples)
