"""Meshes whose faces share no nodes, or meet at hanging nodes: as if they shared them."""

import numpy as np
import pytest
import xarray

from vexture_geo.depth.conforming import conforming
from vexture_geo.depth.depths import read_depths
from vexture_geo.depth.mesh_topology import after_each, border_of

TURN = np.array([[0.8, 0.6], [-0.6, 0.8]])
CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def squares(levels):
    """Nodes and faces of a square of 800 m: columns of 100 m, each divided into squares of its own level."""
    found = []
    for column, level in enumerate(levels):
        side = 100.0 / 2**level
        x, y = np.meshgrid(np.arange(2**level) * side, np.arange(8 * 2**level) * side)
        starts = np.stack([x.ravel() + 100.0 * column, y.ravel()], axis=1)
        found.append(starts[:, None] + side * CORNERS)
    corners = np.concatenate(found)
    return corners.reshape(-1, 2), np.arange(4 * len(corners), dtype=np.int32).reshape(-1, 4)


def border_length(mesh):
    border = border_of(mesh.faces, len(mesh.nodes))
    sides = mesh.nodes[mesh.faces[border]] - mesh.nodes[after_each(mesh.faces)[border]]
    return np.hypot(*sides.T).sum()


def written(path, nodes, faces, depth, on="face", units="m"):
    topology = {"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "node_x node_y"}
    data = {
        "mesh2d": ((), 0, {**topology, "face_node_connectivity": "face_nodes"}),
        "node_x": ("nodes", nodes[:, 0], {"units": units}),
        "node_y": ("nodes", nodes[:, 1], {"units": units.replace("east", "north")}),
        "face_nodes": (("faces", "corners"), faces, {"start_index": 0}),
        "waterdepth": ("faces" if on == "face" else "nodes", depth, {"units": "m"}),
    }
    xarray.Dataset(data, attrs={"epsg": 32610 if units == "m" else 4326}).to_netcdf(path)
    return path


@pytest.mark.parametrize("noise", [0.0, 0.002])
@pytest.mark.parametrize("on", ["face", "node"])
def test_water_on_faces_that_share_no_nodes_is_one_area(tmp_path, on, noise):
    nodes, faces = squares((0,) * 8)
    nodes = nodes + np.array([5e5, 4e6]) + np.random.default_rng(1).uniform(-noise, noise, nodes.shape)
    depth = np.ones(len(faces if on == "face" else nodes))
    drawing = read_depths(written(tmp_path / "own.nc", nodes, faces, depth, on), "own.nc").steps[0].drawing
    assert [len(path.contours) for path in drawing.paths] == [1]
    assert len(drawing.paths[0].contours[0]) == 4


@pytest.mark.parametrize("levels", [(0, 0, 0, 0, 1, 1, 2, 2), (0, 0, 2, 2, 3, 0, 0, 0)])
def test_faces_meet_at_hanging_nodes(levels):
    nodes, faces = squares(levels)
    mesh = conforming(nodes @ TURN + (5e5, 4e6), faces)
    assert border_length(mesh) == pytest.approx(3200.0)
    assert len(mesh.faces) == len(faces)


def test_nodes_of_32_bits_are_joined():
    """Half a metre is the last digit of such coordinates; quadtrees hang nodes that far from the middle."""
    nodes, faces = squares((0, 0, 0, 0, 1, 1, 2, 2))
    single = (nodes @ TURN + (3e5, 5e6)).astype(np.float32).astype(np.float64)
    assert border_length(conforming(single, faces)) == pytest.approx(3200.0, abs=10.0)


def test_a_corner_that_is_written_twice_is_one():
    """Triangles in a table for quadrangles may end with a node twice."""
    nodes = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    mesh = conforming(nodes, np.array([[0, 1, 2, 2], [0, 2, 3, 0], [1, 1, 1, 1]], np.int32))
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3], [1, -1, -1]]


def test_a_mesh_that_shares_its_nodes_stays_as_it_is():
    nodes = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [9.0, 9.0]])
    faces = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    mesh = conforming(nodes, faces)
    assert mesh.faces is faces
    assert mesh.numbers is None


@pytest.mark.parametrize("side", [0.0, 5e-324, 1.0, 8e307])
def test_faces_on_one_another_and_of_any_size_are_kept(side):
    """Places that no number can tell apart, or that are infinitely far apart, are refused later."""
    corners = np.concatenate([side * CORNERS, side * CORNERS])
    assert len(conforming(corners, np.arange(8, dtype=np.int32).reshape(2, 4)).faces) == 2


def test_values_at_one_place_are_their_mean():
    nodes, faces = squares((0,) * 8)
    mesh = conforming(nodes, faces)
    values = np.full(len(nodes), np.nan)
    at = np.flatnonzero((nodes == (100.0, 100.0)).all(axis=1))
    values[at] = 1.0, 2.0, 6.0, np.nan
    assert mesh.values(values)[mesh.numbers[at]].tolist() == [3.0] * 4


def grid_of_faces(columns, rows, side, west, south):
    x, y = np.meshgrid(west + side * np.arange(columns + 1), south + side * np.arange(rows + 1))
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    faces = np.stack([first, first + 1, first + columns + 2, first + columns + 1], axis=1)
    return np.stack([x.ravel(), y.ravel()], axis=1), faces.astype(np.int32)


@pytest.mark.parametrize(("units", "on"), [("degrees_east", "face"), ("degrees_east", "node"), ("", "face")])
def test_a_mesh_across_the_antimeridian_is_one_area(tmp_path, units, on):
    nodes, faces = grid_of_faces(6, 4, 0.01, 179.97, 52.0)
    nodes[:, 0] = (nodes[:, 0] + 180.0) % 360.0 - 180.0
    path = written(tmp_path / "a.nc", nodes, faces, np.ones(len(faces if on == "face" else nodes)), on, units)
    extent = read_depths(path, "a.nc")
    assert extent.frame.bounds == pytest.approx((179.97, 52.0, 180.03, 52.04))
    assert [len(one.contours) for one in extent.steps[0].drawing.paths] == [1]


def test_faces_of_a_world_that_cross_the_antimeridian_are_left_out(tmp_path):
    nodes, faces = grid_of_faces(36, 4, 10.0, -175.0, -20.0)
    nodes[:, 0] = (nodes[:, 0] + 180.0) % 360.0 - 180.0
    depth = np.zeros(len(faces))
    depth[35::36] = 1.0
    extent = read_depths(written(tmp_path / "a.nc", nodes, faces, depth, units="degrees_east"), "a.nc")
    assert not extent.steps[0].drawing.paths
    assert "faces across the antimeridian are left out: 4" in " ".join(map(str, extent.notes))


@pytest.mark.parametrize("again", [slice(None), slice(8, 16)])
def test_faces_that_are_listed_twice_count_once(tmp_path, again):
    nodes, faces = grid_of_faces(8, 8, 100.0, 5e5, 4e6)
    depth = np.where(np.arange(64) % 8 < 4, 1.0, 0.0)
    turned = np.roll(faces[again], 1, axis=1)
    path = written(tmp_path / "a.nc", nodes, np.concatenate([faces, turned]), np.concatenate([depth, depth[again]]))
    once = read_depths(written(tmp_path / "b.nc", nodes, faces, depth), "b.nc")
    extent = read_depths(path, "a.nc")
    (one,), (other,) = extent.steps[0].drawing.paths, once.steps[0].drawing.paths
    assert np.array_equal(one.box, other.box)
    assert f"its mesh has {len(turned)} faces more than once" in " ".join(map(str, extent.notes))
