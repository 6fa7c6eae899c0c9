"""Runs of models on large meshes, as D-Flow FM and SFINCS write them, made small and read as extents."""

import numpy as np
import pytest
import xarray

import model_runs
from vexture.base.errors import SourceError
from vexture.renderers.exact import render_exact
from vexture_geo.depth.depths import read_depths
from vexture_geo.depth.mesh_topology import border_of
from vexture_geo.depth.triangles import locate_samples, outlines_above

FACES, STEPS = 900, 3


@pytest.fixture(scope="module")
def mesh():
    return model_runs.estuary(FACES, seed=3)


@pytest.fixture(scope="module")
def run(mesh, tmp_path_factory):
    return model_runs.write_run(tmp_path_factory.mktemp("run") / "run_map.nc", mesh, STEPS)


def read(path, **options):
    return read_depths(path, path.name, **options)


def changed(path, change, place):
    """A file after a function of its dataset, in which times and fill values are as they are written."""
    with xarray.open_dataset(path, decode_cf=False) as dataset:
        change(dataset.load()).to_netcdf(place)
    return place


def outline(step):
    return [contour for path in step.drawing.paths for contour in path.contours]


def same(one, other):
    """Whether two extents have the same outlines and depths, bit for bit."""
    for a, b in zip(one.steps, other.steps, strict=True):
        np.testing.assert_array_equal(a.depth, b.depth)
        for x, y in zip(outline(a), outline(b), strict=True):
            np.testing.assert_array_equal(x, y)
    np.testing.assert_array_equal(one.bed, other.bed)
    return one.frame == other.frame


def test_levels_above_beds_on_faces_and_on_nodes_are_depths(mesh, run, tmp_path):
    levels = read(model_runs.write_run(tmp_path / "levels.nc", mesh, STEPS, depth=False))
    for step, other in zip(levels.steps, read(run).steps, strict=True):
        np.testing.assert_allclose(step.depth, other.depth, atol=1e-6)
        assert len(outline(step)) == len(outline(other)) > 0


def test_of_two_levels_the_one_with_the_usual_name_is_read(mesh, run, tmp_path):
    path = model_runs.write_run(tmp_path / "levels.nc", mesh, STEPS, depth=False)
    before = changed(path, lambda data: data.assign(mesh2d_s0=data["mesh2d_s1"] - 1.0), tmp_path / "both.nc")
    assert same(read(before), read(path))


def test_other_variables_on_the_mesh_are_no_depths_beside_a_level_and_a_bed(mesh, tmp_path):
    path = model_runs.write_run(tmp_path / "levels.nc", mesh, STEPS, depth=False)
    stress = changed(path, lambda data: data.assign(mesh2d_taus=data["mesh2d_s1"] * 0 + 7.0), tmp_path / "stress.nc")
    assert same(read(stress), read(path))


def test_a_largest_depth_is_not_read_in_place_of_levels_at_all_times(mesh, tmp_path):
    path = model_runs.write_run(tmp_path / "levels.nc", mesh, STEPS, depth=False)
    most = changed(path, lambda data: data.assign(hmax=data["mesh2d_s1"].max("time")), tmp_path / "most.nc")
    assert same(read(most), read(path))
    assert len(read(most, variable="hmax").steps) == 1


@pytest.mark.parametrize("where", [0, 1], ids=["from 0", "from 1, unsaid"])
def test_tables_of_nodes_may_be_turned_and_count_from_0_or_1(run, tmp_path, where):
    def turn(data):
        nodes = data["mesh2d_face_nodes"].transpose()
        nodes = nodes.copy(data=np.where(nodes > 0, nodes - (1 - where), nodes))
        del nodes.attrs["start_index"]
        return data.drop_vars("mesh2d_face_nodes").assign(mesh2d_face_nodes=nodes)

    assert same(read(changed(run, turn, tmp_path / "turned.nc")), read(run))


def test_faces_far_from_the_bounds_do_not_matter(mesh, run, tmp_path):
    side = (len(mesh.nodes) ** 0.5 - 1) * model_runs.EDGE
    west, south = model_runs.CORNER
    bounds = (west + 0.3 * side, south + 0.3 * side, west + 0.6 * side, south + 0.6 * side)
    middles = np.where((mesh.faces >= 0)[..., None], mesh.nodes[mesh.faces], np.nan)
    near = np.abs(np.nanmean(middles, axis=1) - (west + 0.45 * side, south + 0.45 * side)).max(axis=1) < 0.4 * side
    assert 0.5 < near.mean() < 0.8
    whole = read(run, bounds=bounds)
    part = read(model_runs.write_run(tmp_path / "part.nc", mesh.part(near), STEPS), frame=whole.frame)
    x0, y0, x1, y1 = whole.frame.box
    view = [[(x1 - x0) / 64, 0.0, x0], [0.0, (y0 - y1) / 64, y1]]
    shares = []
    for one, other in zip(whole.steps, part.steps, strict=True):
        drawings = one.drawing, other.drawing
        a, b = (render_exact(drawing, (64, 64), view) for drawing in drawings)
        shares.append(a.mean())
        np.testing.assert_allclose(a, b, atol=1e-3)
        np.testing.assert_array_equal(np.isnan(one.depth), np.isnan(other.depth))
    assert any(0.05 < share < 0.95 for share in shares)


def test_the_border_of_a_mesh_is_what_one_face_has(mesh):
    faces = np.where(mesh.faces >= 0, mesh.faces, -1).astype(np.int32)
    border = border_of(faces, len(mesh.nodes))
    side = round(np.sqrt(len(mesh.nodes))) - 1
    assert border.sum() == 4 * side
    face, column = np.nonzero(border)
    ends = mesh.nodes[faces[face, column]] - model_runs.CORNER
    assert (np.isclose(ends, 0.0) | np.isclose(ends, side * model_runs.EDGE)).any(axis=1).all()


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


@pytest.fixture(scope="module")
def partitions(mesh, tmp_path_factory):
    return model_runs.write_partitions(tmp_path_factory.mktemp("parts"), mesh, STEPS, 3)


def test_partitions_are_one_run(run, partitions):
    """Whichever of them is given, all are read, and each face counts once."""
    whole = read(run)
    for path in partitions[::2]:
        merged = read(path)
        assert merged.frame == whole.frame
        for one, other in zip(merged.steps, whole.steps, strict=True):
            np.testing.assert_allclose(one.depth, other.depth, atol=1e-6)
            off = np.abs(render_exact(one.drawing, (64, 64)) - render_exact(other.drawing, (64, 64)))
            assert off.max() < 1e-3
            assert len(one.drawing.paths) == len(other.drawing.paths)
        np.testing.assert_allclose(merged.bed, whole.bed, atol=1e-6)


def test_a_missing_partition_is_named(partitions, tmp_path):
    for path in partitions[:2]:
        (tmp_path / path.name).write_bytes(path.read_bytes())
    with pytest.raises(SourceError, match=r"run_0002_map\.nc is missing beside it; copy it there"):
        read(tmp_path / "run_0000_map.nc")


def test_partitions_of_different_runs_are_refused(partitions, mesh, tmp_path):
    for path in partitions[:2]:
        (tmp_path / path.name).write_bytes(path.read_bytes())
    (tmp_path / "other").mkdir()
    other = model_runs.write_partitions(tmp_path / "other", mesh, STEPS + 1, 3)[2]
    (tmp_path / other.name).write_bytes(other.read_bytes())
    with pytest.raises(SourceError, match="different times"):
        read(tmp_path / "run_0000_map.nc")


def test_a_file_that_is_only_named_so_is_told(run, tmp_path):
    alone = tmp_path / "run_0000_map.nc"
    alone.write_bytes(run.read_bytes())
    assert len(read(alone).steps) == STEPS
    (tmp_path / "run_0001_map.nc").write_bytes(run.read_bytes())
    with pytest.raises(SourceError, match="flowelem_domain"):
        read(alone)
