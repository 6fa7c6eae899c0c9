"""Depths on meshes, written here, read as extents."""

from datetime import UTC, datetime

import numpy as np
import pytest
import xarray

from vexture.base.errors import ParameterError, SourceError
from vexture.renderers.exact import render_exact
from vexture_geo.depth.depths import read_depths

MIDDLE, RADIUS, SLOPE = (500_400.0, 4_090_300.0), 200.0, 0.02


def cone(x, y):
    """Height of the bed of a round lake: 0 at its shore."""
    return SLOPE * (np.hypot(x - MIDDLE[0], y - MIDDLE[1]) - RADIUS)


def read(path, **options):
    return read_depths(path, path.name, **options)


def off_shore(drawing, level):
    """Largest distance of the outline from the lake's true shore, in edges of 10 m."""
    t = np.linspace(0.0, 1.0, 16)[:, None]
    found = []
    for p0, p1, p2, p3 in np.concatenate(drawing.paths[0].contours):
        found.append((1 - t) ** 3 * p0 + 3 * (1 - t) ** 2 * t * p1 + 3 * (1 - t) * t * t * p2 + t**3 * p3)
    points = np.concatenate(found) @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]
    return np.abs(np.hypot(*(points - MIDDLE).T) - RADIUS - (level - 0.05) / SLOPE).max() / 10.0


def mesh(path, on="face", bed=True, quads=False, count=40):
    """The lake on a mesh of triangles or quadrangles, around 10 m long."""
    random = np.random.default_rng(1)
    y, x = np.mgrid[0 : count + 1, 0 : count + 1] * 10.0
    x[1:-1, 1:-1] += random.uniform(-2, 2, (count - 1, count - 1))
    y[1:-1, 1:-1] += random.uniform(-2, 2, (count - 1, count - 1))
    node = np.arange((count + 1) ** 2).reshape(count + 1, count + 1)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]))
    faces = np.column_stack([a, b, c, d])
    if not quads:
        faces = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, d, c])])  # some turn right
    x, y = x.ravel() + MIDDLE[0] - 200.0, y.ravel() + MIDDLE[1] - 200.0
    at = (x[faces].mean(axis=1), y[faces].mean(axis=1)) if on == "face" else (x, y)
    ground = cone(*at) + 1.0  # the shore is 50 m further in
    topology = {"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "node_x node_y"}
    topology |= {"face_node_connectivity": "face_nodes", "face_dimension": "faces", "node_dimension": "nodes"}
    where = ("faces",) if on == "face" else ("nodes",)
    about = {"mesh": "mesh2d", "location": on}
    data = {
        "mesh2d": ((), 0, topology),
        "node_x": ("nodes", x, {"standard_name": "projection_x_coordinate", "units": "m"}),
        "node_y": ("nodes", y, {"standard_name": "projection_y_coordinate", "units": "m"}),
        "face_nodes": (("faces", "corners"), faces + 1, {"start_index": 1}),
        "waterdepth": (("time", *where), np.maximum(np.array([[0.0], [0.5]]) - ground, 0.0), about),
    }
    if bed:
        data["bl"] = (where, ground, about)
    time = ("time", [0.0, 1.0], {"units": "days since 2026-01-02"})
    xarray.Dataset(data, {"time": time}, {"epsg": 32610}).to_netcdf(path)
    return path


@pytest.mark.parametrize("on", ["face", "node"])
@pytest.mark.parametrize("bed", [True, False])
@pytest.mark.parametrize("quads", [True, False])
def test_meshes(tmp_path, on, bed, quads):
    extent = read(mesh(tmp_path / "mesh.nc", on, bed, quads))
    assert [step.time for step in extent.steps] == [datetime(2026, 1, day, tzinfo=UTC) for day in (2, 3)]
    for step, level in zip(extent.steps, (-1.0, -0.5), strict=True):
        assert off_shore(step.drawing, level=level) < (0.25 if bed else 0.6)
        assert len(step.drawing.paths[0].contours) == 1
        assert step.depth.shape == (256, 256)
        assert step.depth[128, 128] == pytest.approx(4.0 + level, abs=0.2)
    assert (extent.bed is not None) == bed


@pytest.mark.parametrize("on", ["face", "node"])
def test_contours_of_depth_on_a_mesh(tmp_path, on):
    """Each is the circle at whose places the lake is so deep."""
    extent = read(mesh(tmp_path / "mesh.nc", on), depths=(0.4, 1.0, 5.0))
    for step, level in zip(extent.steps, (-1.0, -0.5), strict=True):
        for depth, area in zip((0.4, 1.0), step.deeper[:2], strict=True):
            assert off_shore(area, level=level - (depth - 0.05)) < 0.25
        assert step.deeper[2].paths == ()  # no place is so deep


def test_a_mesh_that_ends_with_the_frame_goes_on_beyond(tmp_path):
    extent = read(mesh(tmp_path / "mesh.nc"), bounds=(MIDDLE[0] - 30, MIDDLE[1] - 30, MIDDLE[0] + 30, MIDDLE[1] + 30))
    assert render_exact(extent.steps[0].drawing, (16, 16)).min() > 1.0 - 1e-6
    path = mesh(tmp_path / "mesh.nc")
    with xarray.open_dataset(path, decode_times=False) as dataset:
        dataset.load().assign(waterdepth=dataset["waterdepth"] * 0 + 3.0, bl=dataset["bl"] * 0).to_netcdf(
            tmp_path / "b.nc"
        )
    assert render_exact(read(tmp_path / "b.nc").steps[0].drawing, (16, 16)).min() > 1.0 - 1e-6


@pytest.mark.parametrize("turned", [0.0, 0.03, 0.5])
def test_water_ends_where_a_mesh_ends_obliquely(tmp_path, turned):
    """Where the mesh only touches the frame at a corner, the model ends, and the water; 2 degrees are as along it."""
    with xarray.open_dataset(mesh(tmp_path / "mesh.nc"), decode_times=False) as dataset:
        wet = dataset.load().assign(waterdepth=dataset["waterdepth"] * 0 + 3.0, bl=dataset["bl"] * 0)
    x, y = wet["node_x"] - MIDDLE[0], wet["node_y"] - MIDDLE[1]
    sheared = {"node_x": x + np.sin(turned) * y + MIDDLE[0], "node_y": y - np.sin(turned) * x + MIDDLE[1]}
    for name, places in sheared.items():
        wet[name] = (wet[name].dims, places.values, wet[name].attrs)
    wet.to_netcdf(tmp_path / "turned.nc")
    extent = read(tmp_path / "turned.nc")
    x0, y0, x1, y1 = np.multiply(extent.frame.box, 480.0).round().astype(int)
    drawn = render_exact(extent.steps[0].drawing, (480, 480))[y0:y1, x0:x1].mean()
    share = (1.0 + np.sin(turned) ** 2) / (1.0 + np.sin(turned)) ** 2
    assert drawn == pytest.approx(share, abs=5e-3) if turned != 0.03 else share <= drawn < 1.001


def test_a_mesh_with_layers_or_without_faces_is_refused(tmp_path):
    with xarray.open_dataset(mesh(tmp_path / "mesh.nc"), decode_times=False) as dataset:
        dataset = dataset.load()
    layers = dataset["waterdepth"].expand_dims({"layer": [1.0, 2.0]})
    dataset.assign(waterdepth=layers).to_netcdf(tmp_path / "layers.nc")
    with pytest.raises(SourceError, match=r"variable 'waterdepth' also has the dimension 'layer' \(2 long\)"):
        read(tmp_path / "layers.nc")
    dataset["mesh2d"].attrs["face_node_connectivity"] = "elsewhere"
    dataset.to_netcdf(tmp_path / "open.nc")
    with pytest.raises(SourceError, match="its mesh 'mesh2d' cannot be read"):
        read(tmp_path / "open.nc")
    with pytest.raises(ParameterError, match="no dimension 'hour'"):
        read(mesh(tmp_path / "mesh.nc"), time_dim="hour")
    with pytest.raises(SourceError, match=r"within the bounds 0,0,9,9 .*covers"):
        read(tmp_path / "mesh.nc", bounds=(0.0, 0.0, 9.0, 9.0))


def test_a_mesh_that_is_tiny_in_its_frame_is_read(tmp_path):
    """One far node makes a frame so large that no sample of its grid is in a face: the outline still is there."""
    with xarray.open_dataset(mesh(tmp_path / "mesh.nc"), decode_times=False) as dataset:
        dataset = dataset.load()
    far = dataset["node_x"].isel(nodes=0) + 1e7
    x = xarray.concat([dataset["node_x"], far], "nodes")
    y = xarray.concat([dataset["node_y"], dataset["node_y"][0]], "nodes")
    dataset.drop_vars(["node_x", "node_y"]).assign(node_x=x, node_y=y).to_netcdf(tmp_path / "far.nc")
    extent = read(tmp_path / "far.nc", bounds=(4e5, 3.9e6, 1.1e7, 1.5e7))
    assert np.isnan(extent.steps[0].depth).all()
    assert extent.steps[0].drawing.paths
