"""The border of a mesh."""

import numpy as np
import pytest

import model_runs
from vexture_geo.depth.mesh_topology import border_of

FACES, STEPS = 900, 3


@pytest.fixture(scope="module")
def mesh():
    return model_runs.estuary(FACES, seed=3)


def test_the_border_of_a_mesh_is_what_one_face_has(mesh):
    faces = np.where(mesh.faces >= 0, mesh.faces, -1).astype(np.int32)
    border = border_of(faces, len(mesh.nodes))
    side = round(np.sqrt(len(mesh.nodes))) - 1
    assert border.sum() == 4 * side
    face, column = np.nonzero(border)
    ends = mesh.nodes[faces[face, column]] - model_runs.CORNER
    assert (np.isclose(ends, 0.0) | np.isclose(ends, side * model_runs.EDGE)).any(axis=1).all()
